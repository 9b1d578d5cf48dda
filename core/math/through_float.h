// A double rounded to float and widened again.
#pragma once

#include "core/math/pose.h"

namespace touchstone {

/// The nearest float, as a double. Goes through memory because g++ 12 drops both casts where it vectorises
/// static_cast<double>(static_cast<float>(x)) (-O2, two lanes of an Eigen vector; seen on 22 Nov 2026).
inline double through_float(double x) {
  volatile float f = static_cast<float>(x);
  return static_cast<double>(f);
}

/// Applied to each coordinate.
inline Vec3 through_float(const Vec3& v) {
  return {through_float(v.x()), through_float(v.y()), through_float(v.z())};
}

}  // namespace touchstone
