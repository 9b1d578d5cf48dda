// Is the signed distance at most the margin? As overlap yes/no, of which it is the case of margin 0: wrong
// when the verdict differs from the truth and the distance differs from the margin by more than τ.
#include <fmt/format.h>

#include <algorithm>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

// The certain part of the distance's difference from the margin, on either side of it.
struct Difference {
  double within = 0, beyond = 0;
};

Difference difference(const CheckInput& in, const referee::PairTruth& truth, double margin) {
  double hi = truth.gap.hi;
  // The bracket of a mesh that overlaps does not hold the depth in its deepest triangle.
  if (truth.verdict == referee::Verdict::overlap && margin >= 0)
    hi = std::min(hi, -certain_depth(in, in.query.a, in.query.b, truth));
  return {std::max(0.0, margin - hi), std::max(0.0, truth.gap.lo - margin)};
}

}  // namespace

void check_within(const CheckInput& in, CheckOutput& out) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const double margin = in.truth.scene().margin, l = in.truth.scale(a, b), tau = in.tau(l);
  if (!in.answer.overlap) {
    out.fault_always(Fault::no_number, 0, in.query,
                     "answered without saying whether the bodies are within the margin");
    return;
  }
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const bool has_depth = !in.is_surface(a) && !in.is_surface(b);
  if (margin < 0 && !has_depth && truth.verdict == referee::Verdict::overlap) {
    out.not_judged("whether a surface is penetrated by less than the margin", true);
    return;
  }
  const referee::Verdict verdict = in.truth.within(in.frame, a, b);
  const Difference by = difference(in, truth, margin);
  const bool says = *in.answer.overlap;
  if (verdict == referee::Verdict::undecided) {
    // Both verdicts are right if the distance is certainly within τ of the margin.
    if (truth.gap.lo >= margin - tau && truth.gap.hi <= margin + tau) return out.frame_matters();
    out.undecided = true;
    return out.frame_matters();
  }
  const bool is = verdict == referee::Verdict::overlap;
  if (says == is) return out.error(-(is ? by.within : by.beyond), l, tau);
  const double error = is ? by.within : by.beyond;
  out.error(error, l, tau);
  if (error <= tau) return;
  out.fault(
      is ? Fault::missed : Fault::ghost, error, l, in.query,
      is ? fmt::format("says not within the margin of {:.9g}; the signed distance is less by at least {:.6g}",
                       margin, error)
         : fmt::format("says within the margin of {:.9g}; the signed distance is more by at least {:.6g}",
                       margin, error));
}

}  // namespace touchstone::fuzz
