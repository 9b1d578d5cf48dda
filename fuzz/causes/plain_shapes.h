// The shapes of plain cases, the plainest first: spheres and cubes, then the kinds that a case has.
#pragma once

#include <array>
#include <vector>

#include "core/shape/shape.h"

namespace touchstone::fuzz {

/// Two shapes, and how far each reaches from its origin towards the other: the first along +x, the second
/// along -x.
struct PlainPair {
  Shape first, second;
  double reach_first = 1, reach_second = 1;
  /// Both are spheres or cubes: then the bodies are `gap` apart when placed by their reaches, to the last
  /// bit.
  bool is_exact = true;
};

/// For tables of cases, which are constants.
using Numbers = std::array<double, 3>;
inline Vec3 vec3(const Numbers& v) { return {v[0], v[1], v[2]}; }

/// Spheres and cubes of half extent 1.
std::vector<PlainPair> common_pairs();

/// The kinds of the two shapes with sizes of 1, each with a sphere and a cube, then with the other one; both
/// orders. What is flat, straight or a point stays so. Spheres, cubes, and hulls and meshes that are neither
/// solid, a plate nor a triangle are left out.
std::vector<PlainPair> own_pairs(const Shape& a, const Shape& b);

}  // namespace touchstone::fuzz
