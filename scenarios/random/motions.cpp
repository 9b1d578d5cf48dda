#include "scenarios/random/motions.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "scenarios/random/families.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

using std::numbers::pi;

Quat turn(const Vec3& axis, double angle) {
  const Vec3 v = axis.normalized() * std::sin(angle / 2);
  return {v.x(), v.y(), v.z(), std::cos(angle / 2)};
}

// The poses of all bodies at time t in [0, 1].
using Course = std::function<std::vector<Pose>(double t)>;

int add_body(Scene& s, Shape shape, bool is_static) {
  Body b;
  b.shape = static_cast<int>(s.shapes.size());
  b.is_static = is_static;
  s.shapes.push_back(std::move(shape));
  s.bodies.push_back(std::move(b));
  return static_cast<int>(s.bodies.size()) - 1;
}

// Half of the motions take place in a world that is rotated and shifted as a whole.
Pose random_world(Rng& rng) {
  if (rng.chance(0.5)) return {};
  return {rng.vector(0, 4), rng.rotation()};
}

Pose placed_in(const Pose& world, const Pose& p) {
  return {rotation_matrix(world.rotation) * p.translation + world.translation, world.rotation * p.rotation};
}

void write_script(Scene& s, const Pose& world, int frames, const Course& course) {
  std::vector<Pose> now;
  for (int k = 0; k < frames; ++k) {
    std::vector<Pose> next = course(static_cast<double>(k) / (frames - 1));
    for (std::size_t b = 0; b < next.size(); ++b) {
      next[b] = placed_in(world, next[b]);
      if (k == 0) s.bodies[b].pose = next[b];
      if (k == 0)
        s.script.push_back({Step::Op::insert, static_cast<int>(b), std::nullopt});
      else if (next[b] != now[b])
        s.script.push_back({Step::Op::move, static_cast<int>(b), next[b]});
    }
    s.script.push_back({Step::Op::query, -1, std::nullopt});
    now = std::move(next);
  }
}

void ask_about(Case& c, const std::vector<BodyPair>& pairs) {
  c.queries.clear();
  for (const Question q : {Question::contact, Question::distance})
    for (const auto& [a, b] : pairs) c.queries.push_back({q, a, b});
  c.queries.push_back({Question::candidates, -1, -1});
}

// A regular prism; its axis is z.
Hull prism(int sides, double radius, double half_height) {
  std::vector<Vec3> v;
  for (int i = 0; i < sides; ++i)
    for (const double z : {-half_height, half_height}) {
      const double angle = 2 * pi * i / sides;
      v.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  return make_hull(std::move(v));
}

struct Standing {
  Shape shape;
  double half_height = 0;
};

// A body that stands on a face.
Standing standing(Rng& rng) {
  const double h = rng.uniform(0.1, 0.3), r = rng.uniform(0.15, 0.4);
  switch (rng.below(3)) {
    case 0:
      return {Box{{r, r * rng.uniform(0.5, 1), h}}, h};
    case 1:
      return {Cylinder{r, h}, h};
    default:
      return {prism(3 + static_cast<int>(rng.below(6)), r, h), h};
  }
}

// The ground z <= 0: all of it, or a plate.
int add_ground(Rng& rng, Scene& s, double half_width) {
  if (rng.chance(0.4)) return add_body(s, HalfSpace{Vec3::UnitZ(), 0}, true);
  return add_body(s, Box{{half_width, half_width, 0.25}}, true);
}
Pose ground_pose(const Scene& s) {
  const bool plate = kind_of(s.shapes[0]) == ShapeKind::box;
  return {Vec3(0, 0, plate ? -0.25 : 0.0), Quat{}};
}

// Two bodies, one on the other, sink to their final depths while they rock less and less.
void settle(Rng& rng, int frames, Case& c) {
  Scene s;
  add_ground(rng, s, 1);
  const Standing low = standing(rng), high = standing(rng);
  add_body(s, low.shape, false);
  add_body(s, high.shape, false);
  const double sink = rng.binary_scale(-10, -6), on_top = rng.binary_scale(-10, -6);
  const double rocking = rng.binary_scale(-9, -5), beats = rng.uniform(4, 14), away = rng.uniform(0, 6);
  const Vec3 aside{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), 0};
  const Vec3 axis{std::cos(away), std::sin(away), 0};
  write_script(s, random_world(rng), frames, [=, ground = ground_pose(s)](double t) {
    const double fades = std::exp(-6 * t);
    const double angle = rocking * fades * std::cos(beats * t);
    const double z = low.half_height - sink * (1 - fades / 2);
    const double above = low.half_height + high.half_height - on_top * (1 - fades / 2);
    return std::vector<Pose>{ground, Pose{Vec3(0, 0, z), turn(axis, angle)},
                             Pose{aside + Vec3(0, 0, z + above), turn(axis, -angle / 2)}};
  });
  c.scene = std::move(s);
  ask_about(c, {{0, 1}, {1, 2}});
}

