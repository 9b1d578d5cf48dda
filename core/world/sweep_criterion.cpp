#include "core/world/sweep_criterion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// About ten roundings lie between a shape's numbers and a radius or a bound.
constexpr double down = 1 - 0x1p-40, up = 1 + 0x1p-40;
// A triangle whose normal is shorter than this, relative to its sides, is a sliver: its plane is unreliable.
constexpr double thinnest_triangle = 0x1p-30;
// Rounding of a face's plane, relative to the size of the hull.
constexpr double plane_rounding = 0x1p-20;

struct Radii {
  double inner = 0, about_origin = 0;
};

Radii both(double r) { return {r, r}; }

// The least distance from `p` to the planes of the faces, minus a margin for the rounding of the faces; < 0
// outside.
double clearance(const Hull& h, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity(), size = 0;
  for (const Vec3& v : h.vertices) size = std::max(size, (v - p).norm());
  for (const auto& f : h.faces) {
    const Vec3 &a = h.vertices[static_cast<std::size_t>(f[0])],
               &b = h.vertices[static_cast<std::size_t>(f[1])],
               &c = h.vertices[static_cast<std::size_t>(f[2])];
    const Vec3 u = b - a, v = c - a, n = u.cross(v);
    const double area = n.norm();
    // The plane of a sliver is unreliable: claim no clearance.
    if (!(area > thinnest_triangle * u.norm() * v.norm())) return 0;
    least = std::min(least, n.dot(a - p) / area);
  }
  return h.faces.empty() ? 0 : least - plane_rounding * size;
}

struct InscribedBall {
  Radii operator()(const Sphere& s) const { return both(s.radius); }
  Radii operator()(const Box& s) const { return both(s.half_extents.minCoeff()); }
  Radii operator()(const Capsule& s) const { return both(s.radius); }
  Radii operator()(const RoundedBox& s) const { return both(s.half_extents.minCoeff() + s.radius); }
  Radii operator()(const Cylinder& s) const { return both(std::min(s.radius, s.half_height)); }
  Radii operator()(const Ellipsoid& s) const { return both(s.semi_axes.minCoeff()); }
  // In the triangle with half base R and height H: its incircle; about the origin, at half height, the
  // distances to base and side.
  Radii operator()(const Cone& s) const {
    const double height = 2 * s.half_height, side = std::hypot(s.radius, height);
    if (!(side > 0)) return {};
    return {s.radius * height / (s.radius + side), std::min(s.half_height, s.radius / 2 * height / side)};
  }
  Radii operator()(const Hull& s) const {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& v : s.vertices) mean += v / static_cast<double>(s.vertices.size());
    const double about_origin = clearance(s, Vec3::Zero()), about_mean = std::max(0.0, clearance(s, mean));
    if (about_origin > 0) return {std::max(about_origin, about_mean), about_origin};
    double nearest = s.vertices.front().norm();
    for (const Vec3& v : s.vertices) nearest = std::min(nearest, v.norm());
    return {about_mean, -nearest};
  }
  Radii operator()(const HalfSpace&) const { return both(std::numeric_limits<double>::infinity()); }
  Radii operator()(const TriangleMesh& m) const {
    double farthest = 0;
    for (const Vec3& v : m.vertices) farthest = std::max(farthest, v.norm());
    return {0, -farthest};
  }
};

bool is_half_space(const InnerExtent& e) { return std::isinf(e.reach); }

}  // namespace

InnerExtent inner_extent(const Shape& shape) {
  const Radii r = std::visit(InscribedBall{}, shape);
  return {r.inner * down, r.about_origin * (r.about_origin > 0 ? down : up), bounding_radius(shape)};
}

double turn_bound(const InnerExtent& e, const Motion& m) {
  const double speed = m.angular.norm();
  if (speed == 0 || is_half_space(e)) return 0;
  return std::min(e.reach * speed / 2, e.reach - e.about_origin) * up;
}

double pass_bound(const InnerExtent& e, const Motion& m) {
  return m.linear.norm() / 2 * up + turn_bound(e, m);
}

double pass_bound(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb) {
  const bool passes = !is_half_space(a) && !is_half_space(b);
  const double travel = passes ? (ma.linear - mb.linear).norm() / 2 * up : 0;
  return travel + turn_bound(a, ma) + turn_bound(b, mb);
}

bool is_flagged(const InnerExtent& e, const Motion& m, double share) {
  return !is_half_space(e) && pass_bound(e, m) > share * e.inner;
}

bool needs_sweep(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb,
                 double share) {
  const double thickness = (is_half_space(a) ? 0 : a.inner) + (is_half_space(b) ? 0 : b.inner);
  return pass_bound(a, ma, b, mb) > share * thickness;
}

}  // namespace touchstone
