// The Minkowski difference D = core(A) - core(B) as a set of support points, and the fact on which every
// bracket of the gap rests: for every direction n, gap(A,B) >= -(h_D(n) + (rA + rB)|n|)/|n|, whether the
// bodies overlap or not, because gap = -min over unit n of w(n) (truth.md §2; separated: the supporting-plane
// form of distance).
#pragma once

#include "oracles/referee/filter/body.h"

namespace touchstone::referee {

template <class T>
struct BasicVertex {
  Triple<T> w;     // a - b
  Triple<T> a, b;  // support points of the cores
  int ia = -1, ib = -1;
  Triple<T> n;  // the direction they were found in
};
using Vertex = BasicVertex<Real>;

template <class T>
struct BasicDifference {
  const BasicSolid<T>& a;
  const BasicSolid<T>& b;
  T extent;  // every point of D, and of its computed form, is this close to the origin
  T error;   // computed support points are this close to D; support values err by at most error·|n|
  T radius;  // rA + rB, rounded; its rounding is in radius_error
  T radius_error;

  BasicDifference(const BasicSolid<T>& a_, const BasicSolid<T>& b_)
      : a(a_),
        b(b_),
        extent((a_.extent + b_.extent) * (1 + value_rounding_of<T>)),
        error(a_.error + b_.error + difference_rounding_of<T> * (a_.extent + b_.extent)),
        radius(static_cast<T>(a_.radius) + static_cast<T>(b_.radius)),
        radius_error(unit_of<T> * radius) {}

  BasicVertex<T> support(const Triple<T>& n) const {
    const SupportPoint<T> p = referee::support(a, n), q = referee::support(b, -n);
    return {p.point - q.point, p.point, q.point, p.index, q.index, n};
  }
  /// Upper bound of h_D(n)/|n| given the support vertex of n.
  T width_above(const BasicVertex<T>& v, const Triple<T>& n) const {
    using std::sqrt;
    const T length_sq = dot(n, n), length = sqrt(length_sq);
    if (!(length_sq > least_square<T>)) return std::numeric_limits<T>::infinity();
    return dot(n, v.w) / length + error + dot_rounding_of<T> * extent;
  }
};
using Difference = BasicDifference<Real>;

/// Proven bounds of the gap of the cores: lo from a direction, hi from a point pair or an inner polytope.
template <class T>
struct BasicCoreGap {
  T lo = -std::numeric_limits<T>::infinity();
  T hi = std::numeric_limits<T>::infinity();
  Triple<T> direction{0, 0, 1};  // A to B, belongs to lo
  void raise(T value, const Triple<T>& n) {
    if (value > lo) {
      lo = value;
      direction = n;
    }
  }
  void lower(T value) {
    if (value < hi) hi = value;
  }
};
using CoreGap = BasicCoreGap<Real>;

// Pairs in which each body has an axis of symmetry, and the axes are parallel: the depth problem has a
// continuum of nearly equal directions, for which a polytope needs 10^7 facets. Symmetry reduces it to a
// plane, where a polygon needs forty edges.
//
// Derivation. Let u be the common axis direction and e = c_A - c_B. For n = n_u·u + n_r (n_r perpendicular to
// u), h_A and h_(-B) about their centres depend only on n_u and |n_r|, and h_D(n) adds n·e = n_u e_u +
// n_r·e_r. For given n_u and |n_r| that is least when n_r points against e_r. So the least h_D(n)/|n| is
// among the n in the plane of u and e_r, where h_D is the support function of the difference of the two
// meridian sections. Axes that are parallel only up to rounding: each body is within `slack` (Hausdorff) of
// one whose axis is exactly parallel, and the depth differs by at most that.

struct MeridianBound {
  bool applies = false;
  Real3 axis;  // u
  CoreGap gap;
};
MeridianBound meridian_bound(const Difference& d, Real target);

}  // namespace touchstone::referee
