// Random motions of deforming primitives (a vertex and a triangle, or two edges, whose vertices move on
// straight paths): in turn easy, degenerate, nearly touching, far away and extreme.
#pragma once

#include <array>
#include <cmath>

#include "core/math/pose.h"
#include "core/math/rng.h"

namespace touchstone::primitives {

using Quad = std::array<Vec3, 4>;

inline Quad at(const Quad& a, const Quad& b, double t) {
  Quad q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = (1 - t) * a[i] + t * b[i];
  return q;
}

// Coordinates in units that make degenerate and touching primitives common.
inline Quad lattice_quad(Rng& rng, std::uint64_t n) {
  Quad q;
  for (Vec3& v : q)
    for (int k = 0; k < 3; ++k) v[k] = static_cast<double>(rng.below(n));
  return q;
}

inline Quad loose_quad(Rng& rng) {
  Quad q;
  for (Vec3& v : q) {
    const double length = rng.uniform(0, 1);
    v = rng.unit_vector() * length;
  }
  return q;
}

struct PrimitiveMotion {
  Quad a, b;
};

// In turn: anywhere; small integers; a rigid motion of the second primitive; one aimed at a feature to within
// 2^-50; the same far from the origin; extreme exponents; one whose last coordinate hardly moves.
/// Motion number i: a pure function of i and of the state of rng.
inline PrimitiveMotion random_motion(Rng& rng, std::uint64_t i) {
  PrimitiveMotion m{loose_quad(rng), loose_quad(rng)};
  switch (i % 7) {
    case 1:
      m = {lattice_quad(rng, 4), lattice_quad(rng, 4)};
      break;
    case 2: {
      const double length = rng.uniform(0, 3);
      const Vec3 shift = rng.unit_vector() * length;
      for (std::size_t k = 0; k < 4; ++k) m.b[k] = m.a[k] + (k < 2 ? shift : -shift);
      break;
    }
    case 3:
    case 4: {
      // Vertex 0 nearly meets edge 2-3 in the middle of the step.
      const Quad half = at(m.a, m.b, 0.5);
      const Vec3 target = half[2] + rng.uniform() * (half[3] - half[2]);
      const double beside = std::ldexp(1.0, -20 - static_cast<int>(rng.below(36)));
      m.b[0] = 2 * target - m.a[0] + rng.unit_vector() * beside;
      if (i % 7 == 4)
        for (Quad* q : {&m.a, &m.b})
          for (Vec3& v : *q) v += Vec3(1e6, -3e6, 5e5);
      break;
    }
    case 5: {
      const std::uint64_t range =
          rng.below(10) == 0 ? 950 : 90;  // the referee's rationals are slow at extreme exponents
      const double scale = std::ldexp(1.0, static_cast<int>(rng.below(2 * range)) - static_cast<int>(range));
      for (Quad* q : {&m.a, &m.b})
        for (Vec3& v : *q) v *= scale;
      break;
    }
    case 6:
      m = {lattice_quad(rng, 3), lattice_quad(rng, 3)};
      for (Quad* q : {&m.a, &m.b})
        for (Vec3& v : *q) v.z() = std::ldexp(v.z(), -60);
      break;
    default:
      break;
  }
  return m;
}

}  // namespace touchstone::primitives
