// with_witness: B is moved along the normal until it is clear of A. Where the normal is a direction of least
// depth, bodies moved that far by just the depth touch, and the nearest points after a larger motion along it
// are the points that touch.
#include <algorithm>
#include <cmath>
#include <variant>

#include "oracles/referee/filter/convex.h"
#include "oracles/referee/referee.h"
#include "oracles/referee/solid/solid.h"

namespace touchstone::referee {
namespace {

// Points realise the depth if they are off by this part of the bodies' size.
constexpr double witness_slack = 1e-7;

double depth_of(const PairTruth& t) { return -0.5 * (t.gap.lo + t.gap.hi); }

double error_of(const PairTruth& t) {
  return (t.witness[0] - t.witness[1] - depth_of(t) * t.normal).stableNorm();
}

}  // namespace

PairTruth with_witness(PairTruth t, const Placed& a, const Placed& b) {
  if (has_solid(a, b)) {
    const AsHulls hulls(a, b);
    return hulls.are_plain() ? with_witness(std::move(t), hulls.a(), hulls.b()) : t;
  }
  const bool convex = !is<HalfSpace>(a) && !is<HalfSpace>(b) && !is<TriangleMesh>(a) && !is<TriangleMesh>(b);
  if (t.verdict != Verdict::overlap || !convex || !std::isfinite(t.gap.lo) || t.normal.isZero(0)) return t;
  const double size = bounding_radius(*a.shape) + bounding_radius(*b.shape);
  const double error = error_of(t);
  if (error <= witness_slack * size) return t;
  const Vec3 way = (std::max(0.0, depth_of(t)) + size) * t.normal;
  const PairTruth apart = judge_pair(a, with_translation(b, translation_of(b) + way));
  PairTruth better = t;
  better.witness = {apart.witness[0], apart.witness[1] - way};
  return apart.verdict == Verdict::disjoint && error_of(better) < error ? better : t;
}

}  // namespace touchstone::referee
