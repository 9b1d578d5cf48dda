// Vertex-face and edge-edge with straight paths: closed forms, degenerate primitives, symmetry, and every
// recorded query whose answer is known exactly.
#include <filesystem>

#include "oracles/referee/referee.h"
#include "scenarios/import/ccd_queries.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"

namespace touchstone::referee_test {
namespace {

using Quad = std::array<Vec3, 4>;
constexpr auto vf = PrimitivePair::vertex_face, ee = PrimitivePair::edge_edge;

/// Small integers: usually degenerate or coplanar.
Quad lattice_quad(Rng& r) {
  Quad q;
  for (Vec3& v : q)
    for (int k = 0; k < 3; ++k) v[k] = static_cast<double>(r.below(4));
  return q;
}

}  // namespace

TEST_CASE("all recorded queries are decided in agreement with the exact truth",
          "[referee][primitive][data]") {
  const auto root = test::shared_data() / "ccd";
  if (!std::filesystem::exists(root / "truth.csv")) return test::skip(root.string() + " is absent");
  int false_negatives = 0, false_positives = 0, hits = 0, wrong_times = 0, total = 0;
  for (const CcdQuery& q : load_ccd_set(root)) {
    const PrimitiveTruth t = judge_primitive_motion(q.is_vertex_face ? vf : ee, q.start, q.end);
    ++total;
    hits += t.collides;
    false_negatives += q.truth->collides && !t.collides;
    false_positives += !q.truth->collides && t.collides;
    if (!q.truth->collides || !t.collides) continue;
    REQUIRE(std::nextafter(t.t_lo, 2.0) >= t.t_hi);
    wrong_times += t.t_lo > q.truth->toi_hi || t.t_hi < q.truth->toi_lo;
  }
  CAPTURE(total, hits);
  CHECK(false_negatives == 0);
  CHECK(false_positives == 0);
  CHECK(wrong_times == 0);
  REQUIRE(total > 7000);
  REQUIRE(hits > 1000);
}

TEST_CASE("a vertex that crosses a face does so at the time of its plane", "[referee][primitive]") {
  const Quad start{Vec3(0.25, 0.25, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  Quad end = start;
  end[0].z() = -3;
  const PrimitiveTruth t = judge_primitive_motion(vf, start, end);
  REQUIRE(t.collides);
  REQUIRE(t.t_lo == 0.25);
  REQUIRE(t.t_hi == 0.25);
  // A third of the way is not a double, so the bracket is its two neighbours.
  end[0].z() = -2;
  const PrimitiveTruth third = judge_primitive_motion(vf, start, end);
  REQUIRE(third.t_lo == 1.0 / 3);
  REQUIRE(third.t_hi == std::nextafter(1.0 / 3, 1.0));
  // One ulp short of the plane, and exactly at it when the step ends.
  end[0].z() = 0x1p-1074;
  REQUIRE_FALSE(judge_primitive_motion(vf, start, end).collides);
  end[0].z() = 0;
  REQUIRE(judge_primitive_motion(vf, start, end).t_lo == 1);
  // Through a corner, and past it by one ulp.
  end[0] = {0, 0, -1};
  Quad above = start;
  above[0] = {0, 0, 1};
  REQUIRE(judge_primitive_motion(vf, above, end).t_lo == 0.5);
  above[0].x() = end[0].x() = -0x1p-1074;
  REQUIRE_FALSE(judge_primitive_motion(vf, above, end).collides);
}

TEST_CASE("motions within one plane and degenerate primitives are decided", "[referee][primitive]") {
  // A vertex slides in the plane of the face and enters it at x = 0.
  const Quad start{Vec3(-1, 0.25, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  Quad end = start;
  end[0].x() = 3;
  REQUIRE(judge_primitive_motion(vf, start, end).t_hi == 0.25);
  // Two edges on one line, then a face that is a segment, then one that is a point.
  const Quad line{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(3, 3, 3), Vec3(5, 5, 5)};
  Quad closer = line;
  closer[2] = {-1, -1, -1};
  closer[3] = {1, 1, 1};
  REQUIRE(judge_primitive_motion(ee, line, closer).t_lo == 0.5);
  const Quad flat{Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0, 0)};
  Quad down = flat;
  down[0].z() = -1;
  REQUIRE(judge_primitive_motion(vf, flat, down).t_lo == 0.5);
  const Quad spot{Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  Quad through = spot;
  through[0].z() = -3;
  REQUIRE(judge_primitive_motion(vf, spot, through).t_lo == 0.25);
  through[0].x() = 0x1p-60;
  REQUIRE_FALSE(judge_primitive_motion(vf, spot, through).collides);
}

TEST_CASE("the answer does not depend on the order of the points or the direction of time",
          "[referee][primitive]") {
  Rng r(53);
  int hits = 0;
  constexpr int n = 1500;
  for (int i = 0; i < n; ++i) {
    const Quad a = lattice_quad(r), b = lattice_quad(r);
    const auto turned = [](const Quad& q, std::array<std::size_t, 4> p) {
      return Quad{q[p[0]], q[p[1]], q[p[2]], q[p[3]]};
    };
    const PrimitiveTruth f = judge_primitive_motion(vf, a, b), e = judge_primitive_motion(ee, a, b);
    hits += f.collides + e.collides;
    for (const auto& p : {std::array<std::size_t, 4>{0, 2, 3, 1}, {0, 3, 2, 1}}) {
      const PrimitiveTruth g = judge_primitive_motion(vf, turned(a, p), turned(b, p));
      REQUIRE(g.collides == f.collides);
      REQUIRE(g.t_lo == f.t_lo);
    }
    for (const auto& p : {std::array<std::size_t, 4>{1, 0, 2, 3}, {2, 3, 0, 1}}) {
      const PrimitiveTruth g = judge_primitive_motion(ee, turned(a, p), turned(b, p));
      REQUIRE(g.collides == e.collides);
      REQUIRE(g.t_lo == e.t_lo);
    }
    REQUIRE(judge_primitive_motion(vf, b, a).collides == f.collides);
    REQUIRE(judge_primitive_motion(ee, b, a).collides == e.collides);
  }
  REQUIRE(hits > n / 5);
  REQUIRE(hits < 2 * n * 4 / 5);
}

}  // namespace touchstone::referee_test
