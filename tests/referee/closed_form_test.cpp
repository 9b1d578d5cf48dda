// Spheres, capsules, half-spaces and exact touching, against closed forms.
#include "oracles/checker/checker.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Placed at(const Shape& s, const Vec3& t, const Quat& q = {}) { return {&s, Pose{t, q}}; }

bool holds(const Bracket& b, long double x) {
  return static_cast<long double>(b.lo) <= x && x <= static_cast<long double>(b.hi);
}

}  // namespace

TEST_CASE("spheres: the gap is the distance of the centres less the radii", "[referee]") {
  Rng r(11);
  int overlaps = 0;
  constexpr int cases = 4000;
  for (int i = 0; i < cases; ++i) {
    const double size = r.binary_scale(-20, 20);
    const Shape a = Sphere{size * r.uniform()}, b = Sphere{size * r.uniform()};
    const Vec3 p = size * r.unit_vector(), q = p + size * r.uniform(0, 2.0) * r.unit_vector();
    const PairTruth t = judge_pair(at(a, p, r.rotation()), at(b, q));
    const long double x = (long double)q.x() - p.x(), y = (long double)q.y() - p.y(),
                      z = (long double)q.z() - p.z();
    const long double g =
        std::sqrt(x * x + y * y + z * z) - std::get<Sphere>(a).radius - std::get<Sphere>(b).radius;
    REQUIRE(t.verdict != Verdict::undecided);
    REQUIRE((t.verdict == Verdict::overlap) == (g <= 0));
    REQUIRE(static_cast<long double>(t.gap.lo) <= g + 1e-18L * size);
    REQUIRE(static_cast<long double>(t.gap.hi) >= g - 1e-18L * size);
    REQUIRE(t.gap.hi - t.gap.lo <= 1e-15 * size);
    overlaps += t.verdict == Verdict::overlap;
  }
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
}

TEST_CASE("exact touching is overlap, one ulp apart is disjoint, at every scale", "[referee][exact]") {
  int decided = 0;
  for (int e = -40; e <= 40; ++e) {
    const double s = std::ldexp(1.0, e);
    // 3-4-5 and 1-2-2-3: centre distances that are exact.
    const Shape five = Sphere{2 * s}, three = Sphere{3 * s}, box = Box{{s, s, s}},
                capsule = Capsule{s, 2 * s};
    const auto judged = [&](const Shape& a, const Vec3& p, const Shape& b, const Vec3& q) {
      const Placed x = at(a, p), y = at(b, q);
      const PairTruth t = judge_pair(x, y);
      REQUIRE(checker::check(checkable_certificate(t, x, y), x, y));
      ++decided;
      return t.verdict;
    };
    REQUIRE(judged(five, {0, 0, 0}, three, {3 * s, 4 * s, 0}) == Verdict::overlap);
    REQUIRE(judged(five, {0, 0, 0}, three, {std::nextafter(3 * s, inf), 4 * s, 0}) == Verdict::disjoint);
    REQUIRE(judged(box, {0, 0, 0}, box, {2 * s, s, -s}) == Verdict::overlap);
    REQUIRE(judged(box, {0, 0, 0}, box, {std::nextafter(2 * s, inf), s, -s}) == Verdict::disjoint);
    // The corner (s,s,s) and a ball of radius 3s about (s,s,s) + (1,2,2)s.
    REQUIRE(judged(box, {0, 0, 0}, three, {2 * s, 3 * s, 3 * s}) == Verdict::overlap);
    REQUIRE(judged(box, {0, 0, 0}, three, {2 * s, 3 * s, std::nextafter(3 * s, inf)}) == Verdict::disjoint);
    REQUIRE(judged(capsule, {0, 0, 0}, capsule, {2 * s, 0, s / 3}) == Verdict::overlap);
    REQUIRE(judged(capsule, {0, 0, 0}, capsule, {std::nextafter(2 * s, inf), 0, s / 3}) == Verdict::disjoint);
    // The same pair far from the origin, by exact translation.
    const double far = 1e6 * s;
    REQUIRE(judged(box, {far, far, far}, box, {far + 2 * s, far, far}) == Verdict::overlap);
    REQUIRE(judged(box, {far, far, far}, box, {std::nextafter(far + 2 * s, inf), far, far}) ==
            Verdict::disjoint);
  }
  REQUIRE(decided == 81 * 10);
}

TEST_CASE("a quaternion of any length denotes the same exact rotation", "[referee][exact]") {
  // Rotated by 2·atan(1/2): cos = 3/5, sin = 4/5; the corner of the rotated cube reaches 1.4 exactly.
  const Shape cube = Box{{1, 1, 1}}, flat = Box{{0, 5, 5}};
  int cases = 0;
  for (double k : {1.0, 3.0, 1e-3, 7.25, 1e9}) {
    const Quat q{0, 0, k, 2 * k};
    const Placed a = at(cube, {0, 0, 0}, q);
    REQUIRE(judge_pair(a, at(flat, {1.4, 0, 0})).verdict ==
            Verdict::overlap);  // 1.4 as a double is below 7/5
    REQUIRE(judge_pair(a, at(flat, {std::nextafter(1.4, 2.0), 0, 0})).verdict == Verdict::disjoint);
    ++cases;
  }
  REQUIRE(cases == 5);
}

