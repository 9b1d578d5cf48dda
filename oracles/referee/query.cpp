// width, distance_to and outer_box: support values with their error bounds.
#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/filter/half_space.h"
#include "oracles/referee/filter/point_distance.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

template <class S>
const S* get(const Placed& p) {
  return std::get_if<S>(p.shape);
}

/// A mesh is replaced by the hull of its vertices, which has the same support function.
Solid hull_body(const Placed& p, const Vec3& origin) {
  if (const TriangleMesh* m = triangles_if(*p.shape)) return make_body(m->vertices, 0, frame_of(p, origin));
  return make_body(p, frame_of(p, origin));
}

Bracket outward(Real lo, Real hi) { return {round_down(lo), round_up(hi)}; }

// depth/cos: B leaves the half-space A by moving depth/cos(n, m) along n. The error of m carries over into
// the cosine.
Bracket half_space_width(const Placed& a, const Placed& b, const Vec3& n, bool a_is_half_space) {
  const Vec3 origin = translation_of(a_is_half_space ? b : a);
  const Placed &h = a_is_half_space ? a : b, &other = a_is_half_space ? b : a;
  ConvexTruth t;
  if (get<HalfSpace>(other)) {
    t = judge_half_spaces(h, other, origin);
    if (!std::isfinite(static_cast<double>(t.lo))) return {infinity, infinity};
  } else {
    t = judge_half_space(h, Operand{hull_body(other, origin), std::nullopt}, origin);
  }
  const Real3 m = a_is_half_space ? t.normal : -t.normal;
  const Real3 u = normalized(to_real(n));
  // Both are within 16 units of the exact unit vectors for a Pose.
  const Real c = dot(u, m), c_error = chain_rounding;
  if (!(c > c_error)) return {c < -c_error ? infinity : -infinity, infinity};
  const auto over = [&](Real x, bool down) {
    const Real q = x / ((x > 0) == down ? c + c_error : c - c_error);
    return down ? q - value_rounding * std::fabs(q) : q + value_rounding * std::fabs(q);
  };
  return outward(over(-t.hi, true), over(-t.lo, false));
}

Bracket half_space_distance(const Placed& a, const Vec3& point) {
  static const Shape dot_shape = Sphere{0};
  const Placed p{&dot_shape, Pose{point, {}}};
  const ConvexTruth t = judge_half_space(a, make_operand(p, point), point);
  if (t.verdict == Verdict::overlap) return {0, 0};
  return {std::max(0.0, round_down(t.lo)), std::max(0.0, round_up(t.hi))};
}

}  // namespace

Aabb box_of(const Solid& b) {
  Aabb box;
  for (int k = 0; k < 3; ++k) {
    const Real3 n{k == 0 ? 1.0L : 0.0L, k == 1 ? 1.0L : 0.0L, k == 2 ? 1.0L : 0.0L};
    const Real slack = b.error + b.radius + value_rounding * (b.extent + b.radius);
    box.hi[k] = round_up(dot(n, support(b, n).point) + slack);
    box.lo[k] = round_down(dot(n, support(b, -n).point) - slack);
  }
  return box;
}

Bracket width(const Placed& a, const Placed& b, const Vec3& n) {
  if (has_solid(a, b)) {
    const AsHulls hulls(a, b);
    const bool has_surface = get<TriangleMesh>(hulls.a()) || get<TriangleMesh>(hulls.b());
    if (!hulls.are_plain() && !has_surface)
      return within_limit(Bracket{0, infinity}, [&] { return way_along(hulls.a(), hulls.b(), n); });
  }
  if (get<HalfSpace>(a) || get<HalfSpace>(b)) return half_space_width(a, b, n, get<HalfSpace>(a) != nullptr);
  const Vec3 origin = translation_of(a);
  const Solid x = hull_body(a, origin), y = hull_body(b, origin);
  const Difference d(x, y);
  const Real3 u = normalized(to_real(n));
  const Real above = d.width_above(d.support(u), u),
             slack = 2 * (d.error + dot_rounding * d.extent) + d.radius_error;
  return outward(above + d.radius - slack - value_rounding * std::fabs(above),
                 above + d.radius + d.radius_error + value_rounding * std::fabs(above));
}

namespace {

Bracket from_body(const Placed& a, const Vec3& point_w, double enough) {
  if (get<HalfSpace>(a)) return half_space_distance(a, point_w);
  if (is_solid(a)) {
    const AsSurface surface(a);
    return is_inside(a, exact(point_w)) ? Bracket{0, 0} : from_body(*surface, point_w, enough);
  }
  const auto from_zero = [](Real lo, Real hi) -> Bracket {
    return {std::max(0.0, round_down(lo)), std::max(0.0, round_up(hi))};
  };
  static const Shape dot_shape = Sphere{0};
  const Placed p{&dot_shape, Pose{point_w, {}}};
  if (const auto* m = get<TriangleMesh>(a)) {
    const auto [lo, hi] = origin_to_triangles(hull_body(a, point_w), m->triangles);
    if (hi <= enough) return from_zero(lo, hi);
  } else {
    const Operand x = make_operand(a, point_w);
    if (const auto near = origin_to_curved(x.body); near && (*near)[1] <= enough)
      return from_zero((*near)[0], (*near)[1]);
    if (const auto near = gap_at_most(x, make_operand(p, point_w), enough))
      return from_zero((*near)[0], (*near)[1]);
  }
  const ConvexTruth t =
      judge_parts(parts_of(a, point_w), parts_of(p, point_w), get<TriangleMesh>(a) != nullptr);
  if (t.verdict == Verdict::overlap) return {0, 0};
  return from_zero(t.lo, t.hi);
}

}  // namespace

Bracket distance_to(const Placed& a, const Vec3& point_w, double enough) {
  return within_limit(Bracket{0, infinity}, [&] { return from_body(a, point_w, enough); });
}

double certain_depth_of_solids(const Placed& a, const Placed& b) {
  return within_limit(0.0, [&] { return depth_at_least(a, b); });
}

Aabb outer_box(const Placed& a) {
  if (get<HalfSpace>(a)) {
    // A half-space is unbounded along every axis except one that is exactly along its normal.
    Aabb box{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
    const RationalPlane p = world_plane(a);
    for (int k = 0; k < 3; ++k) {
      if (p.normal[k] == 0 || p.normal[(k + 1) % 3] != 0 || p.normal[(k + 2) % 3] != 0) continue;
      const Rational bound = p.offset / p.normal[k];
      const double nearest = bound.convert_to<double>();
      if (p.normal[k] > 0)
        box.hi[k] = exact(nearest) < bound ? std::nextafter(nearest, infinity) : nearest;
      else
        box.lo[k] = exact(nearest) > bound ? std::nextafter(nearest, -infinity) : nearest;
    }
    return box;
  }
  return box_of(hull_body(a, Vec3::Zero()));
}

}  // namespace touchstone::referee
