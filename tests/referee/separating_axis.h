// A second opinion on the referee for small integer polytopes: the separating-axis theorem over every
// candidate direction in 64-bit integers. Slow, obvious, exact. Coordinates times both scales must be at most
// 1e4.
#pragma once

#include <array>
#include <cstdint>

#include "tests/referee/support.h"

namespace touchstone::referee_test {

struct I3 {
  std::int64_t x = 0, y = 0, z = 0;
};
inline I3 operator-(const I3& a, const I3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline std::int64_t dot(const I3& a, const I3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline I3 cross(const I3& a, const I3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline bool is_zero(const I3& a) { return a.x == 0 && a.y == 0 && a.z == 0; }
inline bool parallel(const I3& a, const I3& b) { return is_zero(cross(a, b)); }

struct Placed3 {
  Shape shape;
  Pose pose;
  std::vector<I3> world;  // times `scale`
  int scale = 1;
};

// Rotations by small integer quaternions: rational, and their denominators |q|² multiply out.
inline constexpr std::array<std::array<int, 4>, 6> quaternions{
    {{0, 0, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {0, 0, 1, 2}, {1, 0, 0, 3}, {1, 2, 0, 2}}};

inline Placed3 random_polytope(Rng& r) {
  Placed3 p;
  std::vector<I3> local;
  if (r.chance(0.5)) {
    const auto h = [&] { return static_cast<int>(r.below(4)); };
    const int x = h(), y = h(), z = h();
    p.shape = Box{Vec3(x, y, z)};
    for (int i = 0; i < 8; ++i) local.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
  } else {
    Hull hull;
    const int n = 1 + static_cast<int>(r.below(6));
    for (int i = 0; i < n; ++i) {
      const auto c = [&] { return static_cast<int>(r.below(7)) - 3; };
      local.push_back({c(), c(), c()});
      hull.vertices.emplace_back(local.back().x, local.back().y, local.back().z);
    }
    p.shape = hull;
  }
  const auto& q = quaternions[r.below(quaternions.size())];
  p.pose.rotation = {double(q[0]), double(q[1]), double(q[2]), double(q[3])};
  const std::int64_t x = q[0], y = q[1], z = q[2], w = q[3];
  const I3 row[3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                     {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                     {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  p.scale = static_cast<int>(x * x + y * y + z * z + w * w);
  const auto t = [&] { return static_cast<std::int64_t>(r.below(5)) - 2; };
  const I3 at{t(), t(), t()};
  p.pose.translation = Vec3(double(at.x), double(at.y), double(at.z));
  for (const I3& v : local)
    p.world.push_back(
        {dot(row[0], v) + p.scale * at.x, dot(row[1], v) + p.scale * at.y, dot(row[2], v) + p.scale * at.z});
  return p;
}

struct Slow {
  bool disjoint = false;
  long double depth = 0;  // when not disjoint, in units of the common scale
};

inline long double length(const I3& n) {
  const auto x = static_cast<long double>(n.x), y = static_cast<long double>(n.y),
             z = static_cast<long double>(n.z);
  return std::sqrt(x * x + y * y + z * z);
}

inline void add_direction(std::vector<I3>& list, const I3& d) {
  if (is_zero(d)) return;
  for (const I3& e : list)
    if (parallel(e, d)) return;
  list.push_back(d);
}

// All candidate normals: cross products of edge directions; for a flat difference also those within its
// plane; for a segment or a point, the component of a point perpendicular to it.
inline std::vector<I3> candidates(const std::vector<I3>& a, const std::vector<I3>& b) {
  std::vector<I3> edges, normals;
  for (const auto* s : {&a, &b})
    for (std::size_t i = 0; i < s->size(); ++i)
      for (std::size_t j = 0; j < i; ++j) add_direction(edges, (*s)[i] - (*s)[j]);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) add_direction(normals, cross(edges[i], edges[j]));
  const I3 w = a[0] - b[0];
  if (normals.size() == 1)
    for (const I3& e : edges) add_direction(normals, cross(e, normals[0]));
  if (edges.size() == 1) {
    const I3 c = cross(edges[0], w);
    add_direction(normals, cross(c, edges[0]));
    add_direction(normals, c);
    add_direction(normals, edges[0]);
  }
  if (edges.empty()) add_direction(normals, w);
  return normals;
}

inline Slow judge_slowly(std::vector<I3> a, std::vector<I3> b, int scale_a, int scale_b) {
  for (I3& v : a) v = {v.x * scale_b, v.y * scale_b, v.z * scale_b};
  for (I3& v : b) v = {v.x * scale_a, v.y * scale_a, v.z * scale_a};
  Slow r;
  r.depth = std::numeric_limits<long double>::infinity();
  const std::vector<I3> normals = candidates(a, b);
  if (normals.empty() || normals.size() == 1) r.depth = 0;
  for (const I3& n : normals) {
    std::int64_t lo_a = INT64_MAX, hi_a = INT64_MIN, lo_b = INT64_MAX, hi_b = INT64_MIN;
    for (const I3& v : a) {
      lo_a = std::min(lo_a, dot(n, v));
      hi_a = std::max(hi_a, dot(n, v));
    }
    for (const I3& v : b) {
      lo_b = std::min(lo_b, dot(n, v));
      hi_b = std::max(hi_b, dot(n, v));
    }
    if (hi_a < lo_b || hi_b < lo_a) r.disjoint = true;
    const std::int64_t w = std::min(hi_a - lo_b, hi_b - lo_a);
    r.depth = std::min(r.depth, static_cast<long double>(w) / length(n));
  }
  r.depth /= static_cast<long double>(scale_a) * scale_b;
  return r;
}

}  // namespace touchstone::referee_test
