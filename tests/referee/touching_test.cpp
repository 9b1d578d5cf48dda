// Bodies of simple sizes rotated by symmetries of the lattice: many touch exactly. The verdict of a curved
// pair that touches at a point with simple coordinates is decided, with a point that the checker accepts.
#include "oracles/checker/checker.h"
#include "oracles/referee/work.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

double eighths(Rng& r, int lo, int hi) {
  return (lo + static_cast<int>(r.below(static_cast<std::uint64_t>(hi - lo + 1)))) / 8.0;
}

Shape lattice_shape(Rng& r) {
  const double x = eighths(r, 2, 8), y = eighths(r, 2, 8), z = eighths(r, 2, 8);
  switch (r.below(6)) {
    case 0:
      return Sphere{x};
    case 1:
      return Box{{x, y, z}};
    case 2:
      return Capsule{x, y};
    case 3:
      return Cylinder{x, y};
    case 4:
      return Cone{x, y};
    default:
      return Ellipsoid{{x, y, z}};
  }
}

Quat quarter_turn(Rng& r) {
  const Quat turns[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {1, 0, 0, 0}};
  return turns[r.below(6)];
}

}  // namespace

TEST_CASE("exact contact of curved bodies on a lattice is decided", "[referee][touching]") {
  Rng r(71);
  int touching = 0, undecided = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const Shape x = lattice_shape(r), y = lattice_shape(r);
    Pose px, py;
    px.rotation = quarter_turn(r);
    py.rotation = quarter_turn(r);
    // Boxes that share a face along an axis: the bodies usually touch there.
    const Placed at_origin{&y, py};
    const Aabb box_a = outer_box({&x, px}), box_b = outer_box(at_origin);
    const int k = static_cast<int>(r.below(3));
    py.translation[k] = std::round(64 * (box_a.hi[k] - box_b.lo[k])) / 64;
    const Placed a{&x, px}, b{&y, py};
    const PairTruth t = judge_pair(a, b);
    undecided += t.verdict == Verdict::undecided;
    if (t.verdict != Verdict::overlap || t.gap.lo < -1e-9) continue;
    ++touching;
    REQUIRE(checker::check(checkable_certificate(t, a, b), a, b));
    REQUIRE(t.gap.hi <= 0);
  }
  CAPTURE(touching, undecided);
  REQUIRE(touching > n / 3);
  CHECK(undecided <= n / 200);
}

TEST_CASE("a body half a billionth of a unit away is not in contact", "[referee][touching]") {
  Rng r(73);
  int apart = 0;
  for (int i = 0; i < 600; ++i) {
    const double radius = eighths(r, 2, 8), half = eighths(r, 2, 8);
    const Shape drum = Cylinder{radius, half}, ball = Sphere{1};
    const double gap = std::ldexp(1.0, -30 - static_cast<int>(r.below(20)));
    Pose p;
    p.translation = {radius + 1 + gap, 0, half / 2};
    if (p.translation.x() == radius + 1) continue;
    const PairTruth t = judge_pair({&drum, Pose{}}, {&ball, p});
    REQUIRE(t.verdict == Verdict::disjoint);
    ++apart;
  }
  REQUIRE(apart == 600);
}

