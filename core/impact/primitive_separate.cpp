#include "core/impact/primitive_separate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::impact {
namespace {

// The component of `w` orthogonal to the edge direction d. Computed twice: the error of the first result is
// u·|w|, which may be all of it; the second is orthogonal up to its own rounding.
Vec3 across(const Vec3& w, const Vec3& d, double d_sq) {
  const Vec3 once = w - (w.dot(d) / d_sq) * d;
  return once - (once.dot(d) / d_sq) * d;
}

struct Nearest {
  double dist_sq = std::numeric_limits<double>::infinity();
  Vec3 direction = Vec3::Zero();
};

// Updates the point of the boundary nearest to the origin. A corner is accurate to u of itself, a point
// inside an edge as `across` makes it.
void test_edge(const Vec3& a, const Vec3& b, Nearest& best) {
  const Vec3 d = b - a;
  const double d_sq = d.squaredNorm(), s = -a.dot(d);
  const bool inside = s > 0 && s < d_sq;
  const Vec3 w = inside ? across(a, d, d_sq) : (s <= 0 ? a : b);
  const double dist_sq = w.squaredNorm();
  if (dist_sq < best.dist_sq) best = {dist_sq, w};
}

void add(Directions& out, const Vec3& w) {
  const double length = w.norm();
  if (length > 0 && length < std::numeric_limits<double>::infinity()) out.n[out.count++] = w / length;
}

}  // namespace

Directions separating_directions(const MovingPolygon& p, double t) {
  const Corners w = corners_at(p, t);
  const std::size_t m = p.corners;
  const Vec3 across_0 = w[1] - w[0], across_1 = w[m - 1] - w[0];
  Vec3 normal = across_0.cross(across_1);
  if (normal.dot(w[0]) < 0) normal = -normal;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  Nearest boundary;
  for (std::size_t k = 0; k < m; ++k) {
    const Vec3& next = w[k + 1 == m ? 0 : k + 1];
    const double side = normal.dot(w[k].cross(next));
    least = std::min(least, side);
    most = std::max(most, side);
    test_edge(w[k], next, boundary);
  }
  Directions out;
  if (least >= 0 || most <= 0) {
    add(out, normal);
    add(out, boundary.direction);
  } else {
    add(out, boundary.direction);
    add(out, normal);
  }
  return out;
}

// Error of a projection in units of u·S, from the bound in the header.
constexpr double error_units = 16;
// Rounding of a product with |n|, in u, with room.
constexpr int norm_rounding = 16;

Clearance clear_along(const MovingPolygon& p, const Vec3& n, double t, double min_separation) {
  std::array<double, 4> s0, s1;
  const double error =
      error_units * double_roundoff * n.cwiseAbs().dot(p.size) + std::numeric_limits<double>::min();
  const double need = min_separation * n.norm() * (1 + norm_rounding * double_roundoff) + error;
  const auto value = [&](std::size_t k, double at) { return (1 - at) * s0[k] + at * s1[k]; };
  Clearance r{t, std::numeric_limits<double>::infinity()};
  if (!(need < std::numeric_limits<double>::infinity())) return r;
  double until = 1;
  for (std::size_t k = 0; k < p.corners; ++k) {
    s0[k] = n.dot(p.start[k]);
    s1[k] = n.dot(p.end[k]);
    const double now = value(k, t);
    r.separation = std::min(r.separation, now);
    // Aims one error beyond what is required, which covers the rounding of the quotient.
    if (!(s1[k] >= need))
      until = std::min(until, t + (1 - t) * std::max(0.0, (now - need - error) / (now - s1[k])));
  }
  if (!(r.separation >= need) || !(until > t)) return r;
  for (std::size_t k = 0; k < p.corners; ++k)
    if (!(value(k, until) >= need)) return r;
  r.until = until;
  return r;
}

}  // namespace touchstone::impact
