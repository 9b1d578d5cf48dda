#include "scenarios/random/families.h"

#include <cmath>

#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

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
// perpendicular to n: the bodies pass each other with that gap (of either sign, 1e-2 to 1e-8 of their size)
// and touch nowhere else.
void graze(Rng& rng, Case& c) {
  const ShapeKind a = random_convex_kind(rng);
  const ShapeKind b = random_convex_kind(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  const Vec3 n = rng.unit_vector();
  const double size = mean_extent(s);
  const int sign = rng.chance(0.4) ? 1 : -1;
  const double gap = sign * rng.binary_scale(-26, -7) * size;
  const Vec3 at_contact = farthest_point(s, 0, n) - farthest_point(s, 1, -n) + n * gap;
  const Vec3 u = rng.unit_vector();
  const Vec3 along = (u - u.dot(n) * n) * (rng.uniform(1, 8) * size);
  const double tc = rng.uniform(0.2, 0.8);
  s.bodies[1].pose.translation = at_contact - tc * along;
  s.bodies[1].motion = Motion{along, Vec3::Zero()};
  ask_impact(c, std::move(s));
}

// A plate 100 to 1000 times thinner than wide, and a small body that flies through it or past its rim at 4 to
// 60 times its width per step.
void bullet(Rng& rng, Case& c) {
  Scene s = random_pair(rng, ShapeKind::box, random_convex_kind(rng), 1, Vec3::Zero());
  const double wide = rng.uniform(0.5, 2), thin = wide * rng.binary_scale(-10, -7);
  s.shapes[0] = rng.chance(0.7) ? Shape{Box{{wide, wide, thin}}} : Shape{Cylinder{wide, thin}};
  s.shapes[1] = random_shape(rng, kind_of(s.shapes[1]), 0.05);
  const Mat3 r = rotation_matrix(s.bodies[0].pose.rotation);
  const Vec3 hit{rng.uniform(-1.2, 1.2) * wide, rng.uniform(-1.2, 1.2) * wide, 0};
  const double through = rng.chance(0.5) ? 1.5 : -1.5;
  const Vec3 way = rng.unit_vector() + Vec3(0, 0, through);
  const Vec3 linear = r * way * (rng.uniform(2, 30) * wide);
  s.bodies[1].pose.translation = r * hit - linear * rng.uniform(0.05, 0.95);
  Motion m{linear, Vec3::Zero()};
  if (rng.chance(0.3)) m.angular = rng.vector(0.1, 9);
  s.bodies[1].motion = m;
  ask_impact(c, std::move(s));
}

// If the bodies meet, they do so within 0.05 % of the end of the step, a fifth of them just after it: A is at
// rest, and B's farthest point reaches A's farthest point along n at that time. Half of the bodies turn.
void last_moment(Rng& rng, Case& c) {
  const auto [a, b] = random_kinds(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  const Vec3 n = placement_direction(rng, s);
  place_along(rng, s, n, 0, 0.2);
  // For convex bodies the farthest points meet, not just the planes through them.
  if (is_convex(a))
    s.bodies[1].pose.translation =
        s.bodies[0].pose.translation + farthest_point(s, 0, n) - farthest_point(s, 1, -n);
  const double before_end = rng.binary_scale(-36, -11);
  const double t = rng.chance(0.2) ? 1 + before_end : 1 - before_end;
  const Vec3 u = rng.unit_vector();
  const Vec3 towards = -n + 0.8 * (u - u.dot(n) * n);
  Motion m{towards * (rng.uniform(0.2, 3) * mean_extent(s)), Vec3::Zero()};
  Body& body = s.bodies[1];
  body.pose.translation -= t * m.linear;
  if (rng.chance(0.5)) {
    m.angular = rng.vector(0.1, 6);
    // Turn it back, so that near t it touches in the orientation in which it was placed.
    body.pose = pose_at(body.pose, Motion{Vec3::Zero(), -m.angular}, std::min(t, 1.0));
  }
  body.motion = m;
  ask_impact(c, std::move(s));
}

// Bodies that turn by 9 to 60 radians in the step while they close in or pass.
void whirl(Rng& rng, Case& c) {
  const auto [a, b] = random_kinds(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  const Vec3 n = placement_direction(rng, s);
  const double size = mean_extent(s);
  const double gap = rng.uniform(0.05, 1) * size, way = rng.uniform(0, 2.5) * size;
  place_along(rng, s, n, gap, 0.5);
  const Vec3 aside = rng.vector(0, 0.5) * size;
  s.bodies[1].motion = Motion{aside - n * way, rng.vector(9, 60)};
  if (!s.bodies[0].is_static && rng.chance(0.3)) s.bodies[0].motion = Motion{Vec3::Zero(), rng.vector(9, 60)};
  ask_impact(c, std::move(s));
}

namespace {

enum class Going { along_an_axis, straight, turning, both, fast };

// Long and thin, so that turning matters.
Shape rod(Rng& rng) {
  const double length = rng.uniform(0.5, 2), width = rng.uniform(0.03, 0.3);
  if (rng.chance(0.5)) return Box{{width, width * rng.uniform(0.5, 1), length}};
  return rng.chance(0.5) ? Shape{Capsule{width, length}} : Shape{Cylinder{width, length}};
}

Motion motion_of(Rng& rng, Going g, double way) {
  const double length = rng.uniform(-1.5, 1.5) * way;
  const Vec3 any = rng.unit_vector();
  switch (g) {
    case Going::along_an_axis:
      return {Vec3::Unit(static_cast<int>(rng.below(3))) * length, Vec3::Zero()};
    case Going::straight:
      return {any * length, Vec3::Zero()};
    case Going::turning:
      return {Vec3::Zero(), rng.vector(0.3, 9)};
    case Going::both:
      return {any * length, rng.vector(0.3, 9)};
    case Going::fast:
      return {any * (length * rng.binary_scale(3, 7)), rng.chance(0.3) ? rng.vector(0.3, 20) : Vec3(0, 0, 0)};
  }
  return {};
}

}  // namespace

// 3 to 20 bodies, most of which move in one of five ways: along one world axis, in any direction, turning in
// place, both, or fast and from so far away that they arrive about midway.
void swarm(Rng& rng, Case& c) {
  const auto n = 3 + rng.below(18);
  const auto going = static_cast<Going>(rng.below(5));
  const bool slender = going == Going::turning || rng.chance(0.3);
  const double side = 2.2 * std::cbrt(static_cast<double>(n));
  Scene& s = c.scene;
  for (std::uint64_t i = 0; i < n; ++i) {
    Body b;
    b.shape = static_cast<int>(i);
    const ShapeKind kind = random_convex_kind(rng);
    s.shapes.push_back(slender ? rod(rng) : random_shape(rng, kind, 0.7));
    b.pose.rotation = rng.chance(0.3) ? Quat{} : rng.rotation();
    const double x = rng.uniform(-0.5, 0.5), y = rng.uniform(-0.5, 0.5), z = rng.uniform(-0.5, 0.5);
    b.pose.translation = Vec3(x, y, z) * side;
    if (rng.below(6) == 0) {
      b.is_static = rng.chance(0.5);
    } else {
      b.motion = motion_of(rng, going, side / 2);
      if (going == Going::fast) b.pose.translation -= rng.uniform(0.1, 0.9) * b.motion->linear;
    }
    s.bodies.push_back(std::move(b));
  }
  c.queries = {{Question::swept_candidates, -1, -1}, {Question::candidates, -1, -1}};
  for (const auto& [a, b] : {BodyPair{0, 1}, BodyPair{0, 2}, BodyPair{1, 2}})
    c.queries.push_back({Question::time_of_impact, a, b});
}

}  // namespace touchstone::fuzz
