#include "oracles/referee/filter/half_space.h"

#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/counters.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

// A normal turned by a matrix, relative to the largest entries of both: three components, each a dot product.
constexpr Real turned_normal_rounding = 12 * unit;

struct Bounds {
  Real lo, hi;
};

// (m·x - offset)/|m| for |x| <= extent, x known within `error`: the products carry 4 units each, and |m| is
// an interval.
Bounds signed_distance(const Plane& p, Real m_dot_x, Real extent, Real error) {
  const Real length = norm(p.normal), length_error = 2 * p.normal_error + value_rounding * length;
  const Real value = m_dot_x - p.offset;
  const Real slack = 2 * p.normal_error * extent + length * (error + dot_rounding * extent) + p.offset_error +
                     value_rounding * (std::fabs(p.offset) + std::fabs(m_dot_x));
  const auto divide = [&](Real x, bool down) {
    const Real by = (x > 0) == down ? length + length_error : length - length_error;
    const Real q = x / by;
    return down ? q - value_rounding * std::fabs(q) : q + value_rounding * std::fabs(q);
  };
  return {divide(value - slack, true), divide(value + slack, false)};
}

Verdict exact_verdict(const Placed& h, const ExactBody& body) {
  const RationalPlane p = world_plane(h);
  Rational least;
  bool first = true;
  for (const Rational3& x : world_points(body)) {
    const Rational d = dot(p.normal, x) - p.offset;
    if (first || d < least) least = d;
    first = false;
  }
  const Rational r = exact(body.radius);
  const bool disjoint = least > 0 && least * least > r * r * dot(p.normal, p.normal);
  return disjoint ? Verdict::disjoint : Verdict::overlap;
}

void settle_exactly(ConvexTruth& t, const Placed& h, const ExactBody& body) {
  const auto& plane = std::get<HalfSpace>(*h.shape);
  if (const auto* pose = std::get_if<Pose>(&h.pose))
    if (const auto overlap = overlaps_half_space_short(plane.normal, plane.offset, *pose, body)) {
      t.verdict = *overlap ? Verdict::overlap : Verdict::disjoint;
      return;
    }
  t.verdict = exact_verdict(h, body);
  t.level = 2;
  ++counters().exact;
}

}  // namespace

std::optional<Plane> plane_of(const Placed& half_space, const Vec3& origin) {
  const auto& h = std::get<HalfSpace>(*half_space.shape);
  const Frame f = frame_of(half_space, origin);
  const Real3 n = to_real(h.normal);
  Plane p;
  const Real size = largest(n);
  if (std::holds_alternative<Pose>(half_space.pose)) {
    p.normal = f.matrix * n;
    p.normal_error = (3 * f.matrix_error + turned_normal_rounding) * size;
    p.offset = h.offset;
  } else {
    // {M x + t : n·x <= d} = {y : cof(M) n·(y - t) <= d det M}, with the sign of det M.
    const RationalPlane exact_plane = world_plane(half_space);
    if (is_zero(exact_plane.normal)) return std::nullopt;
    // Products of a few doubles stay within the range of Real.
    const auto as_real = [](const Rational& x) { return x.convert_to<Real>(); };
    p.normal = {as_real(exact_plane.normal.x), as_real(exact_plane.normal.y), as_real(exact_plane.normal.z)};
    p.normal_error = value_rounding * largest(p.normal);
    const Rational at_origin = exact_plane.offset - dot(exact_plane.normal, exact(origin));
    p.offset = as_real(at_origin);
    p.offset_error = value_rounding * std::fabs(p.offset);
    return p;
  }
  const Real shift = dot(p.normal, f.translation);
  p.offset += shift;
  const Real reach = 2 * largest(f.translation);
  p.offset_error = reach * (2 * p.normal_error + dot_rounding * largest(p.normal)) +
                   2 * f.translation_error * largest(p.normal) +
                   value_rounding * (std::fabs(p.offset) + std::fabs(shift));
  return p;
}

ConvexTruth judge_half_space(const Placed& h, const Operand& body, const Vec3& origin) {
  ++counters().convex_pairs;
  spend(2000 + 4 * static_cast<std::int64_t>(body.body.points.size()));
  ConvexTruth t;
  t.lo = -infinity;
  t.hi = infinity;
  const auto p = plane_of(h, origin);
  if (!p) return t;
  const Solid& b = body.body;
  const SupportPoint<Real> s = support(b, -p->normal);
  const Bounds g = signed_distance(*p, dot(p->normal, s.point), b.extent, b.error);
  t.lo = g.lo - b.radius;
  t.lo -= unit * std::fabs(t.lo);
  t.hi = g.hi - b.radius;
  t.hi += unit * std::fabs(t.hi);
  t.normal = normalized(p->normal);
  t.verdict = t.lo > 0 ? Verdict::disjoint : t.hi <= 0 ? Verdict::overlap : Verdict::undecided;
  t.witness_b = s.point - static_cast<Real>(b.radius) * t.normal;
  t.witness_a = t.witness_b - (0.5L * (t.lo + t.hi)) * t.normal;
  t.common = t.witness_b;
  if (t.verdict == Verdict::undecided && body.has_exact()) {
    settle_exactly(t, h, body.exact_body());
    if (t.verdict == Verdict::overlap) {
      t.hi = std::min(t.hi, Real{0});
      t.lo = std::min(t.lo, Real{0});
    } else {
      t.lo = std::max(t.lo, Real{0});
    }
  }
  if (t.verdict == Verdict::undecided) ++counters().undecided;
  if (t.verdict != Verdict::undecided && t.level == 1) ++counters().extended;
  return t;
}

// A point of both half-spaces {x : u·x <= o} and {x : v·x <= p}, u and v unit vectors that are not
// antiparallel: far enough against u + v.
static Real3 point_of_both(const Plane& x, const Plane& y) {
  const Real3 u = normalized(x.normal), v = normalized(y.normal);
  const Real3 sum = u + v;
  const Real along = dot(sum, u), farther = 2;
  if (!(along > 0)) return {0, 0, 0};
  const Real o = x.offset / norm(x.normal), p = y.offset / norm(y.normal);
  return -(farther * std::max({Real{0}, -o, -p}) / along) * sum;
}

ConvexTruth judge_half_spaces(const Placed& a, const Placed& b, const Vec3& origin) {
  ConvexTruth t;
  t.lo = -infinity;
  t.hi = infinity;
  const auto p = plane_of(a, origin), q = plane_of(b, origin);
  if (!p || !q) return t;
  t.level = 2;
  t.normal = normalized(p->normal);
  const std::optional<Rational> between = distance_of_half_spaces(world_plane(a), world_plane(b));
  if (!between) {
    t.verdict = Verdict::overlap;
    t.lo = t.hi = -infinity;
    t.common = point_of_both(*p, *q);
    t.witness_a = t.witness_b = t.common;
    return t;
  }
  t.verdict = *between > 0 ? Verdict::disjoint : Verdict::overlap;
  const Real length = norm(p->normal), value = between->convert_to<Real>() / length;
  const Real slack =
      projection_rounding * std::fabs(value) + std::fabs(value) * 4 * (p->normal_error / length);
  t.lo = value - slack;
  t.hi = value + slack;
  t.witness_a = (p->offset / length) * t.normal;
  t.witness_b = t.witness_a + value * t.normal;
  t.common = 0.5L * (t.witness_a + t.witness_b);
  return t;
}

}  // namespace touchstone::referee
