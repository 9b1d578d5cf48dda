// Answers two questions with Bernstein coefficients over [t₀, t₁] (a polynomial lies within their range). Up
// to when is the volume non-zero? As long as its four coefficients have the same proven sign. Does the
// polygon contain the origin at some time? Yes, if
// * the volume has proven opposite signs at t₀ and t₁: at some time in between, the origin lies in the plane;
// * along one fixed direction n, every n·(w_k × w_{k+1}), a quadratic in time, has proven positive
//   coefficients: seen along n, the origin is inside the polygon, whose plane therefore does not contain n.
//
// Bounds. Corners are accurate to e_c = 4.1u·M_c (primitive_polygon.h); L_c bounds their true and computed
// components at t₀ and t₁. For a product of three, x·y·z, the errors add up to
// e_x·L_y·L_z + L_x·e_y·L_z + L_x·L_y·e_z. With Q = M_x·L_y·L_z + L_x·M_y·L_z + L_x·L_y·M_z >= 3·L_x·L_y·L_z,
// a determinant of six such products, 5u of rounding each, is accurate to 24.6u·Q + 10u·Q; the mean of three
// of them adds 8u·Q: 48u·Q. For n·(a × b), with P_c = M_i·L_j + L_i·M_j for the two other axes: 8.2u·P and
// 7u·P of rounding: 20u·Σ|n_c|·P_c. These bounds are relative, hence invalid where products underflow; there,
// nothing is claimed.
#include "core/impact/primitive_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/roundoff.h"

namespace touchstone::impact {
namespace {

// Range of the sizes for which the bounds hold in spite of underflow (volume_bound).
constexpr double least_size = 0x1p-200, largest_size = 0x1p+300;
// The bounds above, in u·Q and u·Σ|n_c|·P_c.
constexpr int volume_error = 48, side_error = 20;
// Half lengths of the intervals of time that crosses_near() tries.
constexpr double crossing_reaches[] = {0x1p-40, 0x1p-32, 0x1p-24, 0x1p-16, 0x1p-9, 0x1p-4};
// Share by which a step ends before the computed root, to cover the rounding of the quotient.
constexpr double step_margin = 0x1p-20;

// Products of two components, in the order yz, zx, xy.
Vec3 pairs(const Vec3& a, const Vec3& b) { return {a.y() * b.z(), a.z() * b.x(), a.x() * b.y()}; }

bool is_in_range(const MovingPolygon& p) {
  return p.size.minCoeff() > least_size && p.size.maxCoeff() < largest_size;
}

// With M between 2⁻²⁰⁰ and 2³⁰⁰ and L >= 8u·M, the bound is more than u·2⁻⁷⁰⁰; an underflow in a product of
// two, 2⁻¹⁰⁷⁴, becomes at most 2⁻⁷⁷⁰ with the third factor.
double volume_bound(const MovingPolygon& p, const Vec3& local) {
  return volume_error * double_roundoff * p.size.dot(pairs(local, local));
}

double volume_at(const MovingPolygon& p, const Corners& w) { return w[0].dot(w[1].cross(w[p.corners - 1])); }

std::array<double, 4> volume_coefficients(const MovingPolygon& p, const Corners& a, const Corners& b) {
  const std::size_t last = p.corners - 1;
  const Vec3 aa = a[1].cross(a[last]), bb = b[1].cross(b[last]),
             ab = a[1].cross(b[last]) + b[1].cross(a[last]);
  return {a[0].dot(aa), (b[0].dot(aa) + a[0].dot(ab)) / 3, (a[0].dot(bb) + b[0].dot(ab)) / 3, b[0].dot(bb)};
}

// The parameter in [0,1] at which the convex hull of the coefficients first falls to `level`; 1 if it does
// not.
double hull_reaches(const std::array<double, 4>& c, double level) {
  double first = 1;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 4; ++j) {
      const double from = c[static_cast<std::size_t>(i)], to = c[static_cast<std::size_t>(j)];
      if (from > level && to < level)
        first = std::min(first, (i + (j - i) * ((from - level) / (from - to))) / 3);
    }
  return first;
}

int proven_side(const MovingPolygon& p, const Corners& w) {
  const double volume = volume_at(p, w), bound = volume_bound(p, local_size(p, w, w));
  return volume > bound ? 1 : (volume < -bound ? -1 : 0);
}

bool stays_inside(const MovingPolygon& p, const Corners& from, const Corners& to, const Vec3& n) {
  const Vec3 local = local_size(p, from, to);
  const double bound =
      side_error * double_roundoff * n.cwiseAbs().dot(pairs(p.size, local) + pairs(local, p.size)) +
      std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < p.corners; ++k) {
    const std::size_t l = k + 1 == p.corners ? 0 : k + 1;
    const double first = n.dot(from[k].cross(from[l])), last = n.dot(to[k].cross(to[l]));
    const double middle = 0.5 * n.dot(from[k].cross(to[l]) + to[k].cross(from[l]));
    if (!(first > bound && middle > bound && last > bound)) return false;
  }
  return true;
}

}  // namespace

double volume_clear_until(const MovingPolygon& p, double t) {
  if (!is_in_range(p)) return t;
  const Corners from = corners_at(p, t);
  const double sign = volume_at(p, from) < 0 ? -1 : 1;
  double until = 1, clear = t;
  // Each round keeps what the hull of the previous one allows and converges to the root from the left. Two
  // rounds usually suffice; what four leave over is not lost, because the next direction starts from there.
  for (int round = 0; round < 4 && until > clear; ++round) {
    const Corners to = corners_at(p, until);
    std::array<double, 4> c = volume_coefficients(p, from, to);
    for (double& x : c) x *= sign;
    const double bound = volume_bound(p, local_size(p, from, to));
    if (!(c[0] > bound)) return clear;
    if (*std::min_element(c.begin(), c.end()) > bound) return until;
    until = t + (until - t) * hull_reaches(c, 2 * bound) * (1 - step_margin);
  }
  return clear;
}

bool crosses_near(const MovingPolygon& p, double t) {
  if (!is_in_range(p)) return false;
  // Tries a sequence of intervals: in a shorter one the sides are lost in rounding, in a longer one the
  // origin leaves the polygon.
  for (const double reach : crossing_reaches) {
    const Corners from = corners_at(p, std::max(0.0, t - reach)),
                  to = corners_at(p, std::min(1.0, t + reach));
    const int side = proven_side(p, from);
    if (side == 0 || proven_side(p, to) != -side) continue;
    Vec3 n = (from[1] - from[0]).cross(from[p.corners - 1] - from[0]);
    const double length = n.norm();
    if (!(length > 0 && length < infinity)) return false;
    if (stays_inside(p, from, to, n / length)) return true;
  }
  return false;
}

}  // namespace touchstone::impact
