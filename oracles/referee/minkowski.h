// The Minkowski difference D = core(A) - core(B) as a set of support points, and the one fact on which every
// bracket of the gap rests: for every direction n, gap(A,B) >= -(h_D(n) + (rA + rB)|n|)/|n|, whether the
// bodies overlap or not, because gap = -min over unit n of w(n) (truth.md §2; separated: the supporting-plane
// form of distance).
#pragma once

#include "oracles/referee/body.h"

namespace touchstone::referee {

struct Vertex {
  Real3 w;     // a - b
  Real3 a, b;  // support points of the cores
  int ia = -1, ib = -1;
};

struct Difference {
  const Solid& a;
  const Solid& b;
  Real extent;  // every point of D, and of its computed form, is this close to the origin
  Real error;   // computed support points are this close to D; support values err by at most error·|n|
  Real radius;  // rA + rB, rounded; its rounding is in radius_error
  Real radius_error;

  Difference(const Solid& a_, const Solid& b_)
      : a(a_),
        b(b_),
        extent(a_.extent + b_.extent),
        error(a_.error + b_.error + 4 * unit * (a_.extent + b_.extent)),
        radius(static_cast<Real>(a_.radius) + static_cast<Real>(b_.radius)),
        radius_error(unit * radius) {}

  Vertex support(const Real3& n) const {
    const SupportPoint p = referee::support(a, n), q = referee::support(b, -n);
    return {p.point - q.point, p.point, q.point, p.index, q.index};
  }
  /// Upper bound of h_D(n)/|n| given the support vertex of n.
  Real width_above(const Vertex& v, const Real3& n) const {
    const Real length = norm(n);
    return dot(n, v.w) / length + error + 8 * unit * extent;
  }
};

/// What is known of the gap of the cores: lo from a direction, hi from a point pair or an inner polytope.
/// Proven.
struct CoreGap {
  Real lo = -std::numeric_limits<Real>::infinity();
  Real hi = std::numeric_limits<Real>::infinity();
  Real3 direction{0, 0, 1};  // A to B, belongs to lo
  void raise(Real value, const Real3& n) {
    if (value > lo) lo = value, direction = n;
  }
  void lower(Real value) { hi = std::fmin(hi, value); }
};

}  // namespace touchstone::referee
