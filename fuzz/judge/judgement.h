// What the judge says of one answer. Plain values.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/api/observation.h"
#include "oracles/referee/referee.h"

namespace touchstone::fuzz {

/// How an answer fails. `missed` and `ghost` are wrong verdicts; the others are wrong numbers or no answer at
/// all.
enum class Fault : std::uint8_t {
  missed,           // overlap, hit or pair that exists is denied
  ghost,            // overlap, hit or contact that does not exist is claimed
  distance_off,     // signed distance
  witness_off,      // a witness point is off its body, or the two are not |g| apart
  normal_not_unit,  // NaN, zero or wrong length
  infeasible,       // moving by the depth along the normal does not separate
  not_minimal,      // a valid direction, but not the least: regret
  depth_excess,     // the depth is larger than its own normal needs
  point_off,        // a manifold point is farther than the depth from a body
  late,             // time of impact after the bodies have penetrated
  early,            // time of impact while they are still apart
  stale,            // a pair that names a body which is not there
  unstable,         // asked twice, it answers differently: memory that it never wrote, or state that it keeps
  no_number,        // an answered question without the number it asks for, or a non-finite one
  failed            // threw, crashed, timed out, did not converge
};
inline constexpr std::array<std::string_view, 15> fault_names{
    "missed",     "ghost",       "distance_off", "witness_off", "normal_not_unit",
    "infeasible", "not_minimal", "depth_excess", "point_off",   "late",
    "early",      "stale",       "unstable",     "no_number",   "failed"};
constexpr std::string_view to_string(Fault f) { return fault_names[static_cast<std::size_t>(f)]; }

struct FaultReport {
  Fault fault = Fault::failed;
  double error = 0;       // absolute, in the scene's unit
  double error_in_l = 0;  // divided by the scale L of the case
  int a = -1, b = -1;     // bodies concerned
  int step = -1;          // query step of a script
  std::string words;      // one sentence with the numbers
  referee::Certificate certificate;
};

/// Where an error comes from: `algorithm` when the answer is wrong also for the scene that the engine
/// received, `representation` when it is right for that one (the engine could not hold the scene asked).
enum class Blame : std::uint8_t { none, algorithm, representation };
inline constexpr std::array<std::string_view, 3> blame_names{"none", "algorithm", "representation"};
constexpr std::string_view to_string(Blame b) { return blame_names[static_cast<std::size_t>(b)]; }

struct Judgement {
  Outcome outcome = Outcome::unsupported;
  bool undecided = false;           // the referee could not decide: counted, never dropped
  std::vector<FaultReport> faults;  // against the scene asked, worst first; empty: right (if answered)
  std::vector<FaultReport> received_faults;  // against the scene received
  Blame blame = Blame::none;
  bool holds_other_shape = false;  // blamed on a representation that is more than rounding
  double worst_in_l = 0;           // largest error over all checks, also when right
  std::uint64_t pairs_true = 0, pairs_reported = 0, pairs_duplicate = 0;  // candidates: for precision
  /// Area (or length) that the manifold's points span over that of the true contact region; empty where the
  /// region is a point, or no manifold was stated for the true normal.
  std::optional<double> manifold_coverage;
  bool right() const { return outcome == Outcome::answered && faults.empty(); }
};

}  // namespace touchstone::fuzz
