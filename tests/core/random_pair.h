// Random placed pairs for the core's own tests: all convex shapes, sizes down to zero, and regimes that are
// hard for an algorithm. Independent of the harness's generator: a second opinion on what is worth trying.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "core/scene/scene.h"

namespace touchstone::test {

enum class Regime { separate, near, shallow, deep, contained, coaxial, aligned, lattice_touch };
inline constexpr int regime_count = 8;
inline constexpr std::array<std::string_view, regime_count> regime_names{
    "separate", "near", "shallow", "deep", "contained", "coaxial", "aligned", "lattice_touch"};

struct Pair {
  Shape a, b;
  Pose pose_a, pose_b;
  PlacedShape placed_a() const { return {&a, pose_a}; }
  PlacedShape placed_b() const { return {&b, pose_b}; }
};

/// L of truth.md §3 for the pair.
inline double scale_of(const Pair& p) {
  Scene s;
  s.shapes = {p.a, p.b};
  s.bodies.resize(2);
  s.bodies[0].shape = 0;
  s.bodies[0].pose = p.pose_a;
  s.bodies[1].shape = 1;
  s.bodies[1].pose = p.pose_b;
  return scale_of_pair(s, 0, 1);
}

inline double random_size(Rng& rng, bool lattice) {
  if (lattice) return static_cast<double>(1 + rng.below(4)) / 2;
  const double u = rng.uniform();
  if (u < 0.03) return 0;
  if (u < 0.06) return std::ldexp(1 + rng.uniform(), -30);
  if (u < 0.2) return std::ldexp(1 + rng.uniform(), -7);
  return rng.uniform(0.2, 1.5);
}

/// Coordinates from −most to most.
inline Vec3 lattice_point(Rng& rng, int most) {
  const auto coordinate = [&] { return static_cast<double>(rng.below(2 * most + 1)) - most; };
  return Vec3{coordinate(), coordinate(), coordinate()};
}

inline Vec3 point_between(Rng& rng, double least, double most) {
  const Vec3 n = rng.unit_vector();
  return n * rng.uniform(least, most);
}

inline Hull random_hull(Rng& rng, bool lattice) {
  std::vector<Vec3> v;
  const int n = 1 + static_cast<int>(rng.below(rng.chance(0.2) ? 4 : 24));
  const int flat = rng.chance(0.15) ? static_cast<int>(rng.below(3)) : -1;
  for (int i = 0; i < n; ++i) {
    Vec3 p = lattice ? lattice_point(rng, 2) : point_between(rng, 0.3, 1.2);
    if (flat >= 0) p[flat] = 0;
    v.push_back(p);
  }
  return make_hull(std::move(v));
}

inline Shape random_shape(Rng& rng, ShapeKind kind, bool lattice) {
  const auto size = [&] { return random_size(rng, lattice); };
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{size()};
    case ShapeKind::box:
      return Box{{size(), size(), size()}};
    case ShapeKind::capsule:
      return Capsule{size(), size()};
    case ShapeKind::cylinder:
      return Cylinder{size(), size()};
    case ShapeKind::cone:
      return Cone{size(), size()};
    case ShapeKind::ellipsoid: {
      const auto axis = [&] { return std::max(size(), 1e-3); };
      if (rng.chance(0.3)) {
        const double x = axis();
        return Ellipsoid{{x, x, rng.chance(0.3) ? x : axis()}};
      }
      return Ellipsoid{{axis(), axis(), axis()}};
    }
    case ShapeKind::hull:
      return random_hull(rng, lattice);
    default:
      return HalfSpace{point_between(rng, 0.5, 2), rng.uniform(-1, 1)};
  }
}

inline Quat axis_rotation(Rng& rng) {
  static constexpr double s = 0.70710678118654752440;
  const std::array<Quat, 6> q{Quat{0, 0, 0, 1}, Quat{1, 0, 0, 0}, Quat{0, s, 0, s},
                              Quat{s, 0, 0, s}, Quat{0, 0, 1, 1}, Quat{0.5, 0.5, 0.5, 0.5}};
  return q[rng.below(q.size())];
}

