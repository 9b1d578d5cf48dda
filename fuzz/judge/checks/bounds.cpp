// Bounds of the signed distance, each judged as the bound that it claims to be: a lower bound above the
// distance and an upper bound below it are wrong. How much lower a lower bound is, is measured and no fault.
#include <fmt/format.h>

#include <cmath>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

// True when the bound can be compared with the distance.
bool is_bound(const CheckInput& in, CheckOutput& out, double bound, double harmless) {
  if (bound == harmless) return false;
  if (std::isfinite(bound)) return true;
  out.fault_always(Fault::no_number, 0, in.query, fmt::format("a bound of the distance is {}", bound));
  return false;
}

void fault_bound(const CheckInput& in, CheckOutput& out, double l, double error, std::string words) {
  const referee::PairTruth& truth = in.truth.pair(in.frame, in.query.a, in.query.b);
  out.fault(Fault::bound_off, error, l, in.query, std::move(words), truth.verdict_certificate);
}

void check_lower(const CheckInput& in, CheckOutput& out, double bound) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!is_bound(in, out, bound, -infinity)) return;
  const double l = in.truth.scale(in.query.a, in.query.b), tau = in.tau(l);
  const referee::Bracket gap = in.truth.pair(in.frame, in.query.a, in.query.b).gap;
  const double error = bound - gap.hi;
  out.error(error, l, tau);
  if (error > tau)
    return fault_bound(
        in, out, l, error,
        fmt::format("says at least {:.9g}; the signed distance is at most {:.9g}", bound, gap.hi));
  out.undecided |= bound - gap.lo > tau && std::isinf(gap.lo) && gap.hi > 0;
  if (std::isfinite(gap.lo) && l > 0) out.bound_slack_in_l = std::max(0.0, gap.lo - bound) / l;
}

void check_upper(const CheckInput& in, CheckOutput& out, double bound) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!is_bound(in, out, bound, infinity)) return;
  const double l = in.truth.scale(in.query.a, in.query.b), tau = in.tau(l);
  const referee::PairTruth& truth = in.truth.pair(in.frame, in.query.a, in.query.b);
  if (truth.verdict == referee::Verdict::overlap && std::isinf(truth.gap.lo)) {
    if (bound < 0) out.not_judged("an upper bound of a surface's depth", true);
    return;
  }
  const double error = truth.gap.lo - bound;
  out.error(error, l, tau);
  if (error > tau)
    return fault_bound(
        in, out, l, error,
        fmt::format("says at most {:.9g}; the signed distance is at least {:.9g}", bound, truth.gap.lo));
  out.undecided |= std::isinf(truth.gap.lo);
}

}  // namespace

void check_bounds(const CheckInput& in, CheckOutput& out) {
  if (in.answer.lower_bound) check_lower(in, out, *in.answer.lower_bound);
  if (in.answer.upper_bound) check_upper(in, out, *in.answer.upper_bound);
}

// A distance is judged like any other. Without one, the lower bound must reach the margin: then the bodies
// are farther apart than was asked about.
void check_bounded_distance(const CheckInput& in, CheckOutput& out) {
  const double margin = in.truth.scene().margin;
  if (in.answer.distance || !in.answer.lower_bound) return check_distance(in, out);
  const double tau = in.tau(in.truth.scale(in.query.a, in.query.b));
  if (!(*in.answer.lower_bound >= margin - tau))
    out.fault_always(
        Fault::no_number, 0, in.query,
        fmt::format("states neither the distance nor a lower bound that reaches {:.9g}", margin));
}

}  // namespace touchstone::fuzz
