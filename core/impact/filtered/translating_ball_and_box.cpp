#include <array>
#include <cmath>

#include "core/impact/filtered/translation.h"

namespace touchstone::impact::filtered {
namespace {

// Squared distance of the centre from the box as a quadratic in the time from now, over the coordinates that
// are outside their slabs now: a τ² + 2 b τ + c, less R².
struct Piece {
  double a = 0, b = 0, c = 0;
  double next = std::numeric_limits<double>::infinity();  // when a coordinate enters or leaves its slab
  int which = -1;
};

// p: centre, w: its velocity; side[k]: −1, 0, 1 for below, in, above slab k.
Piece piece(const Vec& p, const Vec& w, const Vec& h, const std::array<int, 3>& side, double radius_sq) {
  Piece q;
  q.c = -radius_sq;
  for (int k = 0; k < 3; ++k) {
    const int s = side[static_cast<std::size_t>(k)];
    double until = std::numeric_limits<double>::infinity();
    if (s != 0) {
      const double e = s * p[k] - h[k], d = s * w[k];
      q.a += d * d;
      q.b += e * d;
      q.c += e * e;
      if (d < 0) until = std::max(0.0, e / -d);
    } else if (w[k] != 0) {
      until = std::max(0.0, (h[k] - std::copysign(p[k], p[k] * w[k])) / std::abs(w[k]));
    }
    if (until < q.next) {
      q.next = until;
      q.which = k;
    }
  }
  return q;
}

// Centre and velocity in the box's frame.
struct Ray {
  Vec p, v, half;
  double radius;
  double error(double t) const {
    const double fixed = 5 * p.norm() + 4 * radius + 4 * half.norm();
    return u<double> * bound_margin * (fixed + 16 * (p + t * v).norm() + 6 * t * v.norm());
  }
  double error_at_contact() const {
    return u<double> * (20 * (half.norm() + radius) + 5 * p.norm() + 6 * v.norm());
  }
  Vec outward(double t) const {
    const Vec x = p + t * v;
    return x - x.cwiseMax(-half).cwiseMin(half);
  }
};

struct Meeting {
  bool hit = false;
  double t = 0;  // of the hit, or of the nearest approach
};

// First time in [0,1] at which the centre is `reach` from the box, up to rounding. Precondition: farther at
// 0. Each slab is entered and left at most once.
Meeting meet(const Ray& ray, double reach) {
  Vec p = ray.p;
  std::array<int, 3> side;
  for (int k = 0; k < 3; ++k)
    side[static_cast<std::size_t>(k)] = p[k] > ray.half[k] ? 1 : (p[k] < -ray.half[k] ? -1 : 0);
  double t = 0;
  for (int i = 0; i < 7; ++i) {
    const Piece q = piece(p, ray.v, ray.half, side, reach * reach);
    const double disc = q.b * q.b - q.a * q.c;
    if (q.b < 0 && disc >= 0) {
      const double root = q.c / (-q.b + std::sqrt(disc));
      if (root <= q.next) return t + root <= 1 ? Meeting{true, t + root} : Meeting{false, 1};
    }
    const double turn = q.a > 0 ? -q.b / q.a : 0;
    if (q.b >= 0 || turn <= q.next) return {false, std::min(1.0, t + std::max(0.0, turn))};
    t += q.next;
    if (!(t < 1)) break;
    p = ray.p + t * ray.v;
    const int k = q.which;
    int& s = side[static_cast<std::size_t>(k)];
    p[k] = s != 0 ? s * ray.half[k] : std::copysign(ray.half[k], ray.v[k]);
    s = s != 0 ? 0 : (ray.v[k] > 0 ? 1 : -1);
  }
  return {false, 1};
}

}  // namespace

Search translating_ball_and_box(const Translation& m, double radius, const Vec& h, double accuracy) {
  const Mat r = matrix(m.b);
  const Ray ray{r.transpose() * (m.a.t - m.b.t), r.transpose() * -m.velocity, h, radius};
  const double reach = radius + aimed_errors * ray.error_at_contact();
  if (!(ray.outward(0).norm() > reach)) return {.end = SearchEnd::unsure};
  const Meeting found = meet(ray, reach);
  const Vec v = ray.outward(found.t);
  const double dist = v.norm();
  if (!(dist > 0)) return {.end = SearchEnd::unsure};
  // The separation along n, at 0 and at 1; at the time itself it equals the gap up to rounding.
  const Vec n = v / dist;
  const double rate = n.dot(ray.v);
  const double s = n.dot(ray.p + found.t * ray.v) - n.cwiseAbs().dot(h) - radius;
  if (!(s - found.t * rate > certain_errors * ray.error(0))) return {.end = SearchEnd::unsure};
  if (!found.hit) {
    const bool clear = s + (1 - found.t) * rate > certain_errors * ray.error(1);
    return {.end = clear ? SearchEnd::clear : SearchEnd::unsure, .clear_until = 1, .steps = 1};
  }
  const double e = ray.error(found.t), gap = dist - radius;
  if (!(s > certain_errors * e && gap + e <= accuracy)) return {.end = SearchEnd::unsure};
  Search out{.end = SearchEnd::hit, .clear_until = found.t, .gap = gap, .steps = 1};
  out.normal = r * -n;
  out.a = out.normal * radius;
  out.b = out.normal * dist;
  return out;
}

}  // namespace touchstone::impact::filtered
