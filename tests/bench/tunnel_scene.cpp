#include "tests/bench/tunnel_scene.h"

#include <cmath>

namespace touchstone::bench {
namespace {

constexpr double bullet_radius = 0.01, plate_half = 1, plate_thickness = 0.004, bullet_travel = 3;

Shape crowd_shape(Rng& r, std::uint64_t kind) {
  const auto size = [&] { return r.uniform(0.1, 0.3); };
  switch (kind) {
    case 0:
      return Box{{size(), size(), size()}};
    case 1:
      return Sphere{size()};
    case 2:
      return Capsule{size(), size()};
    case 3:
      return Cylinder{size(), size()};
    default: {
      std::vector<Vec3> v;
      for (int i = 0; i < 16; ++i) v.push_back(r.unit_vector().normalized() * 0.3);
      return make_hull(std::move(v));
    }
  }
}

double exponential(Rng& r, double mean) { return -mean * std::log(1 - r.uniform()); }

}  // namespace

TunnelScene tunnel_scene(int bodies, std::uint64_t seed) {
  TunnelScene t;
  Rng r(seed);
  Scene& s = t.scene;
  s.shapes.push_back(Sphere{bullet_radius});
  s.shapes.push_back(Box{{plate_thickness / 2, plate_half, plate_half}});
  const auto first_crowd_shape = static_cast<int>(s.shapes.size());
  constexpr int shapes = 40;
  for (int i = 0; i < shapes; ++i) s.shapes.push_back(crowd_shape(r, static_cast<std::uint64_t>(i) % 5));
  for (int i = 0; i < bodies; ++i) {
    Body b;
    if (i < t.bullets) {
      b.pose.translation = Vec3(-5, i, 0);
    } else if (i < t.bullets + t.plates) {
      // A corridor of plates beside the crowd, a metre apart.
      b.shape = 1;
      b.is_static = true;
      b.pose.translation = Vec3(i - t.bullets, -4, 5);
    } else {
      const int k = i - t.bullets - t.plates, side = 10;
      b.shape = first_crowd_shape + static_cast<int>(r.below(shapes));
      b.pose.translation = Vec3(k % side, k / side % side, k / (side * side)) * 0.5 + r.unit_vector() * 0.05;
      b.pose.rotation = r.rotation();
      b.motion =
          Motion{r.unit_vector().normalized() * exponential(r, 0.02), r.unit_vector() * exponential(r, 0.02)};
    }
    s.bodies.push_back(b);
  }
  return t;
}

std::vector<Shot> shots(const TunnelScene& s, Rng& r) {
  std::vector<Shot> all;
  for (int i = 0; i < s.bullets; ++i) {
    const auto plate = static_cast<std::size_t>(s.bullets) + r.below(static_cast<std::uint64_t>(s.plates));
    const Vec3 target =
        s.scene.bodies[plate].pose.translation + Vec3(0, r.uniform(-0.9, 0.9), r.uniform(-0.9, 0.9));
    const double side = r.chance(0.5) ? 1 : -1;
    const Vec3 way = Vec3(side, r.uniform(-0.7, 0.7), r.uniform(-0.7, 0.7)).normalized();
    all.push_back({{target - way * r.uniform(0.2, 2.5), {}}, {way * bullet_travel, Vec3::Zero()}});
  }
  return all;
}

}  // namespace touchstone::bench