// A body slides over the ground, turns about the vertical, and leaves a plate over its border.
void slide(Rng& rng, int frames, Case& c) {
  Scene s;
  add_ground(rng, s, 1);
  const Standing body = standing(rng);
  add_body(s, body.shape, false);
  const double depth = rng.binary_scale(-12, -6), turning = rng.chance(0.5) ? 0 : rng.uniform(-2, 2);
  const double start = rng.uniform(-1.2, 0.5), way = rng.uniform(0.3, 2), heading = rng.uniform(0, 6);
  const Vec3 along{std::cos(heading), std::sin(heading), 0};
  write_script(s, random_world(rng), frames, [=, ground = ground_pose(s)](double t) {
    const Vec3 where = along * (start + way * t) + Vec3(0, 0, body.half_height - depth);
    return std::vector<Pose>{ground, Pose{where, turn(Vec3::UnitZ(), heading + turning * t)}};
  });
  c.scene = std::move(s);
  ask_about(c, {{0, 1}});
}

// The lowest point of body 1 in this orientation, above its origin.
double lowest(Scene s, const Quat& rotation) {
  s.bodies[1].pose.rotation = rotation;
  return farthest_point(s, 1, -Vec3::UnitZ()).z();
}

// A body that rolls: the axis of its turning is y, and it moves along x by its radius times the angle.
void roll(Rng& rng, int frames, Case& c) {
  Scene s;
  add_ground(rng, s, 2);
  const double r = rng.uniform(0.1, 0.4), h = rng.uniform(0.1, 0.5);
  const auto style = rng.below(4);
  const Shape rollers[] = {Sphere{r}, Cylinder{r, h}, Capsule{r, h},
                           prism(3 + static_cast<int>(rng.below(8)), r, h)};
  add_body(s, rollers[style], false);
  const double depth = rng.binary_scale(-10, -5), angle = rng.uniform(0.5, 4), start = rng.uniform(-1, 0);
  const Quat lying = turn(Vec3::UnitX(), pi / 2);
  write_script(s, random_world(rng), frames, [=, ground = ground_pose(s)](double t) {
    const Quat q = turn(Vec3::UnitY(), angle * t) * lying;
    const Vec3 where{start + r * angle * t, 0, -depth - lowest(s, q)};
    return std::vector<Pose>{ground, Pose{where, q}};
  });
  c.scene = std::move(s);
  ask_about(c, {{0, 1}});
}

