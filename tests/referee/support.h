// Shared by the referee's tests: random shapes and poses, L of a pair, and a bracket's claims as one-line
// checks.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/rng.h"
#include "core/scene/scene.h"
#include "oracles/referee/referee.h"

namespace touchstone::referee_test {

using namespace touchstone::referee;

/// A bounded convex shape of the kind, sizes log-uniform within a factor of ten of `size`.
inline Shape random_convex(Rng& r, ShapeKind kind, double size = 1) {
  const auto s = [&] { return size * std::pow(10.0, r.uniform(-1, 0)); };
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{s()};
    case ShapeKind::box:
      return Box{{s(), s(), s()}};
    case ShapeKind::capsule:
      return Capsule{s(), s()};
    case ShapeKind::cylinder:
      return Cylinder{s(), s()};
    case ShapeKind::cone:
      return Cone{s(), s()};
    case ShapeKind::ellipsoid:
      return Ellipsoid{{s(), s(), s()}};
    default:
      break;
  }
  std::vector<Vec3> v;
  const int n = 4 + static_cast<int>(r.below(12));
  for (int i = 0; i < n; ++i) v.push_back(r.unit_vector() * s());
  Hull h;
  h.vertices = std::move(v);
  return h;
}

inline constexpr ShapeKind tested_kinds[] = {ShapeKind::sphere,   ShapeKind::box,      ShapeKind::capsule,
                                             ShapeKind::hull,     ShapeKind::cylinder, ShapeKind::cone,
                                             ShapeKind::ellipsoid};
inline constexpr int exact_kind_count = 4;  // the first kinds, whose verdict is always decided

/// World support point in doubles, from the core's own support mappings: independent of the referee's.
inline Vec3 world_support(const Shape& s, const Pose& p, const Vec3& n) {
  const Mat3 r = rotation_matrix(p.rotation);
  const Vec3 d = r.transpose() * n;
  return std::visit(
      [&](const auto& x) -> Vec3 {
        if constexpr (requires { support(x, d); }) return r * support(x, d) + p.translation;
        return Vec3::Zero();
      },
      s);
}

inline double scale_of(const Shape& a, const Vec3& at, const Shape& b, const Vec3& bt) {
  return std::max(
      {extent(a), extent(b), at.cwiseAbs().maxCoeff(), bt.cwiseAbs().maxCoeff(), (at - bt).norm()});
}

}  // namespace touchstone::referee_test
