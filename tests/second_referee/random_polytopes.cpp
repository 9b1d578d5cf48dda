#include "tests/second_referee/random_polytopes.h"

#include <array>

namespace touchstone::second_referee {
namespace {

double small_integer(Rng& r, int most) {
  return static_cast<double>(r.below(2 * static_cast<std::uint64_t>(most) + 1)) - most;
}
Vec3 lattice_point(Rng& r, int most) {
  const double x = small_integer(r, most), y = small_integer(r, most);
  return {x, y, small_integer(r, most)};
}

Quat integer_quaternion(Rng& r) {
  if (r.chance(0.3)) return {0, 0, 0, 1};
  Quat q;
  do {
    q = {small_integer(r, 3), small_integer(r, 3), small_integer(r, 3), small_integer(r, 3)};
  } while (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0);
  return q;
}

double squared_length(const Quat& q) { return q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w; }

// The rotation matrix times the squared length of the quaternion: integers.
Mat3 integer_rotation(const Quat& q) {
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  Mat3 m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m;
}

std::vector<Vec3> random_vertices(Rng& r) {
  std::vector<Vec3> all;
  const int size = r.chance(0.5) ? 4 : 40;
  if (r.chance(0.3)) {  // a box
    const Vec3 h = lattice_point(r, size).cwiseAbs() + Vec3::Ones();
    for (int k = 0; k < 8; ++k)
      all.emplace_back(k & 1 ? h.x() : -h.x(), k & 2 ? h.y() : -h.y(), k & 4 ? h.z() : -h.z());
    return all;
  }
  const std::uint64_t count = 1 + r.below(12);
  for (std::uint64_t i = 0; i < count; ++i) all.push_back(lattice_point(r, size));
  return all;
}

Polytope world(const std::vector<Vec3>& vertices, const Pose& pose, double others_length) {
  const Mat3 rotation = integer_rotation(pose.rotation);
  const double length = squared_length(pose.rotation);
  Polytope out;
  for (const Vec3& v : vertices)
    out.vertices.push_back((rotation * v + length * pose.translation) * others_length);
  return out;
}

}  // namespace

PolytopePair random_pair(Rng& r) {
  PolytopePair p;
  const std::vector<Vec3> a = random_vertices(r), b = random_vertices(r);
  p.pose_a.rotation = integer_quaternion(r);
  p.pose_b.rotation = integer_quaternion(r);
  p.pose_b.translation = lattice_point(r, r.chance(0.5) ? 6 : 60);
  p.hull_a = make_hull(a);
  p.hull_b = make_hull(b);
  const double la = squared_length(p.pose_a.rotation), lb = squared_length(p.pose_b.rotation);
  p.a = world(a, p.pose_a, lb);
  p.b = world(b, p.pose_b, la);
  p.scale = la * lb;
  return p;
}

TriangleMesh random_mesh(Rng& r) {
  const bool lattice = r.chance(0.5);
  const auto vertex = [&]() -> Vec3 {
    return lattice ? lattice_point(r, 3) : Vec3(r.unit_vector() * r.uniform(0.5, 3));
  };
  TriangleMesh m;
  const std::uint64_t count = 1 + r.below(8);
  while (m.triangles.size() < count) {
    const std::array<Vec3, 3> t{vertex(), vertex(), vertex()};
    const Vec3 first = t[1] - t[0], second = t[2] - t[0];
    if (first.cross(second).isZero(0)) continue;
    const int at = static_cast<int>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), t.begin(), t.end());
    m.triangles.push_back({at, at + 1, at + 2});
  }
  return m;
}

}  // namespace touchstone::second_referee
