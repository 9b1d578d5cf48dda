// Signed distance |reported - g| and the witness points (docs/truth.md §3).
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "fuzz/judge/check.h"

namespace touchstone::fuzz {
namespace {

double outside(double x, const referee::Bracket& b) {
  return x < b.lo ? b.lo - x : (x > b.hi ? x - b.hi : 0.0);
}

// Two numbers that print alike differ by their error.
std::string words_of(double said, double truth, double error) {
  const std::string x = fmt::format("{:.9g}", said), y = fmt::format("{:.9g}", truth);
  return fmt::format("says {}; the signed distance is {}", x,
                     x == y ? fmt::format("{:.2g} off that", error) : y);
}

}  // namespace

void check_distance(const CheckInput& in, CheckOutput& out) {
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  // "They overlap, and I have no depth" is an honest answer.
  if (in.answer.overlap) check_overlap(in, out);
  if (!in.answer.distance) {
    if (!in.answer.overlap && !in.answer.lower_bound && !in.answer.upper_bound)
      out.fault_always(Fault::no_number, 0, in.query, "answered without a distance");
    return;
  }
  const double d = *in.answer.distance;
  if (d > 0 && std::isinf(d) && !(truth.gap.hi <= std::numeric_limits<double>::max())) {
    out.not_judged("a distance beyond the doubles", true);
    return;
  }
  if (!std::isfinite(d)) {
    out.fault_always(Fault::no_number, 0, in.query, fmt::format("the distance is {}", d));
    return;
  }
  if (truth.verdict == referee::Verdict::undecided && !std::isfinite(truth.gap.lo)) {
    out.undecided = true;  // nothing is known about the gap
    return;
  }
  const double error = outside(d, truth.gap);
  out.error(error, l, tau);
  // An overlapping mesh has distance 0 but no depth.
  if (truth.verdict == referee::Verdict::overlap && !std::isfinite(truth.gap.lo) && d < -tau)
    out.not_judged("depth", true);
  const bool is_open = std::isfinite(truth.gap.lo) && std::max(d - truth.gap.lo, truth.gap.hi - d) > tau;
  if (error <= tau && is_open && truth.verdict == referee::Verdict::overlap &&
      (in.is_mesh(a) || in.is_mesh(b)))
    out.not_judged("a solid's depth within its bracket", true);
  if (error <= tau) return;
  const double mid = std::isfinite(truth.gap.lo) ? (truth.gap.lo + truth.gap.hi) / 2 : truth.gap.hi;
  Fault f = Fault::distance_off;
  if (truth.verdict == referee::Verdict::overlap && d > tau && truth.gap.hi < -tau) f = Fault::missed;
  if (truth.verdict == referee::Verdict::disjoint && d < -tau && truth.gap.lo > tau) f = Fault::ghost;
  out.fault(
      f, error, l, in.query, words_of(d, mid, error),
      truth.verdict == referee::Verdict::overlap && d < 0
          ? referee::depth_certificate(truth, in.truth.placed(in.frame, a), in.truth.placed(in.frame, b))
          : truth.verdict_certificate);
}

namespace {

// Bracket of |gap|; when the sign is open, anything from 0 to the larger end.
referee::Bracket magnitude(const referee::Bracket& gap) {
  if (gap.hi < 0) return {-gap.hi, -gap.lo};
  if (gap.lo > 0) return gap;
  return {0, std::max(-gap.lo, gap.hi)};
}

}  // namespace

void check_witness(const CheckInput& in, CheckOutput& out) {
  if (!in.answer.witness) return;
  const auto [a, b] = std::pair{in.query.a, in.query.b};
  const referee::PairTruth& truth = in.truth.pair(in.frame, a, b);
  const double l = in.truth.scale(a, b), tau = in.tau(l);
  const auto& [pa, pb] = *in.answer.witness;
  if (!pa.allFinite() || !pb.allFinite()) {
    out.fault_always(Fault::witness_off, 0, in.query, "a witness point is not finite");
    return;
  }
  double worst =
      std::max(in.truth.distance_to(in.frame, a, pa, tau).lo, in.truth.distance_to(in.frame, b, pb, tau).lo);
  std::string words = fmt::format("a witness point is {:.6g} away from its body", worst);
  if (std::isfinite(truth.gap.lo)) {
    const referee::Bracket size = magnitude(truth.gap);
    const double apart = outside((pb - pa).stableNorm(), size);
    if (apart > worst) {
      worst = apart;
      words = fmt::format("the witness points are {:.9g} apart, |g| is {:.9g}", (pb - pa).stableNorm(),
                          (size.lo + size.hi) / 2);
    }
  } else {
    out.not_judged("how far the witness points are apart", true);
  }
  out.error(worst, l, tau);
  if (worst > tau)
    out.fault(Fault::witness_off, worst, l, in.query, std::move(words), truth.verdict_certificate);
}

}  // namespace touchstone::fuzz