inline void scale_shape(Shape& s, double k) {
  std::visit(
      [&](auto& x) {
        for_each_field(x, [&](std::string_view name, auto& v, Domain) {
          using T = std::remove_reference_t<decltype(v)>;
          if constexpr (std::is_same_v<T, double>) v *= k;
          if constexpr (std::is_same_v<T, Vec3>) {
            if (name != "normal") v *= k;
          }
          if constexpr (std::is_same_v<T, std::vector<Vec3>>)
            for (Vec3& p : v) p *= k;
        });
      },
      s);
}

/// Moves B along the core's own normal until the gap is `gap`. Only for aiming: no test relies on the result.
inline void aim(Pair& p, double gap) {
  const Separation s = separation(p.placed_a(), p.placed_b());
  if (s.outcome == Outcome::answered)
    p.pose_b.translation += (s.normal * (static_cast<Wide>(gap) - s.gap)).cast<double>();
}

inline Pair random_pair(Rng& rng, ShapeKind ka, ShapeKind kb, Regime regime) {
  const bool lattice = regime == Regime::aligned || regime == Regime::lattice_touch;
  Pair p{random_shape(rng, ka, lattice), random_shape(rng, kb, lattice), {}, {}};
  const double mantissa = 1 + rng.uniform();
  const double fine = std::ldexp(mantissa, -static_cast<int>(5 + rng.below(46)));
  p.pose_a.rotation = rng.rotation();
  p.pose_b.rotation = rng.rotation();
  switch (regime) {
    case Regime::separate:
      p.pose_b.translation = point_between(rng, 2, 8);
      break;
    case Regime::near:
      p.pose_b.translation = rng.unit_vector() * 3;
      aim(p, fine);
      aim(p, fine);
      break;
    case Regime::shallow:
      p.pose_b.translation = rng.unit_vector() * 3;
      aim(p, -fine);
      aim(p, -fine);
      break;
    case Regime::deep:
      p.pose_b.translation = point_between(rng, 0, 0.7);
      break;
    case Regime::contained:
      scale_shape(p.b, 0.05);
      p.pose_b.translation = point_between(rng, 0, 0.2);
      break;
    case Regime::coaxial:
      p.pose_b.rotation = p.pose_a.rotation;
      if (rng.chance(0.3))
        p.pose_b.rotation = p.pose_a.rotation * Quat{0, 0, rng.uniform(-1, 1), rng.uniform(-1, 1)};
      if (rng.chance(0.3)) p.pose_b.rotation.x += fine;
      if (rng.chance(0.5)) p.pose_b.translation = rng.unit_vector() * fine;
      if (rng.chance(0.3))
        p.pose_b.translation += rotation_matrix(p.pose_a.rotation).col(2) * rng.uniform(-0.5, 0.5);
      if (rng.chance(0.2)) p.b = p.a;
      break;
    case Regime::aligned:
      p.pose_a.rotation = axis_rotation(rng);
      p.pose_b.rotation = axis_rotation(rng);
      p.pose_b.translation = lattice_point(rng, 4) / 4;
      break;
    case Regime::lattice_touch:
      p.pose_a.rotation = p.pose_b.rotation = {};
      p.pose_b.translation = lattice_point(rng, 4) / 2;
      aim(p, 0);
      break;
  }
  if (rng.chance(0.3)) {
    const double k = rng.binary_scale(-20, 20);
    scale_shape(p.a, k);
    scale_shape(p.b, k);
    p.pose_a.translation *= k;
    p.pose_b.translation *= k;
  }
  if (rng.chance(0.3)) {
    const Vec3 way = rng.unit_vector();
    const Vec3 offset = way * std::ldexp(1.0, static_cast<int>(rng.below(21)));
    p.pose_a.translation += offset;
    p.pose_b.translation += offset;
  }
  if (rng.chance(0.5)) {
    std::swap(p.a, p.b);
    std::swap(p.pose_a, p.pose_b);
  }
  return p;
}

}  // namespace touchstone::test
