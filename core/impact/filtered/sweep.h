// Two movers over time, in double with an error bound. World axes, origin at A's.
//
// The separation along a unit n at time t,
//
//   s = n·(b(t) − a(t)) − h_A(n) − h_B(−n) − radii   (h: support values of the rotated cores),
//
// is a lower bound of the gap for every n, and equals the gap for the best. The computed value differs from
// it by at most `error`. In units of u, where a body's terms are multiplied by the reach of its core:
//
//   rotation    2 if rounded once from extended precision. Otherwise R(t) = Q·R0: R0 2, the rotation Q 20
//               (axis, sine and cosine 11; entries 9), its angle 3 |ω| t, the product 9
//   direction   Rᵀn is off by 5.2, so the point found may fall short of the farthest by twice that
//   scan        dot products of vertices 3 each, 6 for two that are compared; rims and quadrics no more
//   point       R·p 5.2
//   w = b − a   of offset and points, 1; n·w 3, also of the offset, which is itself rounded once and added
//               once
//
// The total is 22, with a scan 28 (rotation rounded once or at rest), otherwise 31 + 3 |ω| t more, and 5
// times the offset; radii 2. n need not be unit up to rounding: s scales with it.
#pragma once

#include <algorithm>

#include "core/impact/filtered/mover.h"

namespace touchstone::impact::filtered {

/// Covers the rounding of an error bound itself.
inline constexpr double bound_margin = 1 + 0x1p-20;

/// The poses of both bodies at one time.
struct Spot {
  double t = 0;
  bool precise = false;
  Mat ra, rb;
  Vec offset;  // of B's origin
  double error = 0;
};

/// Separation along n, and the core points that define it.
struct Side {
  double s = 0;
  Vec local_a, local_b;  // in each body's frame
  Vec pa, pb;            // about each body's origin, world axes
};

class Sweep {
 public:
  Sweep(const Mover& a, const Mover& b, const WideVec& offset) : a_(a), b_(b), offset_(offset) {
    velocity_wide_ = b.linear.cast<Wide>() - a.linear.cast<Wide>();
    velocity_ = velocity_wide_.cast<double>();
    radii_ = a.body.radius + b.body.radius;
  }
  const Mover& a() const { return a_; }
  const Mover& b() const { return b_; }
  const Vec& velocity() const { return velocity_; }
  double radii() const { return radii_; }
  bool turns() const { return a_.turns || b_.turns; }

  Spot at(double t, bool precise) const {
    Spot x;
    x.t = t;
    x.precise = precise;
    x.ra = rotation_at(a_, t, precise);
    x.rb = rotation_at(b_, t, precise);
    x.offset = (offset_ + static_cast<Wide>(t) * velocity_wide_).cast<double>();
    const auto body = [&](const Mover& m) {
      const int scan = on_core(m.body, [](const auto& core) { return core.support_rounding; });
      return (22 + scan + (m.turns && !precise ? 31 + 4 * m.speed * t : 0)) * m.body.reach;
    };
    x.error = u<double> * bound_margin * (body(a_) + body(b_) + 5 * x.offset.norm() + 3 * radii_);
    return x;
  }

  Side along(const Spot& x, const Vec& n) const {
    Side r;
    r.local_a = farthest(a_, x.ra, n);
    r.local_b = farthest(b_, x.rb, -n);
    r.pa = x.ra * r.local_a;
    r.pb = x.rb * r.local_b;
    r.s = n.dot(x.offset + r.pb - r.pa) - radii_;
    return r;
  }

 private:
  const Mover &a_, &b_;
  WideVec offset_, velocity_wide_;
  Vec velocity_;
  double radii_ = 0;
};

}  // namespace touchstone::impact::filtered
