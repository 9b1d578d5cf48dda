// Two meshes.
#include <limits>

#include "scenarios/random/families.h"
#include "scenarios/random/place.h"

namespace touchstone::fuzz {
namespace {

void move_by(Scene& s, const Vec3& t) { s.bodies[1].pose.translation += t; }

// The vertex of body 1 that is farthest along −n (world).
Vec3 foremost_vertex(const Scene& s, const Vec3& n) {
  const Body& b = s.bodies[1];
  const Mat3 r = rotation_matrix(b.pose.rotation);
  Vec3 best = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& v : std::get<TriangleMesh>(s.shape_of(1)).vertices) {
    const Vec3 p = r * v + b.pose.translation;
    if (p.dot(n) >= least) continue;
    least = p.dot(n);
    best = p;
  }
  return best;
}

// The same surface twice, in the same place or shifted along an axis: coplanar and shared triangles.
void repeat(Rng& rng, Scene& s) {
  s.shapes[1] = s.shapes[0];
  s.bodies[1].pose = s.bodies[0].pose;
  if (rng.chance(0.5)) s.bodies[0].pose.rotation = s.bodies[1].pose.rotation = Quat{};
  Vec3 shift = Vec3::Zero();
  const auto axis = static_cast<int>(rng.below(3));
  shift[axis] = static_cast<double>(rng.below(5)) / 4 - 0.5;
  move_by(s, shift);
}

}  // namespace

// A vertex of one at a point of the other, with a gap or a depth there; points of both in the same place;
// the second small and about the middle of the first; or the same surface twice.
void two_meshes(Rng& rng, Case& c) {
  constexpr double sizes[] = {1, 1, 0.25, 3};
  Scene s = random_pair(rng, ShapeKind::mesh, ShapeKind::mesh, 1, Vec3::Zero());
  s.shapes[0] = any_mesh(rng, rng.uniform(0.5, 1.5));
  const double size = rng.uniform(0.5, 1.5);
  s.shapes[1] = any_mesh(rng, size * sizes[rng.below(std::size(sizes))]);
  const Spot at = spot_on(rng, s, 0);
  const Vec3 target = at.point + at.normal * any_gap(rng, extent(s.shapes[1]));
  const auto placing = rng.below(8);
  if (placing < 4)
    move_by(s, target - foremost_vertex(s, at.normal));
  else if (placing < 6)
    move_by(s, target - spot_on(rng, s, 1).point);
  else if (placing == 6)
    s.bodies[1].pose.translation = rng.vector(0, 0.1);
  else
    repeat(rng, s);
  c.scene = std::move(s);
  ask_pair(c);
}

}  // namespace touchstone::fuzz
