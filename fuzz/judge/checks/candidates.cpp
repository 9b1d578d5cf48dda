// Candidate pairs: every pair whose closed exact bodies overlap must be reported, with no tolerance at all
// (docs/truth.md §3). Superfluous pairs only count against precision; a pair that names an absent body is
// stale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "fuzz/judge/candidate_comparison.h"
#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

void count(CheckOutput& out, std::size_t required, const CandidateComparison& found) {
  out.pairs_true += required;
  out.pairs_reported += found.reported.size();
  out.pairs_duplicate += found.duplicates;
}

void fault_missed(const CheckInput& in, CheckOutput& out, int k, const Truth::TruePair& p) {
  const auto [a, b] = p.bodies;
  const bool overlaps = in.query.question == Question::candidates;
  const double limit = overlaps ? 0 : in.truth.scene().margin;
  const double l = in.truth.scale(a, b), depth = std::max(0.0, limit - p.truth.gap.hi);
  out.error(depth, l, 0);
  out.fault(Fault::missed, depth, l, {in.query.question, a, b},
            overlaps ? fmt::format("query {}: pair ({}, {}) overlaps{} and is not a candidate", k, a, b,
                                   depth > 0 ? fmt::format(" by {:.6g}", depth) : " (touching)")
                     : fmt::format(
                           "query {}: pair ({}, {}) is within the margin of {:.6g}{} and is not a candidate",
                           k, a, b, limit, depth > 0 ? fmt::format(" by {:.6g}", depth) : " (exactly)"),
            p.truth.verdict_certificate);
  out.faults.back().step = k;
}

void fault_stale(const CheckInput& in, CheckOutput& out, BodyPair p, const std::string& place) {
  out.fault(Fault::stale, 0, 1, {in.query.question, p.first, p.second},
            fmt::format("{}pair ({}, {}) names a body that is not there", place, p.first, p.second));
}

}  // namespace

namespace {

void compare_with(const CheckInput& in, CheckOutput& out,
                  const std::vector<std::vector<Truth::TruePair>>& truth) {
  const auto& states = in.truth.steps();
  if (in.answer.candidate_pairs.size() > truth.size()) {
    out.fault(Fault::no_number, 0, 1, in.query, "answers more queries than the script asks");
    return;
  }
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto& poses = states[k].pose;
    const auto found =
        compare_candidates(in.answer, k, static_cast<int>(poses.size()), truth[k], &Truth::TruePair::bodies,
                           [&](int i) { return poses[static_cast<std::size_t>(i)].has_value(); });
    count(out, truth[k].size(), found);
    for (const std::size_t i : found.missed) fault_missed(in, out, static_cast<int>(k), truth[k][i]);
    for (const BodyPair& p : found.stale) {
      fault_stale(in, out, p, fmt::format("query {}: ", k));
      out.faults.back().step = static_cast<int>(k);
    }
  }
}

}  // namespace

// Engines report only the bodies' first poses as received, so scripts are judged as given.
void check_candidates(const CheckInput& in, CheckOutput& out) {
  if (in.frame != 0) return;
  const auto& truth = in.truth.true_pairs();
  out.undecided = in.truth.undecided_pairs() > 0;
  compare_with(in, out, truth);
}

void check_candidates_within(const CheckInput& in, CheckOutput& out) {
  if (in.frame != 0) return;
  const auto& truth = in.truth.pairs_within();
  out.undecided = in.truth.undecided_pairs_within() > 0;
  compare_with(in, out, truth);
}

// Every pair that overlaps at some time of the step. The depth is measured only for missed pairs.
void check_swept_candidates(const CheckInput& in, CheckOutput& out) {
  if (in.frame != 0) return;
  const auto& truth = in.truth.meeting_pairs();
  out.undecided = in.truth.undecided_meetings() > 0;
  if (in.answer.candidate_pairs.size() > 1) {
    out.fault(Fault::no_number, 0, 1, in.query, "answers more than one step");
    return;
  }
  const auto found = compare_candidates(in.answer, 0, static_cast<int>(in.truth.scene().bodies.size()), truth,
                                        std::identity{}, [](int) { return true; });
  count(out, truth.size(), found);
  for (const std::size_t i : found.missed) {
    const auto [a, b] = truth[i];
    const double l = in.truth.scale(a, b), depth = in.truth.depth_in_step(0, a, b);
    out.error(depth, l, 0);
    out.fault(Fault::missed, depth, l, {in.query.question, a, b},
              fmt::format("pair ({}, {}) overlaps during the step{}, first near t = {:.9g}, and is not a "
                          "candidate",
                          a, b, depth > 0 ? fmt::format(" by {:.6g}", depth) : " (touching)",
                          in.truth.motion(0, a, b).t_hi));
  }
  for (const BodyPair& p : found.stale) fault_stale(in, out, p, "");
}

}  // namespace touchstone::fuzz
