#include <cmath>

#include "core/impact/filtered/translation.h"

namespace touchstone::impact::filtered {
namespace {

// The distance of two points or segments in translation is a convex function of time, and the separation
// along the direction of the nearest points is a tangent from below. Newton's method from before contact is
// therefore never late, and quadratic except when grazing. It starts where the balls about both bodies meet;
// for two spheres that is the contact itself. When grazing, each iteration reduces the gap by a factor of
// four: 25 from 1 to rounding.
constexpr int newton_cap = 40;

// The axes of A and B, each from its middle to its end; middle and velocity of B relative to A.
struct Segments {
  Vec a, b, offset, v;
  double radii, length_a, length_b;
  Vec at(double t) const { return offset + t * v; }
  // Axes 17 u each, their products with n 21 u; offset and velocity are rounded once.
  double error(double t) const {
    return u<double> * bound_margin *
           (24 * (length_a + length_b) + 4 * radii + 5 * offset.norm() + 16 * at(t).norm() +
            6 * t * v.norm());
  }
  double separation(const Vec& n, double t) const {
    return n.dot(at(t)) - std::abs(n.dot(a)) - std::abs(n.dot(b)) - radii;
  }
};

// Squared sine of the angle below which the axes count as parallel.
constexpr double parallel_sine_sq = 0x1p-40;

struct Nearest {
  double alpha = 0, beta = 0;  // in [-1, 1] on each axis
};

double clamp_to_axis(double x) { return std::min(1.0, std::max(-1.0, x)); }

// Nearest points of two segments, B's middle at o (Ericson 2005, §5.1.9).
Nearest nearest(const Segments& s, const Vec& o) {
  const double aa = s.a.squaredNorm(), bb = s.b.squaredNorm(), ab = s.a.dot(s.b), ao = s.a.dot(o),
               bo = s.b.dot(o), det = aa * bb - ab * ab;
  Nearest r;
  if (det > parallel_sine_sq * aa * bb) r.alpha = clamp_to_axis((ao * bb - ab * bo) / det);
  if (bb > 0) r.beta = clamp_to_axis((r.alpha * ab - bo) / bb);
  if (aa > 0) r.alpha = clamp_to_axis((ao + r.beta * ab) / aa);
  return r;
}

// The time when the bounding balls meet, or are nearest; 0 if they meet at the start.
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
    // Both ends beyond the error prove everything in between.
    const bool from_start = s.separation(n, 0) > certain_errors * e0;
    if (from_start && s.separation(n, 1) > certain_errors * e1)
      return {.end = SearchEnd::clear, .clear_until = 1, .gap = dist - s.radii, .steps = i};
    if (!(x > certain_errors * e)) {
      // The root for the balls may be slightly late.
      if (i > 2 || !(rate < 0)) return unsure;
    } else if (x < 2.5 * e) {
      if (!from_start || dist - s.radii + e > accuracy) return unsure;
      Search r{.end = SearchEnd::hit, .clear_until = t, .gap = dist - s.radii, .normal = n, .steps = i};
      r.a = p.alpha * s.a + a.radius * n;
      r.b = s.at(t) + p.beta * s.b - b.radius * n;
      return r;
    }
    if (!(rate < 0)) return unsure;
    t += (x - aimed_errors * e) / -rate;
    if (!(t >= 0 && t <= 1)) return unsure;
  }
  return unsure;
}

}  // namespace touchstone::impact::filtered
