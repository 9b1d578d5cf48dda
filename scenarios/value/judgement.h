// The judge's verdict on one answer, as plain values.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/value/certificate.h"
#include "scenarios/value/observation.h"

namespace touchstone {

/// How an answer fails. `missed` and `ghost` are wrong verdicts; the others are wrong numbers or no answer at
/// all.
enum class Fault : std::uint8_t {
  missed,           // an existing overlap, hit or pair is denied (false negative)
  ghost,            // an overlap, hit or contact that does not exist is claimed (false positive)
  distance_off,     // signed distance
  witness_off,      // a witness point is off its body, or the two are not |g| apart
  normal_not_unit,  // NaN, zero or wrong length
  infeasible,       // moving by the depth along the normal does not separate
  not_minimal,      // the direction separates, but does not have the least depth: regret
  depth_excess,     // the depth is larger than the normal requires
  point_off,        // a manifold point is farther than the depth from a body
  point_depth,      // a manifold point is deeper than possible there
  incomplete,       // a manifold claimed to be complete omits part of the contact region
  late,             // time of impact after the bodies have penetrated
  early,            // time of impact while they are still apart
  stale,            // a pair names a body that is not present
  unstable,         // the same query gets different answers: uninitialised memory or retained state
  no_number,        // an answer lacks the requested number, or the number is not finite
  inner_edge,       // the normal of an edge or corner inside a flat part of a mesh
  bound_off,        // a stated lower bound of the distance is above it, or an upper bound below it
  gradient_off,     // a stated gradient of the distance is none, or is said to be the only one wrongly
  failed            // threw, crashed, timed out, did not converge
};
inline constexpr auto fault_names = std::to_array<std::string_view>(
    {"missed",     "ghost",       "distance_off", "witness_off",  "normal_not_unit",
     "infeasible", "not_minimal", "depth_excess", "point_off",    "point_depth",
     "incomplete", "late",        "early",        "stale",        "unstable",
     "no_number",  "inner_edge",  "bound_off",    "gradient_off", "failed"});
static_assert(fault_names.size() == static_cast<std::size_t>(Fault::failed) + 1);
constexpr std::string_view to_string(Fault f) { return fault_names[static_cast<std::size_t>(f)]; }

struct FaultReport {
  Fault fault = Fault::failed;
  double error = 0;       // absolute, in the scene's unit
  double error_in_l = 0;  // divided by the scale L of the case
  int a = -1, b = -1;     // bodies concerned
  int step = -1;          // query step of a script
  std::string words;      // one sentence with the numbers
  Certificate certificate;
};

/// Where an error comes from: `algorithm` when the answer is also wrong for the scene that the engine
/// received, `representation` when it is right for that one (the engine could not represent the original
/// scene).
enum class Blame : std::uint8_t { none, algorithm, representation };
inline constexpr auto blame_names = std::to_array<std::string_view>({"none", "algorithm", "representation"});
static_assert(blame_names.size() == static_cast<std::size_t>(Blame::representation) + 1);
constexpr std::string_view to_string(Blame b) { return blame_names[static_cast<std::size_t>(b)]; }

/// A claim of an answer that was not checked.
struct Unjudged {
  std::string claim;
  /// The definition of a right answer does not cover it (the depth of a surface). Otherwise it could have
  /// been checked but was not.
  bool by_definition = false;
};

/// The overall verdict on an answer, the first that applies: a claim is wrong; the referee could not decide
/// one; one was not checked; all were checked and none is wrong. `failed`: no answer. `refused`: no answer,
/// which is right for things that are not valid bodies.
enum class Ruling : std::uint8_t { wrong, undecided, not_judged, right, failed, refused, unsupported };
inline constexpr auto ruling_names = std::to_array<std::string_view>(
    {"wrong", "undecided", "not judged", "right", "failed", "refused", "unsupported"});
static_assert(ruling_names.size() == static_cast<std::size_t>(Ruling::unsupported) + 1);
constexpr std::string_view to_string(Ruling r) { return ruling_names[static_cast<std::size_t>(r)]; }

struct Judgement {
  Outcome outcome = Outcome::unsupported;
  bool undecided = false;                    // the referee could not decide: counted, never dropped
  std::vector<Unjudged> unjudged;            // claims that were not checked: neither right nor wrong
  std::vector<FaultReport> faults;           // for the original scene, worst first
  std::vector<FaultReport> received_faults;  // for the scene received
  Blame blame = Blame::none;
  bool holds_other_shape = false;  // the representation differs by more than rounding
  double worst_in_l = 0;           // largest error over all checks, even when right
  std::uint64_t pairs_true = 0, pairs_reported = 0, pairs_duplicate = 0;  // candidates: for precision
  /// Area (or length) spanned by the manifold's points, divided by that of the true contact region; empty
  /// when the region is a point or no manifold was given for the true normal.
  std::optional<double> manifold_coverage;
  /// Whether the region's centroid lies among the points: in their hull, or within 1e-3 of its diameter of
  /// it.
  std::optional<bool> manifold_centred;
  /// By how much the stated lower bound of the distance is too low, divided by L; empty without such a bound.
  std::optional<double> bound_slack_in_l;
  /// The tolerance that the engine claims for this answer when it exceeds `wide_claim` of L, so that being
  /// right within it means little; otherwise 0.
  double wide_claim = 0, wide_claim_in_l = 0;
  Ruling ruling() const;
  bool right() const { return ruling() == Ruling::right; }
  /// True when every unchecked claim is unchecked by definition.
  bool unjudged_by_definition() const;
};

}  // namespace touchstone
