// The largest absolute value of any single number in a shape or a vector; no squares, which may exceed the
// range of doubles. Indices of triangles do not count.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone::fuzz {

inline double largest_number(double v) { return std::abs(v); }
inline double largest_number(const Vec3& v) { return v.lpNorm<Eigen::Infinity>(); }
inline double largest_number(const std::vector<Vec3>& v) {
  double most = 0;
  for (const Vec3& p : v) most = std::max(most, largest_number(p));
  return most;
}
inline double largest_number(const std::vector<std::array<int, 3>>&) { return 0; }

inline double largest_number(const Shape& shape) {
  double most = 0;
  std::visit(
      [&](const auto& s) {
        for_each_field(s, [&](auto, const auto& v, Domain) { most = std::max(most, largest_number(v)); });
      },
      shape);
  return most;
}

}  // namespace touchstone::fuzz