TEST_CASE("half-space: the gap is one support value along its normal, and the verdict exact", "[referee]") {
  Rng r(77);
  int overlaps = 0, total = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = r.binary_scale(-10, 10);
    const Shape body = random_convex(r, tested_kinds[r.below(7)], size);
    const Vec3 n = r.unit_vector() * r.uniform(0.1, 10);
    const Shape h = HalfSpace{n, size * r.uniform(-1, 1) * n.norm()};
    const Pose hp{size * r.unit_vector(), {}}, bp{size * 1.5 * r.unit_vector(), r.rotation()};
    const Placed a{&h, hp}, b{&body, bp};
    const PairTruth t = judge_pair(a, b), u = judge_pair(b, a);
    const Vec3 p = world_support(body, bp, -n);
    const double g = (n.dot(p - hp.translation) - std::get<HalfSpace>(h).offset) / n.norm();
    REQUIRE(std::abs(t.gap.lo - g) <= 1e-14 * size);
    REQUIRE(std::abs(t.gap.hi - g) <= 1e-14 * size);
    REQUIRE(u.gap.lo == t.gap.lo);
    REQUIRE(u.gap.hi == t.gap.hi);
    REQUIRE(t.verdict == u.verdict);
    REQUIRE(t.normal == -u.normal);
    REQUIRE(t.verdict != Verdict::undecided);
    const Bracket w = width(a, b, t.normal);
    REQUIRE(w.lo <= -t.gap.lo);
    REQUIRE(w.hi >= -t.gap.hi);
    REQUIRE(width(a, b, -t.normal).lo == inf);
    if (kind_of(body) <= ShapeKind::capsule || kind_of(body) == ShapeKind::hull) {
      REQUIRE(checker::check(checkable_certificate(t, a, b), a, b));
      REQUIRE(checker::check(checkable_certificate(u, b, a), b, a));
    }
    overlaps += t.verdict == Verdict::overlap;
    ++total;
  }
  REQUIRE(total == 3000);
  REQUIRE(overlaps > total * 3 / 10);
  REQUIRE(overlaps < total * 7 / 10);
}

static Verdict within(const Placed& a, const Placed& b, double margin) {
  return judge_within(a, b, margin, judge_pair(a, b));
}

TEST_CASE("two half-spaces are apart only when antiparallel", "[referee]") {
  const Shape up = HalfSpace{{0, 0, 2}, 2}, down = HalfSpace{{0, 0, -1}, -3}, side = HalfSpace{{1, 0, 0}, 0};
  const PairTruth t = judge_pair(at(up, {0, 0, 0}), at(down, {0, 0, 0}));  // z <= 1 and z >= 3
  REQUIRE(t.verdict == Verdict::disjoint);
  REQUIRE(holds(t.gap, 2));
  CHECK((t.witness[0] - Vec3(0, 0, 1)).norm() <= 1e-15);
  CHECK((t.witness[1] - Vec3(0, 0, 3)).norm() <= 1e-15);
  const PairTruth slab = judge_pair(at(down, {7, 0, -4}), at(up, {0, 0, 0}));  // z >= -1 and z <= 1
  REQUIRE(holds(slab.gap, -2));
  CHECK(std::fabs(slab.witness[0].z() + 1) <= 1e-15);
  CHECK(std::fabs(slab.witness[1].z() - 1) <= 1e-15);
  CHECK(std::fabs(slab.verdict_certificate.point.z()) <= 1);
  for (const double margin : {-2.5, -2.0, -1.5}) {
    const Verdict expected = margin < -2 ? Verdict::disjoint : Verdict::overlap;
    CHECK(within(at(down, {7, 0, -4}), at(up, {0, 0, 0}), margin) == expected);
  }
  CHECK(within(at(up, {0, 0, 0}), at(down, {0, 0, 0}), 2) == Verdict::overlap);
  CHECK(within(at(up, {0, 0, 0}), at(down, {0, 0, 0}), std::nextafter(2, 0)) == Verdict::disjoint);
  CHECK(within(at(up, {0, 0, 0}), at(side, {0, 0, 0}), -1e9) == Verdict::overlap);
  REQUIRE(judge_pair(at(up, {0, 0, 2}), at(down, {0, 0, 0})).verdict == Verdict::overlap);
  const PairTruth crossed = judge_pair(at(up, {0, 0, 0}), at(side, {9, 9, 9}));
  REQUIRE(crossed.verdict == Verdict::overlap);
  REQUIRE(crossed.gap.hi == -inf);
  const PairTruth far = judge_pair(at(up, {0, 0, -50}), at(side, {-20, 0, 0}));  // z <= -49 and x <= -20
  CHECK(far.verdict_certificate.point.z() <= -49);
  CHECK(far.verdict_certificate.point.x() <= -20);
}

