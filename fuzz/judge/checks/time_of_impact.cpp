// Time of impact, judged by gaps, never by times: grazing makes the time ill-conditioned, but the gap stays
// well-conditioned (truth.md §3). Every fault rests on a gap bracket at one definite time. A mesh has no
// interior; its depth is that in its deepest triangle, a convex set: how far the body must move at least to
// leave that triangle. Before the first contact every triangle is clear, so a body within τ of touching at
// the reported time is within τ of every triangle, however it passes on.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {

namespace {

using Verdict = referee::TimeTruth::Verdict;

// Qualifies the depth in a message.
std::string_view of_what(const CheckInput& in) {
  return in.is_mesh(in.query.a) || in.is_mesh(in.query.b) ? " (in one triangle)" : "";
}

// "No impact": wrong by the depth that is certain at some time of the step.
void check_denied(const CheckInput& in, CheckOutput& out, double l, double tau) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const referee::TimeTruth& truth = in.truth.motion(in.frame, a, b);
  if (truth.verdict == Verdict::none) return out.error(-std::max(0.0, truth.least_gap.lo), l, tau);
  const double searched = in.truth.depth_in_step(in.frame, a, b);
  const double depth = std::max(-truth.least_gap.hi, searched);
  out.error(depth, l, tau);
  if (depth > tau) {
    out.fault(
        Fault::missed, depth, l, in.query,
        fmt::format("says no impact; the bodies overlap by {:.6g}{} during the step, first near t = {:.9g}",
                    depth, of_what(in), truth.t_hi));
  } else if (truth.verdict == Verdict::undecided || std::isinf(searched)) {
    out.undecided = true;
    out.frame_matters();
  }
}

// The largest certain depth before t. The bodies are apart before t_lo and approach no faster than `speed`
// after it, so most answers need no search.
double late_by(const CheckInput& in, CheckOutput& out, double t, double at_t, double tau) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  if (at_t > tau) return at_t;
  const referee::TimeTruth& truth = in.truth.motion(in.frame, a, b);
  const double after = truth.verdict == Verdict::none ? 0 : t - truth.t_lo;
  if (after <= 0 || after * in.truth.speed(a, b) <= tau) return std::max(at_t, 0.0);
  const double searched = in.truth.depth_before(in.frame, a, b, t);
  out.undecided |= std::isinf(searched);
  return std::max(at_t, searched);
}

}  // namespace

void check_time_of_impact(const CheckInput& in, CheckOutput& out) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  if (!in.answer.toi) return check_denied(in, out, l, tau);
  const double t = *in.answer.toi;
  if (!std::isfinite(t) || t < 0 || t > 1)
    return out.fault_always(Fault::no_number, 0, in.query,
                            fmt::format("the time of impact is {}, outside [0,1]", t));
  const referee::Bracket gap = in.truth.gap_at(in.frame, a, b, t);
  if (std::isinf(gap.lo) && std::isinf(gap.hi) && gap.lo < gap.hi) {
    out.undecided = true;  // nothing is known about the gap
    return;
  }
  const double early = gap.lo;
  // Overlap from the start is reported as t = 0, however deep it is.
  const double late = t == 0 ? 0 : late_by(in, out, t, -gap.hi, tau);
  const double most_early = tau + sweep_skin(in.card);
  out.error(early, l, most_early);
  out.error(late, l, tau);
  if (early > most_early) {
    const bool none = in.truth.motion(in.frame, a, b).verdict == Verdict::none;
    out.fault(none ? Fault::ghost : Fault::early, early, l, in.query,
              fmt::format("says impact at t = {:.9g}, where the gap is {:.6g}{}", t, early,
                          none ? "; there is no impact in the step" : ""));
  } else if (late > tau) {
    out.fault(Fault::late, late, l, in.query,
              fmt::format("says impact at t = {:.9g}; by then the bodies have overlapped by {:.6g}{}", t,
                          late, of_what(in)));
  }
}

}  // namespace touchstone::fuzz
