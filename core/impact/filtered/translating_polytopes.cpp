// Finds where the ray of the origin, −t v, enters the Minkowski difference B − A of two polytopes at rest
// (van den Bergen 2004 casts the ray with GJK; here as in Snethen's portal refinement, XenoCollide 2008). A
// portal is three of its points whose triangle the ray crosses. The support plane along the portal's normal n
// bounds the time from below, s(n)/(−n·v), whatever the portal; the portal's own plane bounds it from above.
// A support point beyond the portal yields a smaller one; when there is none, both bounds are equal.
// Departures: no interior point is needed, because the line of the ray replaces it; the time is proven by the
// last support plane alone.
#include <array>
#include <cmath>

#include "core/impact/filtered/translation.h"
#include "core/narrow/simplex.h"

namespace touchstone::impact::filtered {
namespace {

using narrow::Vertex;

constexpr int portal_cap = 40;
// Rounding of n·v, in u: of the velocity, its projection and the sum.
constexpr int velocity_rounding = 8;
// In units of the error: a support plane this near to the portal cannot be improved.
constexpr double portal_errors = 0.1;
// In units of the error: the gap that a hit aims at. More than 1, so that the hit is proven to be none too
// late.
constexpr double aimed_gap = 1.1;

enum class Pass { on, clear, lost };

class Cast {
 public:
  explicit Cast(const Sweep& w) : sweep_(w), start_(w.at(0, true)), v_(w.velocity()), speed_(v_.norm()) {}

  Search run(double accuracy) {
    if (!(speed_ > 0)) return {};
    ray_ = v_ / speed_;
    // The end is extrapolated from the start: both errors, and that of n·v.
    end_error_ = start_.error + sweep_.at(1, true).error + velocity_rounding * u<double> * speed_;
    Pass p = find_portal();
    if (p == Pass::on) p = refine();
    if (p == Pass::clear) return {.end = SearchEnd::clear, .clear_until = 1, .steps = steps_};
    return p == Pass::on ? hit(accuracy) : Search{};
  }

 private:
  // The support plane along n: separation at t = 0, and its point. Proves a miss if both ends are beyond the
  // error.
  Pass look(const Vec& n, Vertex<double>& p, double& s) {
    ++steps_;
    const Side x = sweep_.along(start_, n);
    p.a = x.pa;
    p.w = start_.offset + x.pb - x.pa;
    s = x.s;
    return s > start_.error && s + n.dot(v_) > end_error_ ? Pass::clear : Pass::on;
  }

  // As seen along the ray: positive if the origin is to the left of the edge from p to q.
  double side(const Vertex<double>& p, const Vertex<double>& q) const { return ray_.dot(p.w.cross(q.w)); }
  Vec across(const Vec& x) const { return x - ray_.dot(x) * ray_; }

  // Finds three points around the ray. Directions lean towards its beginning, so that the points are near
  // where it enters.
  Pass find_portal() {
    double s = 0;
    if (look(-ray_, p_[0], s) == Pass::clear) return Pass::clear;
    Vec g = across(-p_[0].w);
    const double aside = g.norm();
    if (!(aside > 0))
      g = ray_.unitOrthogonal();
    else
      g /= aside;
    if (const Pass r = reach(g, -ray_, p_[1]); r != Pass::on) return r;
    for (int i = 0; i < portal_cap; ++i) {
      const Vec edge = p_[1].w - p_[0].w;
      g = across(edge).cross(ray_);
      const double length = g.norm();
      if (!(length > 0)) return Pass::lost;
      g *= (g.dot(p_[0].w) > 0 ? -1 : 1) / length;
      const Vec along = edge.normalized(), front = (ray_.dot(along) * along - ray_).normalized();
      if (const Pass r = reach(g, front, p_[2]); r != Pass::on) return r;
      // The origin is still outside one of the two edges of the new point.
      const double turn = side(p_[0], p_[1]) + side(p_[1], p_[2]) + side(p_[2], p_[0]);
      const double sign = turn < 0 ? -1 : 1;
      if (sign * side(p_[1], p_[2]) < 0)
        p_[0] = p_[2];
      else if (sign * side(p_[2], p_[0]) < 0)
        p_[1] = p_[2];
      else
        return Pass::on;
    }
    return Pass::lost;
  }

  // Finds a point beyond the ray along g, which is orthogonal to it; `front`: unit, orthogonal to g.
  Pass reach(const Vec& g, const Vec& front, Vertex<double>& p) {
    double s = 0;
    const Vec lean = (front - g).normalized();
    if (look(lean, p, s) == Pass::clear) return Pass::clear;
    if (g.dot(p.w) > 0) return Pass::on;
    if (look(-g, p, s) == Pass::clear) return Pass::clear;
    return g.dot(p.w) > 0 ? Pass::on : Pass::lost;
  }

  Pass refine() {
    for (int i = 0; i < portal_cap; ++i) {
      Vec n = narrow::triangle_normal(p_[0].w, p_[1].w, p_[2].w);
      const double length = n.norm();
      if (!(length > 0)) return Pass::lost;
      n *= (n.dot(v_) > 0 ? -1 : 1) / length;
      Vertex<double> q;
      if (look(n, q, s_) == Pass::clear) return Pass::clear;
      n_ = n;
      if (n.dot(p_[0].w) - s_ <= portal_errors * start_.error) return Pass::on;
      // The ray crosses one of the three triangles with q.
      const double sign = side(p_[0], p_[1]) + side(p_[1], p_[2]) + side(p_[2], p_[0]) < 0 ? -1 : 1;
      const double a = sign * side(p_[0], q), b = sign * side(p_[1], q), c = sign * side(p_[2], q);
      if (b >= 0 && a <= 0)
        p_[2] = q;
      else if (c >= 0 && b <= 0)
        p_[0] = q;
      else if (a >= 0 && c <= 0)
        p_[1] = q;
      else
        return Pass::lost;
    }
    return Pass::lost;
  }

  Search hit(double accuracy) const {
    const double rate = -n_.dot(v_);
    if (!(rate > 0)) return {};
    const double e = sweep_.at(std::clamp(s_ / rate, 0.0, 1.0), true).error;
    const double t = (s_ - aimed_gap * e) / rate;
    if (!(t >= 0 && t <= 1)) return {};
    const Spot spot = sweep_.at(t, true);
    const double s = sweep_.along(spot, n_).s;
    if (!(s_ > start_.error && s > spot.error)) return {};
    narrow::Simplex<double> x;
    x.size = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      x.p[k] = p_[k];
      x.p[k].w += spot.offset - start_.offset;
    }
    Vec w = Vec::Zero();
    double dist_sq = 0, margin = 0;
    if (narrow::reduce(x, w, dist_sq, margin)) return {};
    const double dist = std::sqrt(dist_sq);
    if (!(dist + spot.error <= accuracy)) return {};
    Search r{.end = SearchEnd::hit, .clear_until = t, .gap = s, .steps = steps_};
    for (int k = 0; k < x.size; ++k)
      r.a += x.weight[static_cast<std::size_t>(k)] * x.p[static_cast<std::size_t>(k)].a;
    r.b = r.a + w;
    r.normal = n_;
    return r;
  }

  const Sweep& sweep_;
  Spot start_;
  Vec v_, ray_, n_;
  double speed_ = 0, end_error_ = 0, s_ = 0;
  std::array<Vertex<double>, 3> p_;
  int steps_ = 0;
};

}  // namespace

Search translating_polytopes(const Sweep& sweep, double accuracy) { return Cast(sweep).run(accuracy); }

}  // namespace touchstone::impact::filtered
