// Random placed pairs of meshes for the core's own tests: open, closed, flat, scattered, of one triangle and
// of hundreds, with and without triangles that have no area, in general position and on a lattice.
#pragma once

#include <numbers>

#include "tests/core/random_pair.h"

namespace touchstone::test {

inline void add_square(TriangleMesh& m, int a, int b, int c, int d) {
  m.triangles.push_back({a, b, c});
  m.triangles.push_back({a, c, d});
}

/// n·k squares, each of two triangles; `at(i, j)` is the corner of a square, i ≤ n, j ≤ k.
template <class F>
TriangleMesh grid_mesh(int n, int k, F&& at) {
  TriangleMesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= k; ++j) m.vertices.push_back(at(i, j));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < k; ++j) {
      const int v = i * (k + 1) + j;
      add_square(m, v, v + k + 1, v + k + 2, v + 1);
    }
  return m;
}

/// A field over [−1, 1]² with heights up to `height`.
inline TriangleMesh hills(Rng& r, int n, double height) {
  return grid_mesh(n, n, [&](int i, int j) {
    return Vec3(2.0 * i / n - 1, 2.0 * j / n - 1, height > 0 ? r.uniform(-height, height) : 0);
  });
}

/// A closed surface about the origin, about 2·n·k triangles; `bump`: by how much radii vary.
inline TriangleMesh bumpy_ball(Rng& r, int n, int k, double bump) {
  const double a = r.uniform(0, 6), b = r.uniform(0, 6);
  return grid_mesh(n, k, [&](int i, int j) {
    const double theta = std::numbers::pi * i / n, phi = 2 * std::numbers::pi * (j % k) / k;
    const double radius = 1 + bump * std::sin(5 * theta + a) * std::sin(4 * phi + b);
    return Vec3(radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi),
                radius * std::cos(theta));
  });
}

inline TriangleMesh scattered(Rng& r, int triangles, bool lattice) {
  TriangleMesh m;
  for (int i = 0; i < triangles; ++i) {
    for (int k = 0; k < 3; ++k)
      m.vertices.push_back(lattice ? Vec3(static_cast<double>(r.below(5)) - 2,
                                          static_cast<double>(r.below(5)) - 2,
                                          static_cast<double>(r.below(5)) - 2)
                                   : Vec3(r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1)));
    m.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return m;
}

inline TriangleMesh box_mesh(const Vec3& half) {
  TriangleMesh m;
  for (int k = 0; k < 8; ++k)
    m.vertices.push_back(
        {(k & 1 ? 1 : -1) * half[0], (k & 2 ? 1 : -1) * half[1], (k & 4 ? 1 : -1) * half[2]});
  add_square(m, 0, 2, 3, 1);
  add_square(m, 4, 5, 7, 6);
  add_square(m, 0, 1, 5, 4);
  add_square(m, 2, 6, 7, 3);
  add_square(m, 0, 4, 6, 2);
  add_square(m, 1, 3, 7, 5);
  return m;
}

inline TriangleMesh random_mesh(Rng& r, bool lattice) {
  const int n = 1 + static_cast<int>(r.below(5));
  const auto half = [&] { return static_cast<double>(1 + r.below(4)) / 2; };
  switch (r.below(lattice ? 3 : 6)) {
    case 0:
      return scattered(r, 1 + static_cast<int>(r.below(r.chance(0.5) ? 2 : 8)), lattice);
    case 1:
      return hills(r, lattice ? 1 << r.below(3) : n, 0);
    case 2:
      return box_mesh({half(), half(), half()});
    case 3:
      return hills(r, n, r.uniform(0, 0.5));
    case 4:
      return bumpy_ball(r, 2 + n, 3 + n, r.uniform(0, 0.3));
    default:
      return bumpy_ball(r, 3 + n, 4 + n, 0);
  }
}

inline constexpr int mesh_regime_count = 6;
inline constexpr std::array<std::string_view, mesh_regime_count> mesh_regime_names{
    "apart", "overlapping", "near", "touching", "lattice", "stretched"};

/// Regimes by number, as named above.
inline Pair random_mesh_pair(Rng& r, int regime) {
  const bool lattice = regime == 4;
  Pair p{random_mesh(r, lattice), random_mesh(r, lattice), {}, {}};
  p.pose_a.rotation = lattice ? axis_rotation(r) : r.rotation();
  p.pose_b.rotation = lattice ? axis_rotation(r) : r.rotation();
  if (regime == 5) {
    scale_shape(p.a, std::ldexp(1 + r.uniform(), static_cast<int>(r.below(40)) - 20));
    scale_shape(p.b, std::ldexp(1 + r.uniform(), static_cast<int>(r.below(20)) - 10));
  }
  const auto whole = [&] { return static_cast<double>(r.below(7)) / 2 - 1.5; };
  p.pose_b.translation =
      lattice ? Vec3(whole(), whole(), whole()) : Vec3(r.unit_vector() * r.uniform(0, 1.5));
  if (regime == 0) p.pose_b.translation = r.unit_vector() * r.uniform(2, 8);
  if (regime == 3 && r.chance(0.3)) {  // the same surface twice
    p.b = p.a;
    p.pose_b = p.pose_a;
  } else if (regime == 2 || regime == 3) {
    aim(p, regime == 2 ? std::ldexp(1 + r.uniform(), -static_cast<int>(5 + r.below(46))) : 0);
  }
  if (r.chance(0.2)) {
    const Vec3 far = r.unit_vector() * std::ldexp(1, static_cast<int>(r.below(20)));
    p.pose_a.translation += far;
    p.pose_b.translation += far;
  }
  return p;
}

}  // namespace touchstone::test
