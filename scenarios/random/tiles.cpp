#include "scenarios/random/families.h"

#include <cmath>
#include <limits>

#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

enum class Sizes : std::uint8_t { eighths, any, mixed };

double one_size(Rng& rng, Sizes sizes) {
  if (sizes == Sizes::eighths) return static_cast<double>(1 + rng.below(8)) / 8;
  if (sizes == Sizes::any) return rng.uniform(0.1, 1);
  return rng.binary_scale(-7, 1);
}

// Shapes whose boxes and contacts can be decided exactly; mostly boxes, whose faces meet in rectangles.
Shape tile(Rng& rng, Sizes sizes) {
  const double x = one_size(rng, sizes), y = one_size(rng, sizes), z = one_size(rng, sizes);
  const auto kind = rng.below(10);
  if (kind == 0 && may_draw(ShapeKind::sphere)) return Sphere{x};
  if (kind == 1 && may_draw(ShapeKind::capsule)) return Capsule{x, y};
  if (kind == 2 && may_draw(ShapeKind::hull))
    return make_hull({{x, 0, 0}, {-x, 0, 0}, {0, y, 0}, {0, -y, 0}, {0, 0, z}, {0, 0, -z}});
  if (!may_draw(ShapeKind::box)) return random_shape(rng, random_convex_kind(rng), x);
  return Box{{x, y, z}};
}

double reach(const Scene& s, std::size_t body, const Vec3& n) {
  return support_value(s.shape_of(static_cast<int>(body)),
                       rotation_matrix(s.bodies[body].pose.rotation).transpose() * n);
}

double moved_by_ulps(double x, std::int64_t ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<double>::infinity());
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -std::numeric_limits<double>::infinity());
  return x;
}

// A position at which body i's box touches that of body j (which is at `at`): exactly where the lattice makes
// the sums exact, otherwise up to a few ulps to either side. In the other directions the boxes share a part
// of their faces, or the two points that determine them lie near each other, so that the bodies touch where
// their boxes do.
Vec3 beside(Rng& rng, const Scene& s, std::size_t i, std::size_t j, const Vec3& at, bool lattice) {
  const auto axis = static_cast<Eigen::Index>(rng.below(3));
  const double sign = rng.sign();
  const Vec3 n = Vec3::Unit(axis) * sign;
  const bool points_meet = !lattice && rng.chance(0.5);
  const Vec3 meet = farthest_point(s, static_cast<int>(j), n) - farthest_point(s, static_cast<int>(i), -n);
  Vec3 t = at + n * (reach(s, j, n) + reach(s, i, -n));
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (k == axis) continue;
    const double free = 0.4 * (reach(s, j, Vec3::Unit(k)) + reach(s, i, Vec3::Unit(k)));
    const double shift = rng.uniform(-free, free);
    t[k] += points_meet ? meet[k] + shift : (lattice ? std::round(shift * 8) / 8 : shift);
  }
  if (!lattice) t[axis] = moved_by_ulps(t[axis], static_cast<std::int64_t>(rng.below(7)) - 3);
  return t;
}

Quat tile_rotation(Rng& rng, Sizes sizes) {
  static const Quat turns[] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {1, 0, 0, 0}};
  if (rng.chance(sizes == Sizes::eighths ? 0.7 : 0.5)) return {};
  if (sizes != Sizes::eighths && rng.chance(0.7)) return rng.rotation();
  return turns[rng.below(std::size(turns))];
}

// The world origin, or a lattice point up to 2^20 from it in any octant.
Vec3 tile_origin(Rng& rng) {
  if (rng.chance(0.5)) return Vec3::Zero();
  const double far = std::round(rng.binary_scale(1, 19));
  Vec3 origin;
  for (double& e : origin) e = rng.chance(0.5) ? far : -far;
  return origin;
}

// A static half-space under the first body, its plane perpendicular to an axis.
void add_ground(Rng& rng, Scene& s) {
  const auto axis = static_cast<Eigen::Index>(rng.below(3));
  const Vec3 n = Vec3::Unit(axis);
  Body ground;
  ground.shape = static_cast<int>(s.shapes.size());
  s.shapes.push_back(HalfSpace{n, 0});
  ground.pose.translation = s.bodies[0].pose.translation;
  ground.pose.translation[axis] -= reach(s, 0, -n);
  ground.is_static = true;
  s.bodies.push_back(std::move(ground));
}

