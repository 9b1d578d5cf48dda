// Overlap yes/no: wrong when the verdict differs from the truth and |g| > τ. The error is |g| of the wrong
// verdict.
#include <fmt/format.h>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {

void check_overlap(const CheckInput& in, CheckOutput& out) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  if (!in.answer.overlap) {
    out.fault_always(Fault::no_number, 0, in.query, "answered without saying whether the bodies overlap");
    return;
  }
  if (truth.verdict == referee::Verdict::undecided) {
    out.undecided = true;
    out.frame_matters();
    return;
  }
  const bool says = *in.answer.overlap, is = truth.verdict == referee::Verdict::overlap;
  if (says == is) {
    // Right by a margin of |g|: in a frame that displaces the bodies by more than that, the answer may be
    // wrong.
    const double margin = is ? std::max(0.0, -truth.gap.hi) : std::max(0.0, truth.gap.lo);
    return out.error(-margin, l, tau);
  }
  // The certified part of |g|.
  const double error = is ? certain_depth(in, a, b, truth) : std::max(0.0, truth.gap.lo);
  const double allowed = is ? tau : tau + in.offset();
  out.error(error, l, allowed);
  if (error <= allowed) return;
  out.fault(is ? Fault::missed : Fault::ghost, error, l, in.query,
            is ? fmt::format("says apart; the bodies overlap by at least {:.6g}", error)
               : fmt::format("says overlap; the bodies are at least {:.6g} apart", error),
            truth.verdict_certificate);
}

}  // namespace touchstone::fuzz
