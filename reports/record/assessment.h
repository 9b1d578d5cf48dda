// Which engine can be trusted on one robot in one world: what each was asked, and how wrong it was.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// A pair that an engine got wrong, kept as an example. Lengths in the scene's unit.
struct AssessedSample {
  enum class Kind : std::uint8_t { missed, false_alarm, distance };
  Kind kind = Kind::missed;
  std::uint64_t index = 0;  // of the pair, of those asked
  std::uint64_t configuration = 0;
  int a = 0, b = 0;  // bodies
  double size = 0;   // the depth denied (0 if it is not defined), the gap, or the error of the distance
};
inline constexpr std::size_t most_samples_of_kind = 4;
/// "missed", "false", "distance".
std::string_view to_string(AssessedSample::Kind kind);

/// One engine, in one setting. Lengths in the scene's unit.
struct AssessedEngine {
  std::string name, library, version, settings;
  bool is_own = false;                // Touchstone's core
  std::map<Question, Tally> tallies;  // overlap, distance, contact
  std::uint64_t distances_apart = 0;  // stated, of pairs that are apart
  double worst_distance_error = 0;    // of these
  std::string worst_pair;             // "A and B, configuration 12"; empty when there is no error
  /// Collisions that its overlap test denies, however shallow, and the depth of the deepest whose depth is
  /// defined; of them, those deeper than Assessment::error or of no defined depth (meshes).
  std::uint64_t denied = 0;
  double deepest_denied = 0;
  std::uint64_t missed = 0;
  /// Collisions that it reports of bodies farther apart than Assessment::error, and the largest gap.
  std::uint64_t false_alarms = 0;
  double largest_gap = 0;
  /// Of the denied, those of which it states no distance either.
  std::uint64_t silent = 0;
  /// The largest distance that it states between bodies that overlap, of those that its overlap test does not
  /// report: the test "overlap, or distance <= padding" misses no collision of those asked.
  double padding = 0;
  /// Pairs whose overlap it does not state, by kinds of shapes ("box-mesh").
  std::map<std::string, std::uint64_t> unanswered;
  std::vector<AssessedSample> samples;  // of each kind the largest, largest first
};
/// Sorts by kind, largest first, and keeps at most most_samples_of_kind of each.
void keep_largest(std::vector<AssessedSample>& samples);

struct Assessment {
  std::string robot, world;
  std::uint64_t seed = 1;
  std::uint64_t configurations = 0;
  bool of_trajectory = false;
  double near = 0;                          // pairs whose boxes are farther apart are not asked
  double error = 0;                         // of a distance, gap or depth: what is accepted
  std::uint64_t possible = 0;               // pairs of bodies of one configuration that are not filtered
  std::uint64_t near_pairs = 0, asked = 0;  // in all configurations
  std::uint64_t overlapping = 0, apart = 0, undecided = 0;  // of those asked, as the referee says
  bool interrupted = false;
  std::vector<AssessedEngine> engines;
  /// The configuration with the most wrong answers, and the pairs concerned; empty when no answer is wrong.
  std::optional<std::uint64_t> worst_configuration;
  std::vector<std::pair<int, int>> worst_pairs;
};

/// An engine for collision tests: it answered overlap for every pair asked and, with `padding`, missed no
/// collision.
struct TestAdvice {
  std::string engine;
  bool is_own = false;
  double padding = 0;
  bool by_distance = false;  // its overlap test alone misses collisions: a query of the distance is needed
  std::uint64_t false_alarms = 0;
  double median_ns = 0;  // of the query that is needed
};
/// Least padding first, then those whose overlap test alone suffices, then fewer false alarms, then shorter
/// times.
std::vector<TestAdvice> test_advice(const Assessment& a);

/// An engine for distances: it stated one for every pair that is apart.
struct DistanceAdvice {
  std::string engine;
  bool is_own = false;
  double worst_error = 0;
  double median_ns = 0;
};
/// Those whose errors are within `Assessment::error`, the fastest first; then the others, the most accurate
/// first.
std::vector<DistanceAdvice> distance_advice(const Assessment& a);

/// Without times the part that the same seed reproduces.
Json to_json(const Assessment& a, bool with_times);

}  // namespace touchstone::fuzz
