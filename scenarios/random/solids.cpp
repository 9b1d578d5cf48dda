// Solid meshes: convex and not, with a hole or a cavity, against convex bodies, half-spaces, surfaces and
// each other.
#include <cmath>
#include <iterator>
#include <numbers>

#include "scenarios/random/families.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

ShapeKind partner(Rng& rng) {
  const auto pick = rng.below(16);
  if (pick < 2) return ShapeKind::half_space;
  if (pick == 2) return ShapeKind::mesh;
  if (pick < 6) return ShapeKind::solid_mesh;
  if (pick < 8 && may_draw(ShapeKind::rounded_box)) return ShapeKind::rounded_box;
  if (pick == 8 && may_draw(ShapeKind::padded_hull)) return padded_kinds[rng.below(std::size(padded_kinds))];
  return random_convex_kind(rng);
}

// Signed, in sizes of the pair.
double some_gap(Rng& rng, double size) {
  switch (rng.below(4)) {
    case 0:
      return rng.uniform(0.001, 0.5) * size;
    case 1:
      return rng.signed_binary_scale(-40, -7) * size;
    case 2:
      return 0;
    default:
      return -rng.uniform(0.001, 0.3) * size;
  }
}

// A vertex of the mesh that is farthest along n (world).
Vec3 farthest_of(const Scene& s, int body, const Vec3& n) {
  const TriangleMesh* m = triangles_if(s.shape_of(body));
  const Mat3 r = rotation_matrix(s.bodies[static_cast<std::size_t>(body)].pose.rotation);
  if (!m) return farthest_point(s, body, n);
  Vec3 best = r * m->vertices.front();
  for (const Vec3& v : m->vertices)
    if ((r * v).dot(n) > best.dot(n)) best = r * v;
  return best;
}

void on_half_space(Rng& rng, Scene& s) {
  const Vec3 n = placement_direction(rng, s);
  place_along(rng, s, n, some_gap(rng, mean_extent(s)), 0.3);
}

// Its foremost point at a point of the surface; or a small one inside, or anywhere near.
Vec3 at_solid(Rng& rng, Scene& s) {
  constexpr double sizes[] = {1, 1, 0.25, 3};
  const ShapeKind kind = kind_of(s.shapes[1]);
  const double size = sizes[rng.below(std::size(sizes))];
  s.shapes[1] = kind == ShapeKind::mesh ? Shape(any_mesh(rng, size)) : random_shape(rng, kind, size);
  const Spot at = spot_on(rng, s, 0);
  const double gap = some_gap(rng, extent(s.shapes[1]));
  s.bodies[1].pose.translation = at.point + at.normal * gap - farthest_of(s, 1, -at.normal);
  const auto placing = rng.below(8);
  if (placing == 0) s.bodies[1].pose.translation = rng.vector(0, 0.9);
  if (placing <= 1) s.shapes[1] = random_shape(rng, kind, rng.uniform(0.02, 0.3));
  if (placing == 1) s.bodies[1].pose.translation = rng.vector(0, 0.3);
  return at.normal;
}

}  // namespace

void solids(Rng& rng, Case& c) {
  const ShapeKind other = partner(rng);
  const bool plane = other == ShapeKind::half_space;
  Scene s = plane ? random_pair(rng, other, ShapeKind::solid_mesh, 1, Vec3::Zero())
                  : random_pair(rng, ShapeKind::solid_mesh, other, 1, Vec3::Zero());
  Vec3 n = Vec3::UnitZ();
  if (plane)
    on_half_space(rng, s);
  else
    n = at_solid(rng, s);
  const bool moves = is_convex(other) && rng.below(6) == 0;
  c.scene = std::move(s);
  if (moves) return ask_impact_against(rng, c, n, -0.5);
  ask_pair(c);
  if (rng.below(8) == 0) c.queries = {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}};
  if (rng.below(4) == 0) exchange_bodies(c.scene);
}

}  // namespace touchstone::fuzz
