#include "fuzz/generate/courses.h"

#include "fuzz/generate/place.h"
#include "fuzz/generate/random_shape.h"

namespace touchstone::fuzz {
namespace {

void ask_impact(Case& c, Scene s) {
  c.scene = std::move(s);
  c.queries = {{Question::time_of_impact, 0, 1}};
}

}  // namespace

void start_in_contact(Rng& rng, Case& c) {
  const auto [a, b] = random_kinds(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  const Vec3 n = placement_direction(rng, s);
  const double depth = rng.chance(0.5) ? rng.uniform(0.1, 0.8) : rng.binary_scale(-20, -4);
  place_along(rng, s, n, -depth * mean_extent(s), 0.2);
  Motion m{rng.vector(0.1, 3), Vec3::Zero()};
  if (rng.chance(0.5)) m.angular = rng.vector(0.01, 4);
  s.bodies[1].motion = m;
  ask_impact(c, std::move(s));
}

// At time tc in (0,1) the two farthest points along n coincide up to the gap, and the velocity is
// perpendicular to n: the bodies pass with that gap (of either sign, 1e-2 to 1e-8 of their size) and touch
// nowhere else.
void graze(Rng& rng, Case& c) {
  const ShapeKind a = random_convex_kind(rng);
  const ShapeKind b = random_convex_kind(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  const Vec3 n = rng.unit_vector();
  const double size = mean_extent(s);
  const double gap = (rng.chance(0.4) ? 1 : -1) * rng.binary_scale(-26, -7) * size;
  const Vec3 at_contact = farthest_point(s, 0, n) - farthest_point(s, 1, -n) + n * gap;
  const Vec3 u = rng.unit_vector();
  const Vec3 along = (u - u.dot(n) * n) * (rng.uniform(1, 8) * size);
  const double tc = rng.uniform(0.2, 0.8);
  s.bodies[1].pose.translation = at_contact - tc * along;
  s.bodies[1].motion = Motion{along, Vec3::Zero()};
  ask_impact(c, std::move(s));
}

// A plate 100 to 1000 times thinner than wide, and a small body that flies through it, or past its rim, at 4
// to 60 times its width a step.
void bullet(Rng& rng, Case& c) {
  Scene s = random_pair(rng, ShapeKind::box, random_convex_kind(rng), 1, Vec3::Zero());
  const double wide = rng.uniform(0.5, 2), thin = wide * rng.binary_scale(-10, -7);
  s.shapes[0] = rng.chance(0.7) ? Shape{Box{{wide, wide, thin}}} : Shape{Cylinder{wide, thin}};
  s.shapes[1] = random_shape(rng, kind_of(s.shapes[1]), 0.05);
  const Mat3 r = rotation_matrix(s.bodies[0].pose.rotation);
  const Vec3 hit{rng.uniform(-1.2, 1.2) * wide, rng.uniform(-1.2, 1.2) * wide, 0};
  const Vec3 way = rng.unit_vector() + Vec3(0, 0, rng.chance(0.5) ? 1.5 : -1.5);
  const Vec3 linear = r * way * (rng.uniform(2, 30) * wide);
  s.bodies[1].pose.translation = r * hit - linear * rng.uniform(0.05, 0.95);
  Motion m{linear, Vec3::Zero()};
  if (rng.chance(0.3)) m.angular = rng.vector(0.1, 9);
  s.bodies[1].motion = m;
  ask_impact(c, std::move(s));
}

}  // namespace touchstone::fuzz
