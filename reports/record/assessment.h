// Which engine can be trusted on one robot in one world: what each was asked, and how wrong it was.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// One engine, in one setting. Lengths in the scene's unit.
struct AssessedEngine {
  std::string name, library, version, settings;
  std::map<Question, Tally> tallies;  // overlap, distance, contact
  double worst_distance_error = 0;    // of pairs that are apart
  std::string worst_pair;             // "A and B, configuration 12"; empty when there is no error
  /// Collisions that its overlap test does not report and of which it states no distance either.
  std::uint64_t silent = 0;
  /// The largest distance that it states between bodies that overlap, of those that its overlap test does not
  /// report: the test "overlap, or distance <= padding" misses no collision of those asked.
  double padding = 0;
};

struct Assessment {
  std::string robot, world;
  std::uint64_t seed = 1;
  std::uint64_t configurations = 0;
  bool of_trajectory = false;
  double near = 0;                          // pairs whose boxes are farther apart are not asked
  std::uint64_t possible = 0;               // pairs of bodies of one configuration that are not filtered
  std::uint64_t near_pairs = 0, asked = 0;  // in all configurations
  std::uint64_t overlapping = 0, apart = 0, undecided = 0;  // of those asked, as the referee says
  bool interrupted = false;
  std::vector<AssessedEngine> engines;
  /// The configuration with the most wrong answers, and the pairs concerned; empty when no answer is wrong.
  std::optional<std::uint64_t> worst_configuration;
  std::vector<std::pair<int, int>> worst_pairs;
};

/// The engines that answered overlap for every pair asked and, with `padding`, missed no collision. Least
/// padding first, then those whose overlap test alone suffices, then fewer ghosts, then the shorter median
/// time of an overlap test.
struct Advice {
  std::string engine;
  double padding = 0;
  bool by_distance = false;  // its overlap test alone misses collisions
  std::uint64_t ghosts = 0;
  double median_ns = 0;
};
std::vector<Advice> advice_on(const Assessment& a);

/// Without times the part that the same seed reproduces.
Json to_json(const Assessment& a, bool with_times);

}  // namespace touchstone::fuzz
