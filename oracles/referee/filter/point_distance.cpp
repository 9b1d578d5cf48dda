// Upper bound: a point y of the body as represented here is within `error` of the exact body (body.h), so the
// origin is at most |y| + error away, however y was found. Lower bound: the support plane in direction -y,
// which is the nearest plane when y is the nearest point. So the projections below need not be right, only
// good; the only cost is the rounding that may push y out of its shape.
//
// Cylinder and cone: a rectangle and a triangle in the meridian half-plane. Ellipsoid: Lagrange multiplier t
// with q_i = s_i² p_i / (s_i² + t), by Newton's method from t = 0, which for a point outside rises to the
// root (convex, falling); the result is scaled back onto the surface. Triangle: the nearest of the foot on
// its plane and those on its edges.
#include "oracles/referee/filter/point_distance.h"
#include "oracles/referee/work.h"

#include <cmath>

namespace touchstone::referee {
namespace {

// A local point is computed within 16 units of the shape's size, turned and placed within 8 more of the
// extent; a length and a difference of two dot products within 8.
constexpr Real rounding = 64 * unit;

Real3 with_radius(const Real3& p, Real rho, Real r, Real z) {
  const Real s = rho > 0 ? r / rho : 0;
  return {s * p.x, s * p.y, z};
}

Real3 onto_cylinder(const Real3& p, Real radius, Real half) {
  const Real rho = std::sqrt(p.x * p.x + p.y * p.y);
  return with_radius(p, rho, std::min(rho, radius), std::clamp(p.z, -half, half));
}

// Base of radius `radius` at z = -half, apex at z = half.
Real3 onto_cone(const Real3& p, Real radius, Real half) {
  const Real rho = std::sqrt(p.x * p.x + p.y * p.y);
  if (p.z <= -half) return with_radius(p, rho, std::min(rho, radius), -half);
  // Along the slant from the rim: (-radius, 2 half).
  const Real out = (rho - radius) * 2 * half + (p.z + half) * radius;
  if (out <= 0) return p;
  const Real along = (radius - rho) * radius + (p.z + half) * 2 * half;
  const Real t = std::clamp<Real>(along / (radius * radius + 4 * half * half), 0, 1);
  return with_radius(p, rho, radius * (1 - t), (2 * t - 1) * half);
}

Real3 onto_ellipsoid(const Real3& p, const Real3& s) {
  constexpr int newton_steps = 24;  // far away along the short axes the first ones are slow
  const auto height = [&](const Real3& q) {
    const Real3 u{q.x / s.x, q.y / s.y, q.z / s.z};
    return norm(u);
  };
  if (height(p) <= 1) return p;
  Real t = 0;
  const auto at = [&](int i) { return s[i] * s[i] * p[i] / (s[i] * s[i] + t); };
  for (int step = 0; step < newton_steps; ++step) {
    Real value = -1, slope = 0;
    for (int i = 0; i < 3; ++i) {
      const Real u = at(i) / s[i];
      value += u * u;
      slope -= 2 * u * u / (s[i] * s[i] + t);
    }
    if (!(value > 0) || !(slope < 0)) break;
    t -= value / slope;
  }
  const Real3 q{at(0), at(1), at(2)};
  const Real h = height(q);
  return h > 1 ? (1 / h) * q : q;
}

// The bracket given by a point y of the set and the set's support value in direction -y.
std::array<Real, 2> bracket(const Real3& y, Real reach, Real error, Real extent) {
  const Real slack = error + rounding * extent;
  return {-reach - slack, norm(y) + slack};
}

Real3 nearest_on_edge(const Real3& p, const Real3& q) {
  const Real3 d = q - p;
  const Real dd = dot(d, d), t = dd > 0 ? std::clamp<Real>(-dot(p, d) / dd, 0, 1) : 0;
  return (1 - t) * p + t * q;
}

Real3 nearest_on_triangle(const Real3& p, const Real3& q, const Real3& r) {
  const Real3 n = triangle_normal(p, q, r);
  const Real a = dot(cross(q, r), n), b = dot(cross(r, p), n), c = dot(cross(p, q), n);
  if (a > 0 && b > 0 && c > 0) {
    const Real sum = a + b + c;
    return (a / sum) * p + (b / sum) * q + (c / sum) * r;
  }
  Real3 best = nearest_on_edge(p, q);
  for (const Real3& y : {nearest_on_edge(q, r), nearest_on_edge(r, p)})
    if (dot(y, y) < dot(best, best)) best = y;
  return best;
}

}  // namespace

std::optional<std::array<Real, 2>> origin_to_curved(const Solid& b) {
  using Kind = Solid::Kind;
  if (b.is_swept || b.kind == Kind::points || b.kind == Kind::orbit) return std::nullopt;
  const Real3 p = transpose_times(b.matrix, -b.centre);
  const Real3 q = b.kind == Kind::cylinder ? onto_cylinder(p, b.size.x, b.size.y)
                  : b.kind == Kind::cone   ? onto_cone(p, b.size.x, b.size.y)
                                           : onto_ellipsoid(p, b.size);
  const Real3 y = b.matrix * q + b.centre;
  const Real3 towards = normalized(-y);
  return bracket(y, dot(towards, support(b, towards).point), b.error, b.extent);
}

std::array<Real, 2> origin_to_triangles(const Solid& points, std::span<const std::array<int, 3>> triangles) {
  spend(static_cast<std::int64_t>(triangles.size()) * 100);
  std::array<Real, 2> least{std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity()};
  for (const auto& [i, j, k] : triangles) {
    const auto at = [&](int v) -> const Real3& { return points.points[static_cast<std::size_t>(v)]; };
    const Real3 y = nearest_on_triangle(at(i), at(j), at(k)), towards = normalized(-y);
    const Real reach = std::max({dot(towards, at(i)), dot(towards, at(j)), dot(towards, at(k))});
    const auto [lo, hi] = bracket(y, reach, points.error, points.extent);
    least = {std::min(least[0], lo), std::min(least[1], hi)};
  }
  return least;
}

}  // namespace touchstone::referee
