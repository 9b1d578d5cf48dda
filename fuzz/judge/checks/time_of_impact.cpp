// Time of impact, judged by gaps, never by times: grazing makes the time ill-conditioned, the gap stays
// well-conditioned (truth.md §3). Every accusation rests on a gap bracket at one certain time.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {

void check_time_of_impact(const CheckInput& in, CheckOutput& out) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  using Verdict = referee::TimeTruth::Verdict;
  if (!in.answer.toi) {
    const referee::TimeTruth& truth = in.truth.motion(in.frame, a, b);
    if (truth.verdict == Verdict::none) return;
    // Depth that is certain at some time of the step: a miss deeper than τ is wrong.
    const double depth = std::max(-truth.least_gap.hi, in.truth.depth_before(in.frame, a, b, 1.0));
    out.error(depth, l);
    if (depth > tau)
      out.fault(
          Fault::missed, depth, l, in.query,
          fmt::format("says no impact; the bodies overlap by {:.6g} during the step, first near t = {:.9g}",
                      depth, truth.t_hi));
    else if (truth.verdict == Verdict::undecided)
      out.undecided = true;
    return;
  }
  const double t = *in.answer.toi;
  if (!std::isfinite(t) || t < 0 || t > 1) {
    out.fault(Fault::no_number, 0, l, in.query, fmt::format("the time of impact is {}, outside [0,1]", t));
    return;
  }
  const referee::Bracket gap = in.truth.gap_at(in.frame, a, b, t);
  const double early = gap.lo, at_t = -gap.hi;
  const double late = std::max(at_t, in.truth.depth_before(in.frame, a, b, t));
  // Overlap from the start is reported as t = 0, however deep it is.
  const bool start = t == 0;
  out.error(std::max(early, start ? 0.0 : late), l);
  if (early > tau) {
    const bool none = in.truth.motion(in.frame, a, b).verdict == Verdict::none;
    out.fault(none ? Fault::ghost : Fault::early, early, l, in.query,
              fmt::format("says impact at t = {:.9g}, where the gap is {:.6g}{}", t, early,
                          none ? "; there is no impact in the step" : ""));
  } else if (!start && late > tau) {
    out.fault(
        Fault::late, late, l, in.query,
        fmt::format("says impact at t = {:.9g}; by then the bodies have overlapped by {:.6g}", t, late));
  }
}

}  // namespace touchstone::fuzz
