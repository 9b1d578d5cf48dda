// Candidate pairs: every pair whose closed exact bodies overlap must be reported, with no tolerance at all
// (docs/truth.md §3). Superfluous pairs only count against precision; a pair that names an absent body is
// stale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

using TruePairs = std::vector<Truth::TruePair>;

std::vector<BodyPair> sorted_unique(const std::vector<BodyPair>& reported, std::uint64_t& duplicates) {
  std::vector<BodyPair> r = reported;
  for (BodyPair& p : r)
    if (p.first > p.second) std::swap(p.first, p.second);
  std::sort(r.begin(), r.end());
  const auto end = std::unique(r.begin(), r.end());
  duplicates += static_cast<std::uint64_t>(r.end() - end);
  r.erase(end, r.end());
  return r;
}

void check_missed(const CheckInput& in, CheckOutput& out, int k, const TruePairs& truth,
                  const std::vector<BodyPair>& reported) {
  for (const Truth::TruePair& p : truth) {
    if (std::binary_search(reported.begin(), reported.end(), p.bodies)) continue;
    const auto [a, b] = p.bodies;
    const double l = in.truth.scale(a, b), depth = std::max(0.0, -p.truth.gap.hi);
    out.error(depth, l, 0);
    out.fault(Fault::missed, depth, l, {in.query.question, a, b},
              fmt::format("query {}: pair ({}, {}) overlaps{} and is not a candidate", k, a, b,
                          depth > 0 ? fmt::format(" by {:.6g}", depth) : " (touching)"),
              p.truth.verdict_certificate);
    out.faults.back().step = k;
  }
}

void check_stale(const CheckInput& in, CheckOutput& out, int k, const Truth::StepState& state,
                 const std::vector<BodyPair>& reported) {
  const int n = static_cast<int>(state.pose.size());
  for (const auto& [a, b] : reported) {
    const auto absent = [&](int i) { return i < 0 || i >= n || !state.pose[static_cast<std::size_t>(i)]; };
    if (a != b && !absent(a) && !absent(b)) continue;
    out.fault(Fault::stale, 0, 1, {in.query.question, a, b},
              fmt::format("query {}: pair ({}, {}) names a body that is not there", k, a, b));
    out.faults.back().step = k;
  }
}

}  // namespace

void check_candidates(const CheckInput& in, CheckOutput& out) {
  if (in.frame != 0) return;  // engines report only the bodies' first poses; scripts are judged as given
  const auto& truth = in.truth.true_pairs();
  const auto& states = in.truth.steps();
  out.undecided = in.truth.undecided_pairs() > 0;
  if (in.answer.candidate_pairs.size() > truth.size()) {
    out.fault(Fault::no_number, 0, 1, in.query, "answers more queries than the script asks");
    return;
  }
  static const std::vector<BodyPair> none;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto& raw = k < in.answer.candidate_pairs.size() ? in.answer.candidate_pairs[k] : none;
    const auto reported = sorted_unique(raw, out.pairs_duplicate);
    out.pairs_true += truth[k].size();
    out.pairs_reported += reported.size();
    check_missed(in, out, static_cast<int>(k), truth[k], reported);
    check_stale(in, out, static_cast<int>(k), states[k], reported);
  }
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
  static const std::vector<BodyPair> none;
  const auto reported = sorted_unique(in.answer.candidate_pairs.empty() ? none : in.answer.candidate_pairs[0],
                                      out.pairs_duplicate);
  out.pairs_true += truth.size();
  out.pairs_reported += reported.size();
  for (const auto& [a, b] : truth) {
    if (std::binary_search(reported.begin(), reported.end(), BodyPair{a, b})) continue;
    const double l = in.truth.scale(a, b), depth = in.truth.depth_in_step(0, a, b);
    out.error(depth, l, 0);
    out.fault(Fault::missed, depth, l, {in.query.question, a, b},
              fmt::format("pair ({}, {}) overlaps during the step{}, first near t = {:.9g}, and is not a "
                          "candidate",
                          a, b, depth > 0 ? fmt::format(" by {:.6g}", depth) : " (touching)",
                          in.truth.motion(0, a, b).t_hi));
  }
  const int n = static_cast<int>(in.truth.scene().bodies.size());
  for (const auto& [a, b] : reported)
    if (a < 0 || b >= n || a == b)
      out.fault(Fault::stale, 0, 1, {in.query.question, a, b},
                fmt::format("pair ({}, {}) names a body that is not there", a, b));
}

}  // namespace touchstone::fuzz
