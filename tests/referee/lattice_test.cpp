// Small polytopes on a lattice, judged a second time by the separating-axis theorem over every candidate
// direction in 64-bit integers: slow, obvious, exact. Exact touching is common on a lattice.
#include <array>
#include <cstdint>

#include "oracles/referee/checker.h"
#include "oracles/referee/counters.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

struct I3 {
  std::int64_t x = 0, y = 0, z = 0;
};
I3 operator-(const I3& a, const I3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
std::int64_t dot(const I3& a, const I3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
I3 cross(const I3& a, const I3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
bool is_zero(const I3& a) { return a.x == 0 && a.y == 0 && a.z == 0; }
bool parallel(const I3& a, const I3& b) { return is_zero(cross(a, b)); }

struct Placed3 {
  Shape shape;
  Pose pose;
  std::vector<I3> world;  // times `scale`
  int scale = 1;
};

// Rotations by small integer quaternions: rational, and their denominators |q|² multiply out.
constexpr std::array<std::array<int, 4>, 6> quaternions{
    {{0, 0, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {0, 0, 1, 2}, {1, 0, 0, 3}, {1, 2, 0, 2}}};

Placed3 random_polytope(Rng& r) {
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

void add_direction(std::vector<I3>& list, const I3& d) {
  if (is_zero(d)) return;
  for (const I3& e : list)
    if (parallel(e, d)) return;
  list.push_back(d);
}

// All normals that can matter: crosses of edge directions; for a flat difference also those within its plane;
// for a segment or a point the part of a point at a right angle to it.
std::vector<I3> candidates(const std::vector<I3>& a, const std::vector<I3>& b) {
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

Slow judge_slowly(std::vector<I3> a, std::vector<I3> b, int scale_a, int scale_b) {
  for (I3& v : a) v = {v.x * scale_b, v.y * scale_b, v.z * scale_b};
  for (I3& v : b) v = {v.x * scale_a, v.y * scale_a, v.z * scale_a};
  Slow r;
  r.depth = std::numeric_limits<long double>::infinity();
  const std::vector<I3> normals = candidates(a, b);
  if (normals.empty() || normals.size() == 1) r.depth = 0;
  for (const I3& n : normals) {
    std::int64_t lo_a = INT64_MAX, hi_a = INT64_MIN, lo_b = INT64_MAX, hi_b = INT64_MIN;
    for (const I3& v : a) lo_a = std::min(lo_a, dot(n, v)), hi_a = std::max(hi_a, dot(n, v));
    for (const I3& v : b) lo_b = std::min(lo_b, dot(n, v)), hi_b = std::max(hi_b, dot(n, v));
    if (hi_a < lo_b || hi_b < lo_a) r.disjoint = true;
    const std::int64_t w = std::min(hi_a - lo_b, hi_b - lo_a);
    r.depth = std::min(r.depth, static_cast<long double>(w) / std::sqrt(static_cast<long double>(dot(n, n))));
  }
  r.depth /= static_cast<long double>(scale_a) * scale_b;
  return r;
}

}  // namespace

TEST_CASE("lattice polytopes: verdict, depth and certificate agree with the exhaustive separating-axis test",
          "[referee][exact]") {
  Rng r(20240601);
  int overlaps = 0, touching = 0, certified = 0;
  constexpr int cases = 20000;
  counters() = {};
  for (int i = 0; i < cases; ++i) {
    const Placed3 x = random_polytope(r), y = random_polytope(r);
    const Slow slow = judge_slowly(x.world, y.world, x.scale, y.scale);
    const Placed a{&x.shape, x.pose}, b{&y.shape, y.pose};
    const PairTruth t = judge_pair(a, b);
    INFO("case " << i << " depth " << static_cast<double>(slow.depth));
    REQUIRE(t.verdict == (slow.disjoint ? Verdict::disjoint : Verdict::overlap));
    REQUIRE(t.gap.lo <= t.gap.hi);
    REQUIRE(t.gap.hi - t.gap.lo <= 1e-15 * 16);
    if (!slow.disjoint) {
      ++overlaps;
      touching += slow.depth == 0;
      REQUIRE(static_cast<long double>(t.gap.lo) <= -slow.depth * (1 - 1e-18L));
      REQUIRE(static_cast<long double>(t.gap.hi) >= -slow.depth * (1 + 1e-18L));
    } else {
      REQUIRE(t.gap.hi > 0);
    }
    const Certificate c = checkable_certificate(t, a, b);
    REQUIRE(check(c, a, b));
    ++certified;
  }
  WARN(cases << " cases, " << overlaps << " overlap, " << touching << " of them touch exactly, " << certified
             << " certificates checked, " << counters().exact << " settled in exact arithmetic");
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
  REQUIRE(touching > 200);
}

TEST_CASE("the checker refuses certificates that prove nothing", "[referee][certificate]") {
  Rng r(5);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const Placed3 x = random_polytope(r), y = random_polytope(r);
    const Placed a{&x.shape, x.pose}, b{&y.shape, y.pose};
    const PairTruth t = judge_pair(a, b);
    Certificate c = checkable_certificate(t, a, b);
    // The right evidence for the wrong verdict, and evidence moved away.
    if (c.kind == Certificate::Kind::separating_plane) {
      for (std::size_t k = 0; k < c.rationals.size() && k < 3; ++k)
        c.rationals[k] = c.rationals[k].front() == '-' ? c.rationals[k].substr(1) : "-" + c.rationals[k];
      c.direction = -c.direction;
      c.offset = -c.offset;
      if (c.rationals.size() == 4)
        c.rationals[3] = c.rationals[3].front() == '-' ? c.rationals[3].substr(1) : "-" + c.rationals[3];
    } else {
      c.rationals.clear();
      c.point += Vec3(100, 0, 0);
    }
    REQUIRE_FALSE(check(c, a, b));
    ++refused;
  }
  REQUIRE(refused == 2000);
}
