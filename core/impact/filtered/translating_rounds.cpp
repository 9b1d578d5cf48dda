#include <cmath>

#include "core/impact/filtered/translation.h"

namespace touchstone::ccd::fast {
namespace {

// The distance of two points, or segments, in translation is a convex function of time, and the separation
// along the direction of its nearest points a tangent from below: Newton's method from before contact is
// never late, and quadratic unless it grazes. It starts at the balls about both bodies: for two spheres that
// is contact itself.
// A graze gains a factor of four in the gap each time: 25 from 1 to rounding.
constexpr int newton_cap = 40;

// A's axis and B's, from the middle of each to its end; B's middle and velocity from A's.
struct Segments {
  Vec a, b, offset, v;
  double radii, length_a, length_b;
  Vec at(double t) const { return offset + t * v; }
  // Axes 17 u each, their products with n 21 u; offset and velocity rounded once.
  double error(double t) const {
    return u<double> * (1 + 0x1p-20) *
           (24 * (length_a + length_b) + 4 * radii + 5 * offset.norm() + 16 * at(t).norm() +
            6 * t * v.norm());
  }
  double separation(const Vec& n, double t) const {
    return n.dot(at(t)) - std::abs(n.dot(a)) - std::abs(n.dot(b)) - radii;
  }
};

struct Nearest {
  double alpha = 0, beta = 0;  // in [-1, 1], of each axis
};

double within(double x) { return std::min(1.0, std::max(-1.0, x)); }

// Of two segments, B's middle at o (Ericson 2005, §5.1.9).
Nearest nearest(const Segments& s, const Vec& o) {
  const double aa = s.a.squaredNorm(), bb = s.b.squaredNorm(), ab = s.a.dot(s.b), ao = s.a.dot(o),
               bo = s.b.dot(o), det = aa * bb - ab * ab;
  Nearest r;
  if (det > 0x1p-40 * aa * bb) r.alpha = within((ao * bb - ab * bo) / det);
  if (bb > 0) r.beta = within((r.alpha * ab - bo) / bb);
  if (aa > 0) r.alpha = within((ao + r.beta * ab) / aa);
  return r;
}

// When the balls about both meet, or are nearest; 0 if they meet now.
double ball_time(const Segments& s) {
  const double reach = s.radii + s.length_a + s.length_b;
  const double a = s.v.squaredNorm(), b = s.offset.dot(s.v), c = s.offset.squaredNorm() - reach * reach;
  if (!(c > 0 && b < 0)) return 0;
  const double disc = b * b - a * c;
  return disc > 0 ? c / (-b + std::sqrt(disc)) : -b / a;
}

}  // namespace

Search translating_rounds(const Translation& m, const Round& a, const Round& b, double accuracy) {
  const Segments s{a.half_height * axis_z(m.a),
                   b.half_height * axis_z(m.b),
                   m.b.t - m.a.t,
                   m.velocity,
                   a.radius + b.radius,
                   a.half_height,
                   b.half_height};
  const Search unsure{.end = SearchEnd::unsure};
  const double e0 = s.error(0), e1 = s.error(1);
  double t = std::min(1.0, ball_time(s));
  for (int i = 1; i <= newton_cap; ++i) {
    const Nearest p = nearest(s, s.at(t));
    const Vec w = s.at(t) + p.beta * s.b - p.alpha * s.a;
    const double dist = w.norm();
    if (!(dist > 0)) return unsure;
    const Vec n = w / dist;
    const double x = s.separation(n, t), rate = n.dot(s.v), e = s.error(t);
    // Both ends beyond the error prove all between.
    const bool from_start = s.separation(n, 0) > 1.25 * e0;
    if (from_start && s.separation(n, 1) > 1.25 * e1)
      return {.end = SearchEnd::clear, .clear_until = 1, .gap = dist - s.radii, .steps = i};
    if (!(x > 1.25 * e)) {
      // The balls' own root, a little late.
      if (i > 2 || !(rate < 0)) return unsure;
    } else if (x < 2.5 * e) {
      if (!from_start || dist - s.radii + e > accuracy) return unsure;
      Search r{.end = SearchEnd::hit, .clear_until = t, .gap = dist - s.radii, .normal = n, .steps = i};
      r.a = p.alpha * s.a + a.radius * n;
      r.b = s.at(t) + p.beta * s.b - b.radius * n;
      return r;
    }
    if (!(rate < 0)) return unsure;
    t += (x - 1.75 * e) / -rate;
    if (!(t >= 0 && t <= 1)) return unsure;
  }
  return unsure;
}

}  // namespace touchstone::ccd::fast