// A spinning top: it turns fast about its axis, which circles the vertical at a small or no angle.
void top(Rng& rng, int frames, Case& c) {
  Scene s;
  add_ground(rng, s, 1);
  const ShapeKind kinds[] = {ShapeKind::cone,      ShapeKind::box,  ShapeKind::cylinder,
                             ShapeKind::ellipsoid, ShapeKind::hull, ShapeKind::capsule};
  add_body(s, random_shape(rng, kinds[rng.below(std::size(kinds))], 0.3), false);
  const double depth = rng.binary_scale(-10, -5), tilt = rng.chance(0.25) ? 0 : rng.uniform(0.02, 0.5);
  const double spins = rng.uniform(1, 12), circles = rng.uniform(0.2, 2);
  const Quat upright = rng.chance(0.5) ? Quat{1, 0, 0, 0} : Quat{};  // a cone on its apex or its base
  write_script(s, random_world(rng), frames, [=, ground = ground_pose(s)](double t) {
    const Quat q = turn(Vec3::UnitZ(), circles * t) * turn(Vec3::UnitX(), tilt) *
                   turn(Vec3::UnitZ(), spins * t) * upright;
    return std::vector<Pose>{ground, Pose{Vec3(0, 0, -depth - lowest(s, q)), q}};
  });
  c.scene = std::move(s);
  ask_about(c, {{0, 1}});
}

// Two plates that overlap at a common edge, which is the axis of the hinge: one swings.
void hinge(Rng& rng, int frames, Case& c) {
  Scene s;
  const double wide = rng.uniform(0.4, 0.8), thin = rng.uniform(0.05, 0.15), tall = rng.uniform(0.2, 0.5);
  add_body(s, Box{{wide, thin, tall}}, rng.chance(0.5));
  add_body(s, Box{{wide * rng.uniform(0.6, 1), thin, tall * rng.uniform(0.6, 1)}}, false);
  const double half = std::get<Box>(s.shapes[1]).half_extents.x(), joint = rng.binary_scale(-8, -4);
  const double from = rng.uniform(-0.5, 0.5), sign = rng.sign(), by = sign * rng.uniform(0.5, 2.2);
  write_script(s, random_world(rng), frames, [=](double t) {
    const Quat q = turn(Vec3::UnitZ(), from + by * t);
    const Vec3 arm = rotation_matrix(q) * Vec3(half - joint, 0, 0);
    return std::vector<Pose>{Pose{}, Pose{Vec3(wide, 0, 0) + arm, q}};
  });
  c.scene = std::move(s);
  ask_about(c, {{0, 1}});
}

// A body passes through another, so that the direction of least depth truly changes.
void pass(Rng& rng, int frames, Case& c) {
  Scene s;
  const ShapeKind a = random_convex_kind(rng), b = random_convex_kind(rng);
  s = random_pair(rng, a, b, 0.5, Vec3::Zero());
  const Vec3 along = rng.unit_vector(), aside = rng.vector(0, 0.4);
  const double way = rng.uniform(0.5, 2.2), spin = rng.chance(0.5) ? 0 : rng.uniform(-1.5, 1.5);
  const Quat qa = s.bodies[0].pose.rotation, qb = s.bodies[1].pose.rotation;
  const Vec3 axis = rng.unit_vector();
  write_script(s, random_world(rng), frames, [=](double t) {
    return std::vector<Pose>{Pose{Vec3::Zero(), qa},
                             Pose{aside + along * (way * (t - 0.5)), turn(axis, spin * t) * qb}};
  });
  c.scene = std::move(s);
  ask_about(c, {{0, 1}});
}

constexpr MotionRow rows[] = {
    {"settle", "two bodies in a stack sink and rock until they rest", settle},
    {"slide", "a body slides over the ground and leaves a plate over its border", slide},
    {"roll", "a sphere, cylinder, capsule or prism rolls on the ground", roll},
    {"top", "a body spins on the ground, its axis circling the vertical", top},
    {"hinge", "two plates overlap at an edge, about which one swings", hinge},
    {"pass", "a body passes through another", pass},
};

}  // namespace

std::span<const MotionRow> motion_rows() { return rows; }

void motions(Rng& rng, Case& c) {
  const MotionRow& row = rows[rng.below(std::size(rows))];
  const int frames = 4 + static_cast<int>(rng.below(13));
  row.make(rng, frames, c);
}

}  // namespace touchstone::fuzz
