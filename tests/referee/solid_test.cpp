// The convex pieces by which the referee bounds the depth of a solid mesh from below.
#include "oracles/referee/solid/solid.h"
#include "core/math/rng.h"
#include "core/shape/solid_mesh.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"
#include "scenarios/random/random_shape.h"
#include "tests/support/catch.h"
#include "tests/support/l_shape.h"

using namespace touchstone;

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// A point between all of these, with random weights, none of which is nearly 0.
Vec3 between(Rng& rng, const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (const Vec3& p : points) {
    const double w = rng.uniform(0.05, 1);
    sum += w * p;
    weights += w;
  }
  return sum / weights;
}

}  // namespace

TEST_CASE("the kernel of a solid and any of its triangles span a convex part of it", "[referee][solid]") {
  Rng rng(11);
  int with_kernel = 0, points = 0;
  for (int i = 0; i < 60; ++i) {
    const SolidMesh solid = fuzz::random_solid(rng, 1);
    const std::vector<Vec3> kernel = referee::kernel_points(solid);
    if (kernel.size() < 4) continue;
    ++with_kernel;
    for (const auto& t : solid.triangles) {
      std::vector<Vec3> piece = kernel;
      for (const int v : t) piece.push_back(solid.vertices[at(v)]);
      CHECK(winding_number(solid, between(rng, piece)) == 1);
      ++points;
    }
  }
  CHECK(with_kernel >= 30);
  CHECK(points >= 500);
}

TEST_CASE("the kernel of an L is where its arms meet, and a solid with a cavity has none",
          "[referee][solid]") {
  const TriangleMesh l = touchstone::test::l_shape();
  REQUIRE_FALSE(flaw_of_solid(l));
  Aabb box;
  for (const Vec3& p : referee::kernel_points(l)) box.extend(p);
  CHECK(box.lo.minCoeff() >= -1);
  CHECK(box.hi.maxCoeff() <= 1);
  CHECK((box.hi - box.lo).isApprox(Vec3(1, 1, 2), 1e-9));

  TriangleMesh hollow{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  CHECK(referee::kernel_points(hollow).size() > 6);
  const TriangleMesh outer = hollow;
  for (const Vec3& v : outer.vertices) hollow.vertices.push_back(v / 2);
  for (const auto& [a, b, c] : outer.triangles) hollow.triangles.push_back({6 + a, 6 + c, 6 + b});
  REQUIRE_FALSE(flaw_of_solid(hollow));
  CHECK(referee::kernel_points(hollow).empty());
}

TEST_CASE("convex pieces narrow the depth of a solid", "[referee][solid]") {
  int overlaps = 0, open = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Scene s = fuzz::make_case(2, i, "solids").scene;
    if (s.bodies[1].motion || kind_of(s.shape_of(0)) == ShapeKind::mesh ||
        kind_of(s.shape_of(1)) == ShapeKind::mesh)
      continue;
    const referee::PairTruth t =
        referee::judge_pair({&s.shape_of(0), s.bodies[0].pose}, {&s.shape_of(1), s.bodies[1].pose});
    if (t.verdict != referee::Verdict::overlap) continue;
    ++overlaps;
    CHECK(t.gap.lo <= t.gap.hi);
    open += t.gap.hi - t.gap.lo > tolerance::core_tau_factor * 0x1p-53 * scale_of_pair(s, 0, 1);
  }
  INFO(open << " of " << overlaps);
  CHECK(overlaps > 200);
  // 36 % without the pieces.
  CHECK(open * 10 < overlaps * 3);
}
