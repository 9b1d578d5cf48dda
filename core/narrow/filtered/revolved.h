// Penetration depth of two round cores (point, segment, cylinder, cone) whose axes are parallel, or one of
// which is a point. Their minima may form a ring, on which no polytope closes. B − A is then a solid of
// revolution. Its depth is that of its section through the axis and the origin, a convex polygon, and the
// least support value of a polygon is attained at one of its edges: radial, axial, or the side of a cone.
// Axes that are parallel only to within rounding are treated as parallel, at the cost of B's reach times the
// angle. Outcome: `found` or not.
#pragma once

#include "core/narrow/filtered/gjk.h"

namespace touchstone::narrow::filtered {

template <class R>
class Revolved {
 public:
  bool found = false;
  R upper = 0, lower = 0;
  V3<R> outward, a, w;  // as in Depth

  Revolved(const Difference<R>& d, R size) : d_(d), level_(rounding::feature_height * u<R> * size) {
    const Symmetry of_a = symmetry(d.a), of_b = symmetry(d.b);
    if (of_a == Symmetry::none || of_b == Symmetry::none) return;
    const M3<R>& m = d.at.b_to_a;
    const bool point = of_a == Symmetry::centre || of_b == Symmetry::centre;
    const R tilt = point ? R(0) : std::sqrt(m(0, 2) * m(0, 2) + m(1, 2) * m(1, 2));
    if (!(tilt <= rounding::parallel_sine * u<R>)) return;
    // The axis is z in A's frame, unless A is a point.
    axis_ = of_a == Symmetry::centre ? V3<R>(m.col(2)) : V3<R>(V3<R>::UnitZ());
    const V3<R> off = d.at.offset - axis_ * axis_.dot(d.at.offset);
    const R length = std::sqrt(off.squaredNorm());
    out_ = length > level_ ? V3<R>(off * (-1 / length)) : V3<R>(axis_.unitOrthogonal());
    out_ = (out_ - axis_ * axis_.dot(out_)).normalized();
    least();
    witnesses();
    lower = upper - 2 * tilt * d.b.reach - level_ / 2;
  }

 private:
  using Symmetry = convex::Symmetry;

  V3<R> in_b(const V3<R>& v) const { return d_.at.b_to_a.transpose() * v; }

  void try_direction(R radial, R axial) {
    const V3<R> m = out_ * radial + axis_ * axial;
    const R h = m.dot(d_.support(m).w);
    if (h < upper) {
      upper = h;
      outward = m;
      across_ = out_ * -axial + axis_ * radial;
    }
  }

  void least() {
    upper = std::numeric_limits<R>::infinity();
    try_direction(1, 0);
    try_direction(0, 1);
    try_direction(0, -1);
    try_slants(d_.a, false);
    try_slants(d_.b, d_.at.b_to_a.col(2).dot(axis_) > 0);
  }

  // `up`: the body's z is the outward axis; A's is opposite, since it enters with a negative sign.
  void try_slants(const ConvexBody<R>& b, bool up) {
    on_core(b, [&]<class C>(const C& core) {
      if constexpr (C::symmetry == Symmetry::axis)
        core.for_each_slant([&](R radial, R axial) { try_direction(radial, up ? axial : -axial); });
    });
  }

  // The ends of a body's edge along d, from its support points for directions tilted by edge_tilt to either
  // side; a corner gives the same point twice.
  static constexpr R edge_tilt = R(0.001);
  struct Edge {
    V3<R> from, to;
  };
  Edge edge(const ConvexBody<R>& b, const V3<R>& d, const V3<R>& across) const {
    const V3<R> at = support_local<R>(b, d);
    Edge e{support_local<R>(b, V3<R>(d - across * edge_tilt)),
           support_local<R>(b, V3<R>(d + across * edge_tilt))};
    if (!(d.dot(at - e.from) <= level_)) e.from = at;
    if (!(d.dot(at - e.to) <= level_)) e.to = at;
    return e;
  }

  void witnesses() {
    const Edge ea = edge(d_.a, -outward, across_), eb = edge(d_.b, in_b(outward), in_b(across_));
    const V3<R> from = d_.at.b_to_a * eb.from + d_.at.offset, to = d_.at.b_to_a * eb.to + d_.at.offset;
    // b − a has no component along `across_`: take the middle of the common interval of both edges.
    const R a0 = across_.dot(ea.from), a1 = across_.dot(ea.to), b0 = across_.dot(from), b1 = across_.dot(to);
    const R lo = std::max(std::min(a0, a1), std::min(b0, b1)),
            hi = std::min(std::max(a0, a1), std::max(b0, b1));
    if (!(lo <= hi + 2 * level_)) return;
    const R middle = (lo + hi) / 2;
    const auto at = [&](const V3<R>& p, const V3<R>& q, R p_at, R q_at) {
      const R share = q_at != p_at ? std::clamp((middle - p_at) / (q_at - p_at), R(0), R(1)) : R(0);
      return V3<R>(p + (q - p) * share);
    };
    a = at(ea.from, ea.to, a0, a1);
    w = at(from, to, b0, b1) - a;
    found = (w - upper * outward).norm() <= 4 * level_;
  }

  const Difference<R>& d_;
  R level_;
  V3<R> axis_, out_, across_;
};

}  // namespace touchstone::narrow::filtered
