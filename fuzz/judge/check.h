// One check: looks at one answer in one frame and adds what is wrong with it. Pure.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "fuzz/judge/judgement.h"
#include "fuzz/judge/truth.h"
#include "oracles/api/engine.h"

namespace touchstone::fuzz {

struct CheckInput {
  Truth& truth;
  int frame = 0;
  const Query& query;
  const Observation& answer;
  const EngineCard& card;

  /// τ for a pair of scale l (truth.md §3).
  double tau(double l) const { return card.tau_factor * card.unit_roundoff * l + answer.claimed_tolerance; }
};

struct CheckOutput {
  std::vector<FaultReport> faults;
  double worst_in_l = 0;
  bool undecided = false;
  std::uint64_t pairs_true = 0, pairs_reported = 0, pairs_duplicate = 0;
  std::optional<double> manifold_coverage;
  /// Largest error − τ over everything measured: > 0 wrong by that much, < 0 right with that much to spare.
  /// Errors change by at most 2D between frames whose bodies are D apart, so that a large |excess| settles
  /// both frames at once. NaN: something was measured in this frame alone, and another frame must be judged
  /// for itself.
  double excess = -std::numeric_limits<double>::infinity();

  void error(double absolute, double l, double tau) {
    if (absolute > 0 && l > 0) worst_in_l = std::max(worst_in_l, absolute / l);
    if (!std::isnan(excess)) excess = std::max(excess, absolute - tau);
  }
  /// A fault whose error was measured with error().
  void fault(Fault f, double absolute, double l, const Query& q, std::string words,
             referee::Certificate c = {}) {
    faults.push_back(
        {f, absolute, l > 0 ? absolute / l : absolute, q.a, q.b, -1, std::move(words), std::move(c)});
  }
  /// A fault in every frame: the answer itself is no answer.
  void fault_always(Fault f, double absolute, const Query& q, std::string words) {
    excess = std::numeric_limits<double>::infinity();
    fault(f, absolute, 1, q, std::move(words));
  }
  void frame_matters() { excess = std::numeric_limits<double>::quiet_NaN(); }
};

// One row a check in judge.cpp; each lives in fuzz/judge/checks/<name>.cpp.
void check_overlap(const CheckInput& in, CheckOutput& out);
void check_distance(const CheckInput& in, CheckOutput& out);
void check_witness(const CheckInput& in, CheckOutput& out);
void check_contact(const CheckInput& in, CheckOutput& out);
void check_manifold(const CheckInput& in, CheckOutput& out);
void check_time_of_impact(const CheckInput& in, CheckOutput& out);
void check_candidates(const CheckInput& in, CheckOutput& out);
void check_scene_contacts(const CheckInput& in, CheckOutput& out);

/// The part of `contact` that scene contacts share: normal, feasibility, regret, excess of one stated
/// contact.
void judge_normal_and_depth(const CheckInput& in, CheckOutput& out, int a, int b,
                            const referee::PairTruth& truth, const Vec3& normal, double depth);

}  // namespace touchstone::fuzz