// The two neighbouring doubles between which a shift of B separates it from A: the gaps there are about
// 1e-17, too small for extended precision to distinguish from 0.
TEST_CASE("curved bodies are decided on both sides of contact, one ulp apart", "[referee][touching]") {
  Rng r(74);
  const ShapeKind curved[] = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid};
  int by_level[3] = {0, 0, 0}, certified = 0, undecided = 0;
  constexpr int n = 150;
  for (int i = 0; i < n; ++i) {
    const Shape x = random_convex(r, curved[i % 3]), y = random_convex(r, tested_kinds[i / 3 % 7]);
    const Pose p{Vec3::Zero(), r.rotation()};
    const Quat turn = r.rotation();
    const Vec3 along = r.unit_vector();
    const auto at = [&](double s) { return judge_pair({&x, p}, {&y, Pose{s * along, turn}}); };
    double in = 0, out = 8;
    REQUIRE(at(in).verdict == Verdict::overlap);
    REQUIRE(at(out).verdict == Verdict::disjoint);
    for (double s = 4; s > in && s < out; s = in + 0.5 * (out - in))
      (at(s).verdict == Verdict::disjoint ? out : in) = s;
    for (const double s : {in, out}) {
      const Pose q{s * along, turn};
      const PairTruth t = judge_pair({&x, p}, {&y, q});
      CAPTURE(i, s);
      if (t.verdict == Verdict::undecided) {
        ++undecided;
        continue;
      }
      REQUIRE(t.verdict == (s == in ? Verdict::overlap : Verdict::disjoint));
      ++by_level[t.level];
      if (t.level < 2) continue;
      REQUIRE(checker::check(t.verdict_certificate, {&x, p}, {&y, q}));
      REQUIRE((s == in ? t.gap.hi <= 0 : t.gap.lo >= 0));
      ++certified;
    }
  }
  CAPTURE(by_level[0], by_level[1], by_level[2], undecided);
  REQUIRE(certified > n / 20);
  REQUIRE(undecided <= n / 75);
}

TEST_CASE("contact at a point of a rim and along an edge is found among simple fractions",
          "[referee][touching]") {
  const Shape drum = Cylinder{0.625, 0.875}, rod = Capsule{0.375, 0.75};
  const Pose lying{{0.25, 0.625, -1.25}, {1, 1, 1, 1}};
  REQUIRE(judge_pair({&drum, Pose{}}, {&rod, lying}).verdict == Verdict::overlap);
  const Shape roof = make_hull({{-2, -0.25, 0}, {2, 0.125, 0}, {-2, 1, -1}, {2, -1, -1}, {0, 0, -3}});
  const Shape cone = Cone{1.125, 0.75};
  const Pose below{{0.1, 0.3, -0.75}, {0, 0, 0, 1}};
  REQUIRE(judge_pair({&cone, Pose{}}, {&roof, below}).verdict == Verdict::overlap);
}

TEST_CASE("an exact search looks first where a mesh is nearest", "[referee][touching]") {
  const Hull roof = make_hull({{-2, -0.25, 0}, {2, 0.125, 0}, {-2, 1, -1}, {2, -1, -1}, {0, 0, -3}});
  TriangleMesh crowd{roof.vertices, {}};
  for (int i = 0; i < 60; ++i) {
    const int k = static_cast<int>(crowd.vertices.size());
    for (const Vec3& v : {Vec3(0, 0, 9), Vec3(1, 0, 9 + i), Vec3(0, 1, 9)}) crowd.vertices.push_back(v);
    crowd.triangles.push_back({k, k + 1, k + 2});
  }
  crowd.triangles.insert(crowd.triangles.end(), roof.faces.begin(), roof.faces.end());
  const Shape cone = Cone{1.125, 0.75}, mesh = crowd;
  const Pose below{{0.1, 0.3, -0.75}, {0, 0, 0, 1}};
  const WorkLimit few(200'000'000);
  REQUIRE(judge_pair({&cone, Pose{}}, {&mesh, below}).verdict == Verdict::overlap);
}

TEST_CASE("the overlap of a curved body and a mesh has a point that the checker accepts",
          "[referee][touching]") {
  Rng r(75);
  TriangleMesh roof;
  roof.vertices = {{-1, -1, 0}, {1, -1, 0.1}, {1, 1, -0.2}, {-1, 1, 0.3}, {0, 0, 1}};
  roof.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const Shape mesh = roof;
  const ShapeKind curved[] = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid};
  int overlaps = 0, apart = 0;
  for (int i = 0; i < 60; ++i) {
    const Shape y = random_convex(r, curved[i % 3]);
    const Pose p{r.vector(0, 0.1), r.rotation()}, q{1.2 * r.unit_vector(), r.rotation()};
    const Placed a{&mesh, p}, b{&y, q};
    const PairTruth t = judge_pair(a, b);
    CAPTURE(i);
    REQUIRE(checker::check(checkable_certificate(t, a, b), a, b));
    ++(t.verdict == Verdict::overlap ? overlaps : apart);
  }
  CHECK(overlaps > 10);
  CHECK(apart > 10);
}

}  // namespace touchstone::referee_test
