// The shape pair of a finding's key.
#pragma once

#include <string>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// "box-sphere", in alphabetical order; "scene" when a and b name no bodies.
inline std::string shapes_of(const Case& c, int a, int b) {
  const int n = static_cast<int>(c.scene.bodies.size());
  if (a < 0 || b < 0 || a >= n || b >= n) return "scene";
  auto x = type_name(c.scene.shape_of(a)), y = type_name(c.scene.shape_of(b));
  if (y < x) std::swap(x, y);
  return std::string(x) + "-" + std::string(y);
}

}  // namespace touchstone::fuzz
