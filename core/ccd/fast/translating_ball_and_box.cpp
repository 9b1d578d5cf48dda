#include <array>
#include <cmath>

#include "core/ccd/fast/translation.h"

namespace touchstone::ccd::fast {
namespace {

// Squared distance of the centre from the box, as a quadratic of the time from now, of the coordinates that
// are outside their slabs now: a τ² + 2 b τ + c, less R².
struct Piece {
  double a = 0, b = 0, c = 0;
  double next = std::numeric_limits<double>::infinity();  // when a coordinate enters or leaves its slab
  int which = -1;
};

// p: centre, w: its velocity; side[k]: −1, 0, 1, below, in, above the slab k.
Piece piece(const Vec& p, const Vec& w, const Vec& h, const std::array<int, 3>& side, double radius_sq) {
  Piece q;
  q.c = -radius_sq;
  for (int k = 0; k < 3; ++k) {
    const int s = side[static_cast<std::size_t>(k)];
    double until = std::numeric_limits<double>::infinity();
    if (s != 0) {
      const double e = s * p[k] - h[k], d = s * w[k];
      q.a += d * d, q.b += e * d, q.c += e * e;
      if (d < 0) until = std::max(0.0, e / -d);
    } else if (w[k] != 0) {
      until = std::max(0.0, (h[k] - std::copysign(p[k], p[k] * w[k])) / std::abs(w[k]));
    }
    if (until < q.next) q.next = until, q.which = k;
  }
  return q;
}

// The separation along n is linear: s0 at 0, s1 at 1.
struct Plane {
  double s0, s1;
};

}  // namespace

Search translating_ball_and_box(const Translation& m, double radius, const Vec& h, double accuracy) {
  const Mat r = matrix(m.b);
  const Vec p0 = r.transpose() * (m.a.t - m.b.t), w = r.transpose() * -m.velocity;
  const double far = p0.norm(), speed = w.norm();
  const auto error = [&](double t) {
    return u<double> * (1 + 0x1p-20) *
           (16 * (p0 + t * w).norm() + 5 * far + 6 * t * speed + 4 * radius + 4 * h.norm());
  };
  const auto plane = [&](double t, const Vec& n) {
    const double s = n.dot(p0 + t * w) - n.cwiseAbs().dot(h) - radius, d = n.dot(w);
    return Plane{s - t * d, s + (1 - t) * d};
  };
  const auto outward = [&](double t) {
    const Vec p = p0 + t * w;
    return Vec(p - p.cwiseMax(-h).cwiseMin(h));
  };
  const double at_contact =
      u<double> * (16 * (h.norm() + radius) + 5 * far + 6 * speed + 4 * radius + 4 * h.norm());
  const double reach = radius + 1.75 * at_contact;
  Vec p = p0;
  std::array<int, 3> side;
  for (int k = 0; k < 3; ++k) side[static_cast<std::size_t>(k)] = p[k] > h[k] ? 1 : (p[k] < -h[k] ? -1 : 0);
  double t = 0, nearest = 1;
  bool hit = false;
  // Each slab is entered and left at most once.
  for (int i = 0; i < 7; ++i) {
    const Piece q = piece(p, w, h, side, reach * reach);
    const double disc = q.b * q.b - q.a * q.c;
    if (i == 0 && !(q.c > 0)) return {.end = SearchEnd::unsure};
    if (q.b < 0 && disc >= 0) {
      const double root = q.c / (-q.b + std::sqrt(disc));
      if (root <= q.next) {
        hit = t + root <= 1, t += root;
        break;
      }
    }
    const double turn = q.a > 0 ? -q.b / q.a : 0;
    if (q.b >= 0 || turn <= q.next) {
      nearest = std::min(1.0, t + std::max(0.0, turn));
      break;
    }
    t += q.next;
    if (!(t < 1)) break;
    p = p0 + t * w;
    int& s = side[static_cast<std::size_t>(q.which)];
    p[q.which] = s != 0 ? s * h[q.which] : std::copysign(h[q.which], w[q.which]);
    s = s != 0 ? 0 : (w[q.which] > 0 ? 1 : -1);
  }
  const double when = hit ? t : nearest;
  const Vec v = outward(when);
  const double dist = v.norm();
  if (!(dist > 0)) return {.end = SearchEnd::unsure};
  const Plane s = plane(when, v / dist);
  if (!(s.s0 > 1.25 * error(0))) return {.end = SearchEnd::unsure};
  if (!hit)
    return {
        .end = s.s1 > 1.25 * error(1) ? SearchEnd::clear : SearchEnd::unsure, .clear_until = 1, .steps = 1};
  // The normal's own plane is no farther than the gap but for rounding.
  const double e = error(t), gap = dist - radius, slack = 8 * u<double> * dist;
  if (!(gap - slack > 1.25 * e && gap + e <= accuracy)) return {.end = SearchEnd::unsure};
  Search out{.end = SearchEnd::hit, .clear_until = t, .gap = gap, .steps = 1};
  out.normal = r * (v / -dist);
  out.a = out.normal * radius, out.b = out.normal * dist;
  return out;
}

}  // namespace touchstone::ccd::fast
