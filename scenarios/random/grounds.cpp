// Height fields, and bodies that are several shapes.
#include <cmath>
#include <iterator>

#include "scenarios/random/families.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"
#include "scenarios/value/height_surface.h"

namespace touchstone::fuzz {
namespace {

// Heights between -height and height at a point of the grid, x and y in [-1, 1].
double height_at(Rng& rng, std::uint64_t style, double x, double y, double height) {
  switch (style) {
    case 0:
      return 0;
    case 1:  // a slope
      return to_eighths(height) * (x + y) / 2;
    case 2:  // steps
      return x < 0 ? -height : height;
    case 3:  // a hill
      return height * (1 - std::min(1.0, x * x + y * y));
    case 4:
      return to_eighths(rng.uniform(-height, height));
    default:
      return rng.uniform(-height, height);
  }
}

// As the codec of scenes reads one: centred at the origin, with cells of any proportions.
TriangleMesh random_field(Rng& rng, double scale) {
  const std::size_t columns = 2 + rng.below(12), rows = 2 + rng.below(12);
  const double dx = scale * rng.uniform(0.1, 1), dy = rng.chance(0.5) ? dx : scale * rng.uniform(0.1, 1);
  const auto style = rng.below(8);
  const double height = rng.uniform(0.05, 1.5) * std::min(dx, dy);
  const auto share = [](std::size_t i, std::size_t n) {
    return 2 * static_cast<double>(i) / static_cast<double>(n - 1) - 1;
  };
  return centred_height_surface(rows, columns, dx, dy, [&](std::size_t r, std::size_t c) {
    return height_at(rng, style, share(c, columns), share(r, rows), height);
  });
}

void stand_upright(Scene& s, int body) { s.bodies[static_cast<std::size_t>(body)].pose.rotation = {}; }

}  // namespace

// A convex body at a point of the surface, above or below it, with a gap or a depth there; one in eight
// beyond the border. Some move, some are rays.
void height_fields(Rng& rng, Case& c) {
  constexpr double sizes[] = {1, 0.25, 0.05, 3};
  Scene s = random_pair(rng, ShapeKind::mesh, random_convex_kind(rng), 1, Vec3::Zero());
  s.shapes[0] = random_field(rng, rng.uniform(0.5, 2));
  if (rng.chance(0.5)) stand_upright(s, 0);
  if (rng.chance(0.3)) stand_upright(s, 1);
  const double size = sizes[rng.below(std::size(sizes))];
  s.shapes[1] = random_shape(rng, kind_of(s.shapes[1]), size);
  const Spot at = spot_on(rng, s, 0);
  const double gap = any_gap(rng, extent(s.shapes[1]));
  s.bodies[1].pose.translation = at.point + at.normal * gap - farthest_point(s, 1, -at.normal);
  const auto placing = rng.below(8);
  if (placing == 0) s.bodies[1].pose.translation *= rng.uniform(1, 1.5);
  const auto asked = rng.below(12);
  const bool is_ray = asked == 0 && may_draw(ShapeKind::sphere);
  if (is_ray) {
    const Vec3 way = rng.vector(0.5, 6);
    make_ray(s, at.point, way, rng.uniform(0.05, 1.2));
    c.queries = {{Question::ray, 0, 1}};
  }
  c.scene = std::move(s);
  if (is_ray) return;
  if (asked < 3) return ask_impact_against(rng, c, at.normal, 0.2);
  ask_pair(c);
  if (rng.below(4) == 0) exchange_bodies(c.scene);
}

namespace {

// Convex shapes around a place, of one group.
void add_compound(Rng& rng, Scene& s, int group, const Vec3& place, bool on_lattice) {
  const Quat turn = on_lattice ? Quat{} : rng.rotation();
  const bool is_static = rng.below(6) == 0;
  for (auto parts = 1 + rng.below(5); parts > 0; --parts) {
    Body b;
    b.shape = static_cast<int>(s.shapes.size());
    b.group = group;
    b.is_static = is_static;
    const ShapeKind kind = random_convex_kind(rng);
    s.shapes.push_back(random_shape(rng, kind, rng.uniform(0.2, 0.6)));
    if (on_lattice && may_draw(ShapeKind::box))
      s.shapes.back() = Box{Vec3{to_eighths(rng.uniform(0.2, 1)), to_eighths(rng.uniform(0.2, 1)), 0.25}};
    b.pose.rotation = rng.chance(0.5) || on_lattice ? turn : rng.rotation();
    b.pose.translation = place + rng.vector(0, 0.8);
    if (on_lattice)
      for (double& x : b.pose.translation) x = to_eighths(x);
    s.bodies.push_back(std::move(b));
  }
}

void add_ground(Rng& rng, Scene& s, double side) {
  const auto kind = rng.below(4);
  if (kind == 0) return;
  Body b;
  b.shape = static_cast<int>(s.shapes.size());
  b.is_static = true;
  b.pose.translation.z() = -0.5 * side;
  if (kind == 1 && may_draw(ShapeKind::half_space))
    s.shapes.emplace_back(HalfSpace{Vec3::UnitZ(), 0});
  else if (may_draw(ShapeKind::mesh))
    s.shapes.emplace_back(random_field(rng, side));
  else
    s.shapes.emplace_back(Sphere{0.5 * side});
  s.bodies.push_back(std::move(b));
}

}  // namespace

void compounds(Rng& rng, Case& c) {
  const auto links = 2 + rng.below(4);
  const bool on_lattice = rng.below(4) == 0;
  const double side = 1.1 * std::cbrt(static_cast<double>(links));
  for (std::uint64_t k = 0; k < links; ++k) {
    const Vec3 place = Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * side;
    add_compound(rng, c.scene, static_cast<int>(k), place, on_lattice);
  }
  add_ground(rng, c.scene, side);
  c.queries = {{Question::scene_contacts, -1, -1}};
  if (rng.below(4) == 0) c.queries.push_back({Question::candidates, -1, -1});
}

}  // namespace touchstone::fuzz
