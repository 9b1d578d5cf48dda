// with_witness: points of both bodies that differ by the depth along the normal are, by the definition of the
// depth, support points. So it is enough that they do differ so and lie in the bodies.
#include <algorithm>

#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {

TEST_CASE("witness points of overlapping bodies realise the depth along the normal", "[referee]") {
  const std::vector<Shape> shapes = {Sphere{1},
                                     Box{{1, 0.5, 0.75}},
                                     Capsule{1, 1},
                                     Cylinder{1, 1},
                                     Cone{1, 1},
                                     Ellipsoid{{1, 1, 2}},
                                     RoundedBox{{1, 1, 1}, 0.1},
                                     Box{{1, 1, 1}}};
  const Quat quarter{std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  Rng r(3);
  const Quat odd = r.rotation();
  const std::vector<Pose> poses = {{{0, 0, 0}, {}},        {{0.3, 0, 0}, {}},    {{0, 0, 0.2}, {}},
                                   {{0.1, 0.2, 0}, {}},    {{0, 0, 0}, quarter}, {{0.3, 0, 0}, quarter},
                                   {{0.3, 0.1, 0.2}, odd}, {{1e-9, 0, 0}, {}}};
  std::size_t judged = 0, moved = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (std::size_t j = 0; j < shapes.size(); ++j)
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const Placed a{&shapes[i], Pose{}}, b{&shapes[j], poses[k]};
        const PairTruth plain = judge_pair(a, b);
        if (plain.verdict != Verdict::overlap) continue;
        const PairTruth t = with_witness(plain, a, b);
        ++judged;
        moved += t.witness != plain.witness;
        INFO(i << " " << j << " " << k << ", depth " << -t.gap.hi << ", normal " << t.normal.transpose()
               << ", points " << t.witness[0].transpose() << " and " << t.witness[1].transpose());
        CHECK((t.witness[0] - t.witness[1] + 0.5 * (t.gap.lo + t.gap.hi) * t.normal).norm() <= 1e-6);
        CHECK(distance_to(a, t.witness[0]).hi <= 1e-9);
        CHECK(distance_to(b, t.witness[1]).hi <= 1e-9);
      }
  CHECK(judged > 400);
  CHECK(moved > 20);
}

TEST_CASE("witness points of random overlapping bodies realise the depth along the normal", "[referee]") {
  Rng r(31);
  std::size_t judged = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto kind = [&] { return tested_kinds[r.below(std::size(tested_kinds))]; };
    const Shape x = random_convex(r, kind()), y = random_convex(r, kind());
    const Placed a{&x, Pose{0.3 * r.unit_vector(), r.rotation()}},
        b{&y, Pose{0.3 * r.unit_vector(), r.rotation()}};
    const PairTruth plain = judge_pair(a, b);
    if (plain.verdict != Verdict::overlap) continue;
    ++judged;
    const PairTruth t = with_witness(plain, a, b);
    INFO(i << ", depth " << -t.gap.hi);
    CHECK((t.witness[0] - t.witness[1] + 0.5 * (t.gap.lo + t.gap.hi) * t.normal).norm() <= 1e-6);
    CHECK(distance_to(a, t.witness[0]).hi <= 1e-9);
    CHECK(distance_to(b, t.witness[1]).hi <= 1e-9);
  }
  CHECK(judged > 100);
}

TEST_CASE("a cylinder beside its copy: the points are on both sides, not between", "[referee]") {
  const Shape c = Cylinder{1, 1};
  const Placed a{&c, Pose{}}, b{&c, Pose{{0.3, 0, 0}, {}}};
  const PairTruth t = with_witness(judge_pair(a, b), a, b);
  CHECK((t.witness[0] - t.witness[1] - Vec3(1.7, 0, 0)).norm() <= 1e-9);
  CHECK(std::abs(t.witness[0].x() - 1) <= 1e-9);
}

}  // namespace touchstone::referee_test
