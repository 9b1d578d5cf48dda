// How far a shape extends.
#pragma once

#include <algorithm>
#include <vector>

#include "core/math/wide.h"

namespace touchstone {

/// The values that a linear function takes on a shape.
template <class T>
struct Interval {
  T lo = 0, hi = 0;
};

template <class T>
Interval<T> both_sides(T h) {
  return {-h, h};
}

/// Of the dot products of the points with d.
template <class T>
Interval<T> extent_of(const std::vector<Vec3>& points, const V3<T>& d) {
  Interval<T> r{std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity()};
  for (const Vec3& p : points) {
    const T x = d.dot(p.cast<T>());
    r.lo = std::min(r.lo, x);
    r.hi = std::max(r.hi, x);
  }
  return r;
}

Wide largest_coordinate_sum(const std::vector<Vec3>& points);

/// |v| without overflow or underflow.
double scaled_norm(const Vec3& v);

/// Largest distance from the origin, without overflow.
double farthest(const std::vector<Vec3>& points);

double largest_half_extent(const std::vector<Vec3>& points);

/// Balls in a shape, to about ten roundings of double.
struct InnerRadii {
  double anywhere = 0;      // radius of a ball inside the shape, not necessarily the largest one
  double about_origin = 0;  // of one about the body's origin; < 0: minus the distance to a point of the shape
};

}  // namespace touchstone
