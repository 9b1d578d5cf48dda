#include <nlohmann/json.hpp>

#include "oracles/checker/checker.h"
#include "scenarios/codec/value_codec.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

// A square sheet of 2·n² triangles over [-1,1]², z = 0.
Shape sheet(int n) {
  TriangleMesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) m.vertices.emplace_back(2.0 * i / n - 1, 2.0 * j / n - 1, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

}  // namespace

TEST_CASE("a mesh is a surface: verdict and distance are those of the same flat hull", "[referee][mesh]") {
  Rng r(3);
  const Shape mesh = sheet(8);
  const Shape square = Box{{1, 1, 0}};
  int overlaps = 0, cases = 0;
  for (int i = 0; i < 700; ++i) {
    const Shape body = random_convex(r, tested_kinds[r.below(7)]);
    const Pose mp{Vec3::Zero(), r.rotation()}, bp{r.uniform(0, 1.5) * r.unit_vector(), r.rotation()};
    const PairTruth t = judge_pair({&mesh, mp}, {&body, bp}), u = judge_pair({&square, mp}, {&body, bp});
    if (t.verdict != Verdict::undecided && u.verdict != Verdict::undecided) REQUIRE(t.verdict == u.verdict);
    if (u.verdict == Verdict::disjoint) {
      REQUIRE(t.gap.lo <= u.gap.hi + 1e-15);
      REQUIRE(u.gap.lo <= t.gap.hi + 1e-15);
    } else if (t.verdict == Verdict::overlap) {
      REQUIRE(t.gap.lo == -std::numeric_limits<double>::infinity());
      REQUIRE(t.gap.hi == 0);
    }
    overlaps += u.verdict == Verdict::overlap;
    ++cases;
  }
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
}

TEST_CASE("the nearest triangle is found in scenes of any size", "[referee][mesh]") {
  for (const int exponent : {-560, -300, 0, 300, 600, 1000}) {
    const double unit = std::ldexp(1.0, exponent);
    TriangleMesh m = std::get<TriangleMesh>(sheet(8));
    for (Vec3& v : m.vertices) v *= unit;
    const Shape mesh = m, ball = Sphere{unit / 4};
    const PairTruth t = judge_pair({&mesh, Pose{}}, {&ball, Pose{Vec3(0.6, 0.7, 0.75) * unit, Quat{}}});
    CAPTURE(exponent);
    CHECK(t.verdict == Verdict::disjoint);
    CHECK(t.gap.lo <= 0.5 * unit);
    CHECK(t.gap.hi >= 0.5 * unit);
    CHECK(t.gap.hi - t.gap.lo <= 1e-12 * unit);
  }
}

TEST_CASE("a body inside a closed mesh is disjoint from it, one that touches is not", "[referee][mesh]") {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i) m.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  m.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7}, {0, 5, 1}, {0, 4, 5},
                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  const Shape mesh = m, ball = Sphere{0.5}, half = HalfSpace{{0, 0, 1}, -1};
  const PairTruth inside = judge_pair({&mesh, Pose{}}, {&ball, Pose{}});
  REQUIRE(inside.verdict == Verdict::disjoint);
  REQUIRE(inside.gap.lo <= 0.5);
  REQUIRE(inside.gap.hi >= 0.5);
  REQUIRE(judge_pair({&mesh, Pose{}}, {&ball, Pose{{0.5, 0, 0}, {}}}).verdict == Verdict::overlap);
  REQUIRE(judge_pair({&mesh, Pose{}}, {&half, Pose{}}).verdict == Verdict::overlap);
  REQUIRE(judge_pair({&half, Pose{{0, 0, -0x1p-50}, {}}}, {&mesh, Pose{}}).verdict == Verdict::disjoint);
  REQUIRE(judge_pair({&mesh, Pose{}}, {&mesh, Pose{{3, 0, 0}, {}}}).verdict == Verdict::disjoint);
  REQUIRE(judge_pair({&mesh, Pose{}}, {&mesh, Pose{{2, 0, 0}, {}}}).verdict == Verdict::overlap);
}

TEST_CASE("certificates print as JSON", "[referee][certificate]") {
  const Shape a = Box{{1, 1, 1}}, b = Sphere{1};
  const Placed x{&a, Pose{}}, near{&b, Pose{{1.5, 0, 0}, {}}}, far{&b, Pose{{5, 0, 0}, {}}};
  const auto plane = to_json(judge_pair(x, far).verdict_certificate);
  REQUIRE(plane["kind"] == "separating_plane");
  REQUIRE(plane["direction"].size() == 3);
  const auto point = to_json(judge_pair(x, near).verdict_certificate);
  REQUIRE(point["kind"] == "common_point");
  const Placed overlapping{&a, Pose{{0.5, 0.2, 0.1}, {}}};
  const auto inner = to_json(depth_certificate(judge_pair(x, overlapping), x, overlapping));
  REQUIRE(inner["kind"] == "inner_polytope");
  REQUIRE(inner["facets"].size() >= 4);
}