TEST_CASE("shapes of size zero are points, segments and discs", "[referee]") {
  const Shape dot = Sphere{0}, stick = Capsule{0, 1}, needle = Cylinder{0, 1}, disc = Cylinder{1, 0},
              box = Box{{1, 1, 1}};
  REQUIRE(judge_pair(at(dot, {1, 1, 1}), at(box, {0, 0, 0})).verdict == Verdict::overlap);
  REQUIRE(judge_pair(at(dot, {1, 1, 1}), at(dot, {1, 1, 1})).verdict == Verdict::overlap);
  REQUIRE(judge_pair(at(stick, {0, 0, 2}), at(needle, {0, 0, 0})).verdict == Verdict::overlap);
  const PairTruth lying = judge_pair(at(disc, {0, 0, 3}), at(box, {0, 0, 0}));
  REQUIRE(lying.verdict == Verdict::disjoint);
  REQUIRE(holds(lying.gap, 2));
  const PairTruth through = judge_pair(at(disc, {0, 0, 0.5}), at(box, {0, 0, 0}));
  REQUIRE(through.verdict == Verdict::overlap);
  REQUIRE(through.gap.lo <= -0.5);
  REQUIRE(through.gap.hi >= -0.5);
  const PairTruth flat = judge_pair(at(disc, {0, 0, 0}), at(disc, {1, 0, 0}));
  REQUIRE(flat.gap.lo <= 0);
  REQUIRE(flat.gap.hi >= 0);
  REQUIRE(flat.gap.hi - flat.gap.lo <= 1e-14);
}

TEST_CASE("distance_to is 0 inside and the distance outside", "[referee]") {
  const Shape box = Box{{1, 2, 3}}, cone = Cone{1, 1}, half = HalfSpace{{0, 0, 1}, 1};
  REQUIRE(distance_to(at(box, {0, 0, 0}), {1, 2, 3}).hi == 0);
  REQUIRE(holds(distance_to(at(box, {0, 0, 0}), {4, 6, 3}), 5));
  REQUIRE(holds(distance_to(at(cone, {0, 0, 0}), {0, 0, 3}), 2));
  REQUIRE(distance_to(at(cone, {0, 0, 0}), {0, 0, 0.5}).hi == 0);
  REQUIRE(holds(distance_to(at(half, {0, 0, 0}), {5, 5, 4}), 3));
  TriangleMesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}};
  m.triangles = {{0, 1, 2}, {0, 1, 3}};
  const Shape mesh = m;
  REQUIRE(holds(distance_to(at(mesh, {0, 0, 0}), {0.25, 0.25, -2}), 2));
}

// The closed forms answer when they prove that the distance is at most a sufficient value. 0 is never
// sufficient, so then the search answers.
TEST_CASE("the closed forms of a point's distance agree with the search", "[referee]") {
  Rng r(515);
  int closed = 0;
  for (int i = 0; i < 4000; ++i) {
    const double size = r.binary_scale(-19, 19), aspect = std::pow(10.0, r.uniform(-3, 0));
    TriangleMesh m;
    for (int k = 0; k < 6; ++k) m.vertices.push_back(size * r.unit_vector());
    m.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 4, 5}, {0, 0, 5}};
    const Shape shapes[] = {Cylinder{size, aspect * size},
                            Cylinder{aspect * size, size},
                            Cone{size, aspect * size},
                            Cone{aspect * size, size},
                            Ellipsoid{{size, aspect * size, r.uniform(0.1, 1) * size}},
                            m};
    const Shape& s = shapes[i % 6];
    const Pose pose{size * std::pow(10.0, r.uniform(-1, 3)) * r.unit_vector(), r.rotation()};
    const Placed p{&s, pose};
    // Inside, on the surface within rounding, and some distance away.
    const double out = std::pow(10.0, r.uniform(-17, 0.5));
    const Vec3 n = r.unit_vector();
    const Vec3 point = i % 6 == 5      ? Vec3(pose.translation + size * r.uniform(0, 2) * n)
                       : r.chance(0.2) ? Vec3(pose.translation + 0.01 * aspect * size * n)
                                       : Vec3(world_support(s, pose, n) + out * size * n);
    const Bracket found = distance_to(p, point, 1e3 * size), known = distance_to(p, point);
    INFO("case " << i << " " << type_name(s) << ": " << found.lo << " " << found.hi << " and " << known.lo
                 << " " << known.hi);
    REQUIRE(found.lo <= found.hi);
    REQUIRE(found.lo <= known.hi);
    REQUIRE(known.lo <= found.hi);
    const double length = size + pose.translation.norm();
    closed += found.hi - known.hi <= 1e-15 * length;
  }
  REQUIRE(closed == 4000);
}