Scene tiled(Rng& rng, std::size_t n) {
  Scene s;
  const auto sizes = static_cast<Sizes>(rng.below(3));
  const bool lattice = sizes == Sizes::eighths;
  const Vec3 origin = tile_origin(rng);
  const double side = 1.8 * std::cbrt(static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    Body b;
    b.shape = static_cast<int>(i);
    s.shapes.push_back(tile(rng, sizes));
    b.pose.rotation = tile_rotation(rng, sizes);
    b.is_static = rng.below(6) == 0;
    s.bodies.push_back(b);
    Vec3 t = Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * (side / 2);
    for (double& e : t) e = std::round(e * 8) / 8;
    t += origin;
    if (i > 0 && rng.chance(0.6)) {
      const auto j = rng.below(i);
      t = beside(rng, s, i, j, s.bodies[j].pose.translation, lattice);
    }
    s.bodies[i].pose.translation = t;
  }
  if (rng.below(8) == 0) add_ground(rng, s);
  return s;
}

void query(Scene& s) { s.script.push_back({Step::Op::query, -1, std::nullopt}); }

// Where a body goes next: a few ulps away, a lattice step away, far away, or beside another body.
Pose next_pose(Rng& rng, const Scene& s, const std::vector<std::optional<Pose>>& present, std::size_t b) {
  Pose pose = present[b].value_or(s.bodies[b].pose);
  const auto axis = static_cast<Eigen::Index>(rng.below(3));
  const auto way = rng.below(8);
  if (way == 0) {
    pose.translation[axis] = moved_by_ulps(pose.translation[axis], rng.sign());
    return pose;
  }
  if (way == 1) {
    pose.translation[axis] += rng.chance(0.5) ? 0.125 : -0.125;
    return pose;
  }
  if (way == 2) {
    const double by = rng.binary_scale(-12, -2);
    pose.translation += rng.unit_vector() * by;
    return pose;
  }
  if (way == 3) {
    pose.translation[axis] += rng.chance(0.5) ? 64.0 : -64.0;
    return pose;
  }
  const auto j = rng.below(present.size());
  // The place beside a half-space is at infinity.
  if (j == b || !present[j] || kind_of(s.shape_of(static_cast<int>(j))) == ShapeKind::half_space)
    return s.bodies[b].pose;
  pose.translation = beside(rng, s, b, j, present[j]->translation, rng.chance(0.5));
  return pose;
}

}  // namespace

void tiles(Rng& rng, Case& c) {
  c.scene = tiled(rng, 2 + rng.below(24));
  c.queries = {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}};
}

void throng(Rng& rng, Case& c) {
  c.scene = tiled(rng, 40 + rng.below(rng.chance(0.5) ? 100 : 360));
  c.queries = {{Question::candidates, -1, -1}};
}

void errands(Rng& rng, Case& c) {
  const std::size_t n = 2 + rng.below(8);
  Scene s = tiled(rng, n);
  std::vector<std::optional<Pose>> present(s.bodies.size());
  const auto insert = [&](std::size_t b, const Pose& pose) {
    s.script.push_back({Step::Op::insert, static_cast<int>(b), pose});
    present[b] = pose;
  };
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    if (rng.chance(0.8)) insert(b, s.bodies[b].pose);
  query(s);
  const std::size_t count = 4 + rng.below(24);
  for (std::size_t k = 0; k < count; ++k) {
    const auto b = rng.below(n);  // the ground stays
    const Pose pose = next_pose(rng, s, present, b);
    if (!present[b]) {
      insert(b, rng.chance(0.3) ? s.bodies[b].pose : pose);
    } else if (rng.chance(0.3)) {
      s.script.push_back({Step::Op::remove, static_cast<int>(b), std::nullopt});
      present[b].reset();
    } else {
      s.script.push_back({Step::Op::move, static_cast<int>(b), pose});
      present[b] = pose;
    }
    if (rng.chance(0.4)) query(s);
  }
  query(s);
  c.scene = std::move(s);
  c.queries = {{Question::candidates, -1, -1}};
}

}  // namespace touchstone::fuzz
