// Random scenes over all shapes with numbers from the whole range of doubles.
#pragma once

#include <array>
#include <limits>

#include "core/math/rng.h"
#include "core/scene/scene.h"

namespace touchstone::test {

inline double nasty_double(Rng& rng) {
  static constexpr auto special =
      std::to_array<double>({0.0, -0.0, 5e-324, -5e-324, 0x1p-1022, 0x1.fffffffffffffp-1023, 1e308, -1e308,
                             0.1, 1e23, 9007199254740993.0, std::numeric_limits<double>::max()});
  if (rng.chance(0.3)) return special[rng.below(special.size())];
  const double x = rng.binary_scale(-1000, 1000);
  return rng.chance(0.5) ? x : -x;
}

inline double nasty_size(Rng& rng) {
  const double x = std::abs(nasty_double(rng));
  return x > 0 ? x : 1;
}

inline Vec3 nasty_vec3(Rng& rng) {
  const double x = nasty_double(rng), y = nasty_double(rng), z = nasty_double(rng);
  return {x, y, z};
}

// Hull vertices stay within the range in which the exact dimension test works (1e-95 .. 1e95).
inline Shape nasty_shape(Rng& rng, ShapeKind kind) {
  const auto size = [&] { return nasty_size(rng); };
  const auto sizes = [&] {
    const double x = size(), y = size(), z = size();
    return Vec3(x, y, z);
  };
  const auto points = [&](int n) {
    std::vector<Vec3> v;
    for (int i = 0; i < n; ++i) v.push_back(rng.unit_vector() * rng.binary_scale(-60, 60));
    return v;
  };
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{size()};
    case ShapeKind::box:
      return Box{sizes()};
    case ShapeKind::capsule:
      return Capsule{size(), size()};
    case ShapeKind::cylinder:
      return Cylinder{size(), size()};
    case ShapeKind::cone:
      return Cone{size(), size()};
    case ShapeKind::ellipsoid:
      return Ellipsoid{sizes()};
    case ShapeKind::hull:
      return make_hull(points(1 + static_cast<int>(rng.below(12))));
    case ShapeKind::half_space:
      return HalfSpace{nasty_vec3(rng) + Vec3(0, 0, 1), nasty_double(rng)};
    case ShapeKind::mesh:
      return TriangleMesh{points(5), {{0, 1, 2}, {4, 3, 2}, {1, 1, 1}}};
    case ShapeKind::rounded_box:
      return RoundedBox{sizes(), size()};
    case ShapeKind::solid_mesh: {
      const double scale = rng.binary_scale(-60, 60);
      TriangleMesh m{{Vec3::Zero(), Vec3::UnitX() * scale, Vec3::UnitY() * scale, Vec3::UnitZ() * scale},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
      return SolidMesh(std::move(m));
    }
    case ShapeKind::padded_cylinder:
      return Padded<Cylinder>{{size(), size()}, size()};
    case ShapeKind::padded_cone:
      return Padded<Cone>{{size(), size()}, size()};
    case ShapeKind::padded_ellipsoid:
      return Padded<Ellipsoid>{{sizes()}, size()};
    case ShapeKind::padded_hull:
      return Padded<Hull>{make_hull(points(1 + static_cast<int>(rng.below(12)))), size()};
  }
  return Sphere{1};
}

inline Pose nasty_pose(Rng& rng) {
  Pose p;
  if (rng.chance(0.8)) p.translation = nasty_vec3(rng);
  if (rng.chance(0.8))
    p.rotation = {nasty_double(rng), nasty_double(rng), nasty_double(rng), nasty_size(rng)};
  return p;
}

inline Scene nasty_scene(Rng& rng) {
  Scene s;
  if (rng.chance(0.5)) s.name = "a \"name\"\twith \xc3\xa9 and \\";
  for (int k = 0; k < shape_kind_count; ++k) s.shapes.push_back(nasty_shape(rng, static_cast<ShapeKind>(k)));
  const int n = 2 + static_cast<int>(rng.below(12));
  for (int i = 0; i < n; ++i) {
    Body b;
    b.shape = static_cast<int>(rng.below(s.shapes.size()));
    b.pose = nasty_pose(rng);
    const ShapeKind kind = kind_of(s.shapes[static_cast<std::size_t>(b.shape)]);
    const bool can_move = is_convex(kind);
    if (can_move && rng.chance(0.5)) b.motion = Motion{nasty_vec3(rng), nasty_vec3(rng)};
    if (rng.chance(0.2)) b.motion = Motion{};
    b.is_static = rng.chance(0.3);
    if (rng.chance(0.3)) b.group = static_cast<int>(rng.below(3));
    if (rng.chance(0.5)) b.name = "body" + std::to_string(i);
    s.bodies.push_back(b);
  }
  if (rng.chance(0.5)) s.ignored = {{0, 1}};
  if (rng.chance(0.5)) {
    s.script = {{Step::Op::insert, 0, std::nullopt},  {Step::Op::insert, 1, nasty_pose(rng)}, {},
                {Step::Op::move, 0, nasty_pose(rng)}, {Step::Op::remove, 1, std::nullopt},    {}};
  }
  return s;
}

}  // namespace touchstone::test
