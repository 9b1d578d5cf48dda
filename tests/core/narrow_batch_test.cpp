// One pair of shapes in many pairs of poses: the answers of overlap(), bit for bit, on every instruction set
// that this machine supports.
#include <hwy/targets.h>

#include <stdexcept>

#include "core/math/rng.h"
#include "core/narrow/filtered/box_lanes.h"
#include "core/narrow/narrow_phase.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

struct Batch {
  std::vector<Pose> a, b;
  void add(const Pose& x, const Pose& y) {
    a.push_back(x);
    b.push_back(y);
  }
  // A at the origin.
  void add_b(const Vec3& at, const Quat& turn = {}) {
    a.emplace_back();
    b.emplace_back();
    b.back().translation = at;
    b.back().rotation = turn;
  }
};

// Poses in which boxes of about unit size are apart, overlap, and just touch.
Batch random_batch(Rng& r, int count) {
  Batch p;
  for (int i = 0; i < count; ++i)
    p.add({r.vector(-1, 1), r.rotation()},
          {r.vector(-1, 1) + r.unit_vector() * r.uniform(0, 3), r.rotation()});
  return p;
}

struct Count {
  long apart = 0, meeting = 0;
};

// Compares with overlap(), and counts the verdicts.
Count check_same(const Shape& shape_a, const Shape& shape_b, const Batch& p) {
  const Collider a(shape_a), b(shape_b);
  std::vector<OverlapAnswer> out(p.a.size());
  overlaps(a, p.a, b, p.b, out);
  Count n;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const OverlapAnswer one = overlap(a.at(p.a[i]), b.at(p.b[i]));
    REQUIRE(out[i].outcome == one.outcome);
    REQUIRE(out[i].overlap == one.overlap);
    REQUIRE(out[i].error_bound == one.error_bound);
    (one.overlap ? n.meeting : n.apart) += 1;
  }
  return n;
}

void use_only(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// The lanes' own verdicts of `p`, by pose.
narrow::filtered::BoxVerdicts lanes(const Box& a, const Box& b, const Batch& p) {
  using namespace narrow::filtered;
  PoseLanes in_a, in_b;
  in_a.fill(p.a);
  in_b.fill(p.b);
  BoxVerdicts out;
  boxes_meet(LaneBoxes(a, b), in_a, in_b, p.a.size(), out);
  return out;
}

}  // namespace

TEST_CASE("batch: boxes in many poses have the answers of overlap() on every instruction set",
          "[narrow][batch]") {
  std::vector<std::int64_t> targets;
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) targets.push_back(all & -all);
  for (const std::int64_t target : targets) {
    use_only(target);
    INFO(hwy::TargetName(target));
    Rng r(31);
    Count n;
    for (int round = 0; round < 40; ++round) {
      const Box a{r.vector(0.5, 1.5).cwiseAbs()}, b{r.vector(0.5, 1.5).cwiseAbs()};
      const Count c = check_same(a, b, random_batch(r, 1 + round * 3));
      n.apart += c.apart;
      n.meeting += c.meeting;
    }
    CHECK(n.apart > 400);
    CHECK(n.meeting > 400);
  }
  use_only(0);
}

TEST_CASE("batch: a lane gives the verdict itself where it is certain", "[narrow][batch]") {
  Batch p;
  p.add_b({3, 0, 0}, {0.1, 0.2, 0.3, 1});    // apart along a face
  p.add_b({0.5, 0.25, 0}, {0, 0, 0.3, 1});   // meeting
  p.add_b({2, 0, 0}, {});                    // touching: exact arithmetic decides
  p.add_b({0.5, 0, 0}, {0, 0, 0, 0x1p-30});  // a quaternion that is normalised first
  // Apart along a cross product of edges only.
  const double half = 0.41421356237309503;  // tangent of half of 45 degrees
  p.add_b({2.9, 0, 0}, {0, half, 0, 1});
  p.a.back().rotation = {0, 0, half, 1};
  const Box cube{{1, 1, 1}};
  const auto v = lanes(cube, cube, p);
  const double apart[] = {1, 0, 0, 0, 1}, meeting[] = {0, 1, 0, 0, 0};
  for (std::size_t i = 0; i < p.a.size(); ++i) {
    INFO(i);
    CHECK((v.apart[i] != 0) == (apart[i] != 0));
    CHECK((v.meeting[i] != 0) == (meeting[i] != 0));
    CHECK(v.bound[i] > 0);
    CHECK(v.bound[i] < 1e-13);
  }
  const Count n = check_same(cube, cube, p);
  CHECK(n.apart == 2);
  CHECK(n.meeting == 3);
}

TEST_CASE("batch: no lane decides about sizes whose squares leave the range of double", "[narrow][batch]") {
  for (const double unit : {0x1p-460, 0x1p510}) {
    const Box cube{Vec3(unit, unit, unit)};
    Batch p;
    p.add_b({3 * unit, 0, 0}, {0.1, 0.2, 0.3, 1});
    p.add_b({0.5 * unit, 0, 0}, {0.1, 0.2, 0.3, 1});
    const auto v = lanes(cube, cube, p);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(v.apart[i] == 0);
      CHECK(v.meeting[i] == 0);
    }
    const Count n = check_same(cube, cube, p);
    CHECK(n.apart == 1);
    CHECK(n.meeting == 1);
  }
}

TEST_CASE("batch: flat boxes and other shapes", "[narrow][batch]") {
  Rng r(7);
  const Shape flat = Box{{1, 1, 0}}, rod = Box{{0, 0, 1}}, ball = Sphere{0.75}, drum = Cylinder{0.5, 1};
  for (const Shape* a : {&flat, &rod, &ball, &drum})
    for (const Shape* b : {&flat, &rod, &ball, &drum}) {
      const Count n = check_same(*a, *b, random_batch(r, 50));
      CHECK(n.apart + n.meeting == 50);
    }
  check_same(flat, rod, Batch{});
}

TEST_CASE("batch: lengths that differ are an error", "[narrow][batch]") {
  const Shape cube = Box{{1, 1, 1}};
  const Collider c(cube);
  const std::vector<Pose> two(2), three(3);
  std::vector<OverlapAnswer> out(2);
  CHECK_THROWS_AS(overlaps(c, two, c, three, out), std::invalid_argument);
  CHECK_THROWS_AS(overlaps(c, three, c, two, out), std::invalid_argument);
  CHECK_NOTHROW(overlaps(c, two, c, two, out));
}
