#include "scenarios/random/families.h"

#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

Vec3 in_box(Rng& rng, double half) {
  return {rng.uniform(-half, half), rng.uniform(-half, half), rng.uniform(-half, half)};
}

TriangleMesh soup(Rng& rng, std::size_t triangles, double scale) {
  TriangleMesh m;
  for (int i = 0; i < static_cast<int>(triangles); ++i) {
    for (int k = 0; k < 3; ++k) m.vertices.push_back(in_box(rng, scale));
    m.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return m;
}

// Two triangles with a common edge: a square, possibly folded along its diagonal.
TriangleMesh folded(Rng& rng, double scale) {
  const double lift = rng.chance(0.3) ? 0 : rng.uniform(-1, 1) * scale;
  return {{{-scale, -scale, 0}, {scale, -scale, 0}, {scale, scale, 0}, {-scale, scale, lift}},
          {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh field(Rng& rng, double scale, double height) {
  const int columns = 2 + static_cast<int>(rng.below(15)), lines = 2 + static_cast<int>(rng.below(15));
  TriangleMesh m;
  const double dx = 2 * scale / (columns - 1), dy = 2 * scale / (lines - 1);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < lines; ++j) {
      const double z = height == 0 ? 0 : rng.uniform(-height, height) * std::min(dx, dy);
      m.vertices.push_back({i * dx - scale, j * dy - scale, z});
    }
  for (int i = 0; i + 1 < columns; ++i)
    for (int j = 0; j + 1 < lines; ++j) {
      const int a = i * lines + j, b = a + lines;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

// An octahedron with 8, 32 or 128 triangles, flat or rounded, stretched along its axes.
TriangleMesh closed(Rng& rng, double scale) {
  TriangleMesh m = octahedron();
  const auto divisions = rng.below(3);
  const bool round = rng.chance(0.7);
  for (std::uint64_t i = 0; i < divisions; ++i) m = divided(m, round);
  const Vec3 axes{rng.uniform(0.4, 1.2), rng.uniform(0.4, 1.2), rng.uniform(0.4, 1.2)};
  for (Vec3& v : m.vertices) v = v.cwiseProduct(axes) * scale;
  return m;
}

Shape hull_of_many(Rng& rng) {
  const auto n = rng.chance(0.4) ? 256 + rng.below(45) : 64 + rng.below(192);
  const Vec3 axes{rng.uniform(0.3, 1.2), rng.uniform(0.3, 1.2), rng.uniform(0.3, 1.2)};
  std::vector<Vec3> v;
  for (std::uint64_t i = 0; i < n; ++i) v.push_back(rng.unit_vector().cwiseProduct(axes));
  return make_hull(std::move(v));
}

}  // namespace

void ask_impact_against(Rng& rng, Case& c, const Vec3& n, double least) {
  const double approach = rng.uniform(least, 3);
  Motion m{rng.vector(0, 1) - n * approach, Vec3::Zero()};
  if (rng.chance(0.4)) m.angular = rng.vector(0.1, 2);
  c.scene.bodies[1].motion = m;
  c.queries = {{Question::time_of_impact, 0, 1}};
}

Spot spot_on(Rng& rng, const Scene& s, int body) {
  const TriangleMesh& m = *triangles_if(s.shape_of(body));
  const auto& t = m.triangles[rng.below(m.triangles.size())];
  const auto corner = [&](std::size_t k) { return m.vertices[static_cast<std::size_t>(t[k])]; };
  double u = rng.uniform(), v = rng.uniform();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const auto place = rng.below(8);
  if (place < 2) v = 0;
  if (place == 0) u = 0;
  const Vec3 along = corner(1) - corner(0), across = corner(2) - corner(0);
  const Vec3 n = along.cross(across);
  const Pose& pose = s.bodies[static_cast<std::size_t>(body)].pose;
  const Mat3 r = rotation_matrix(pose.rotation);
  const double side = rng.sign();
  const Vec3 normal = n.norm() > 0 ? Vec3(n.normalized() * side) : rng.unit_vector();
  return {r * (corner(0) + u * along + v * across) + pose.translation, r * normal};
}

Shape any_mesh(Rng& rng, double scale) {
  const auto style = rng.below(16);
  if (style < 3) return soup(rng, 1, scale);
  if (style < 6) return folded(rng, scale);
  if (style < 10) return closed(rng, scale);
  if (style < 12) return field(rng, scale, 0);
  if (style < 15) return field(rng, scale, 0.5);
  return soup(rng, 2 + rng.below(40), scale);
}

// The convex body is placed at a point of the surface, on either side, with a gap or a depth there; or in the
// middle.
void meshes(Rng& rng, Case& c) {
  constexpr double sizes[] = {1, 1, 0.25, 3};
  Scene s = random_pair(rng, ShapeKind::mesh, random_convex_kind(rng), 1, Vec3::Zero());
  s.shapes[0] = any_mesh(rng, rng.uniform(0.5, 1.5));
  s.shapes[1] = random_shape(rng, kind_of(s.shapes[1]), sizes[rng.below(std::size(sizes))]);
  const Spot at = spot_on(rng, s, 0);
  const double gap = any_gap(rng, extent(s.shapes[1]));
  s.bodies[1].pose.translation = at.point + at.normal * gap - farthest_point(s, 1, -at.normal);
  // Inside a closed mesh, possibly without reaching its surface.
  if (rng.below(6) == 0) s.bodies[1].pose.translation = rng.vector(0, 0.1);
  const bool moves = rng.below(6) == 0;
  c.scene = std::move(s);
  if (moves) return ask_impact_against(rng, c, at.normal, 0.2);
  ask_pair(c);
  if (rng.below(4) == 0) exchange_bodies(c.scene);
}

void many_vertices(Rng& rng, Case& c) {
  Scene s = random_pair(rng, ShapeKind::hull, random_convex_kind(rng), 1, Vec3::Zero());
  s.shapes[0] = hull_of_many(rng);
  if (rng.below(4) == 0) s.shapes[1] = hull_of_many(rng);
  const Vec3 n = rng.unit_vector();
  place_along(rng, s, n, any_gap(rng, mean_extent(s)), 0.3);
  const bool moves = rng.below(8) == 0;
  c.scene = std::move(s);
  if (moves) return ask_impact_against(rng, c, n, 0.2);
  ask_pair(c);
  if (rng.chance(0.5)) exchange_bodies(c.scene);
}

}  // namespace touchstone::fuzz
