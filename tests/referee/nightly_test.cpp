// Checks the referee: slow and obvious second implementations, on many cases. Part of it runs with every
// test, all of it at night:
//
//   TOUCHSTONE_NIGHTLY_CASES=1000000 build/release/bin/test_referee_queries "[.nightly]"
//
// The number (default 1000000) applies to lattice, degenerate and closed-form cases each; smooth shapes are a
// twentieth of it, motions a thousandth. Cases depend only on the seed.
#include <cstdlib>

#include "oracles/checker/checker.h"
#include "oracles/referee/referee.h"
#include "tests/referee/separating_axis.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;

namespace {

int nightly_cases() {
  const char* text = std::getenv("TOUCHSTONE_NIGHTLY_CASES");
  return text ? std::max(1, std::atoi(text)) : 1000000;
}

void require_agreement(const Placed3& x, const Placed3& y, int& overlaps, int& touching) {
  const Slow slow = judge_slowly(x.world, y.world, x.scale, y.scale);
  const Placed a{&x.shape, x.pose}, b{&y.shape, y.pose};
  const PairTruth t = judge_pair(a, b);
  if (t.verdict != (slow.disjoint ? Verdict::disjoint : Verdict::overlap)) FAIL("the verdict differs");
  if (!(t.gap.lo <= t.gap.hi)) FAIL("the bracket is empty");
  if (!slow.disjoint) {
    ++overlaps;
    touching += slow.depth == 0;
    if (static_cast<long double>(t.gap.lo) > -slow.depth * (1 - 1e-17L) ||
        static_cast<long double>(t.gap.hi) < -slow.depth * (1 + 1e-17L))
      FAIL("the depth is outside its bracket: " << static_cast<double>(slow.depth) << " not in [" << -t.gap.hi
                                                << ", " << -t.gap.lo << "]");
  } else if (!(t.gap.hi > 0)) {
    FAIL("apart, but the gap is not positive");
  }
  if (!checker::check(checkable_certificate(t, a, b), a, b)) FAIL("the checker refuses the certificate");
}

void lattice(int cases, std::uint64_t seed) {
  Rng r(seed);
  int overlaps = 0, touching = 0;
  for (int i = 0; i < cases; ++i) {
    INFO("lattice case " << i);
    const Placed3 x = random_polytope(r), y = random_polytope(r);
    require_agreement(x, y, overlaps, touching);
  }
  WARN(cases << " lattice cases: " << overlaps << " overlap, " << touching << " of them touch exactly");
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
  REQUIRE(touching > cases / 100);
}

// Flat, straight or point-like, with vertices that repeat or lie within faces and edges, or needle-thin.
std::vector<I3> degenerate_points(Rng& r) {
  const auto c = [&](int most) { return static_cast<std::int64_t>(r.below(2 * most + 1)) - most; };
  const I3 u{c(2), c(2), c(2)}, v{c(2), c(2), c(2)}, needle{c(30), c(30), c(30)};
  const auto at = [](const I3& d, std::int64_t s) { return I3{s * d.x, s * d.y, s * d.z}; };
  const auto sum = [](const I3& a, const I3& b) { return I3{a.x + b.x, a.y + b.y, a.z + b.z}; };
  std::vector<I3> p;
  const auto kind = r.below(5);
  const int n = 1 + static_cast<int>(r.below(6));
  for (int i = 0; i < n; ++i) {
    if (kind == 0) p.push_back(sum(at(u, c(2)), at(v, c(2))));  // in a plane
    if (kind == 1) p.push_back(at(u, c(3)));                    // on a line
    if (kind == 2) p.push_back(sum(at(needle, c(1)), {c(1), c(1), c(1)}));
    if (kind == 3) p.push_back({2 * c(1), 2 * c(1), 2 * c(1)});
    if (kind == 4) p.push_back({c(3), c(3), static_cast<std::int64_t>(r.below(2))});  // a thin slice
  }
  // Points that are not extreme.
  if (r.chance(0.5)) p.push_back(p[r.below(p.size())]);
  if (kind == 3 && p.size() > 1) {
    const I3 &a = p[r.below(p.size())], &b = p[r.below(p.size())];
    p.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
  }
  return p;
}

Placed3 degenerate_body(Rng& r) {
  Placed3 p;
  p.world = degenerate_points(r);
  Hull h;
  for (const I3& v : p.world) h.vertices.emplace_back(double(v.x), double(v.y), double(v.z));
  p.shape = h;
  return p;
}

void move_to(Placed3& p, const I3& by) {
  p.pose.translation += Vec3(double(by.x), double(by.y), double(by.z));
  for (I3& v : p.world) v = {v.x + by.x, v.y + by.y, v.z + by.z};
}

void degenerate(int cases, std::uint64_t seed) {
  Rng r(seed);
  int overlaps = 0, touching = 0;
  for (int i = 0; i < cases; ++i) {
    INFO("degenerate case " << i);
    Placed3 x = degenerate_body(r), y = degenerate_body(r);
    // A vertex on a vertex, or arbitrary.
    if (r.chance(0.3)) move_to(y, x.world[r.below(x.world.size())] - y.world[r.below(y.world.size())]);
    if (r.chance(0.5))
      move_to(y, {static_cast<std::int64_t>(r.below(3)) - 1, 0, static_cast<std::int64_t>(r.below(3))});
    require_agreement(x, y, overlaps, touching);
  }
  WARN(cases << " degenerate cases: " << overlaps << " overlap, " << touching << " of them touch exactly");
  REQUIRE(overlaps > cases / 5);
  REQUIRE(overlaps < cases * 4 / 5);
  REQUIRE(touching > cases / 10);
}

using Ld = long double;
struct L3 {
  Ld x, y, z;
};
L3 wide(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
L3 operator-(const L3& a, const L3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
L3 along(const L3& a, Ld s, const L3& d) { return {a.x + s * d.x, a.y + s * d.y, a.z + s * d.z}; }
Ld dot(const L3& a, const L3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Ld norm(const L3& a) { return std::sqrt(dot(a, a)); }

Ld clamp01(Ld x) { return std::min(Ld{1}, std::max(Ld{0}, x)); }

// Two segments: the minimum over the four ends against the other segment, and the feet inside both.
Ld segment_distance(const L3& p, const L3& d, const L3& q, const L3& e) {
  const auto to_segment = [](const L3& x, const L3& a, const L3& u) {
    const Ld uu = dot(u, u);
    return norm(x - along(a, uu > 0 ? clamp01(dot(x - a, u) / uu) : 0, u));
  };
  Ld best = std::min({to_segment(p, q, e), to_segment(along(p, 1, d), q, e), to_segment(q, p, d),
                      to_segment(along(q, 1, e), p, d)});
  const Ld a = dot(d, d), b = dot(d, e), c = dot(e, e), f = dot(d, q - p), g = dot(e, q - p),
           det = a * c - b * b;
  if (det > 0) {
    const Ld s = (f * c - g * b) / det, t = (f * b - g * a) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, norm(along(p, s, d) - along(q, t, e)));
  }
  return best;
}

void require_gap(const PairTruth& t, Ld g, double size, Ld doubt) {
  if (std::fabs(g) > doubt && (t.verdict == Verdict::overlap) != (g <= 0)) FAIL("the verdict differs");
  if (t.verdict == Verdict::undecided) FAIL("undecided");
  if (Ld(t.gap.lo) > g + doubt || Ld(t.gap.hi) < g - doubt)
    FAIL("gap " << static_cast<double>(g) << " not in [" << t.gap.lo << ", " << t.gap.hi << "]");
  if (t.gap.hi - t.gap.lo > 1e-14 * size) FAIL("the bracket is wide: " << t.gap.hi - t.gap.lo);
}

// Axis-aligned, so that the closed forms are exact up to their own rounding in 64 bits.
void closed_forms(int cases, std::uint64_t seed) {
  Rng r(seed);
  int overlaps = 0;
  for (int i = 0; i < cases; ++i) {
    INFO("closed form " << i);
    const double size = r.binary_scale(-20, 20);
    const Vec3 p = size * r.vector(0, 1), q = p + size * r.uniform(0, 2.2) * r.unit_vector();
    const Ld doubt = 64 * 0x1p-64L * size;
    const L3 d = wide(q) - wide(p);
    const double ra = size * r.uniform(0.1, 1), rb = size * r.uniform(0.1, 1);
    const Shape ball_a = Sphere{ra}, ball_b = Sphere{rb};
    Ld g = 0;
    PairTruth t;
    if (i % 3 == 0) {
      t = judge_pair({&ball_a, Pose{p, r.rotation()}}, {&ball_b, Pose{q, {}}});
      g = norm(d) - ra - rb;
    } else if (i % 3 == 1) {
      // A quarter turn about x or y is exact: the segments lie along the axes.
      const double ha = size * r.uniform(), hb = size * r.uniform();
      const Shape a = Capsule{ra / 2, ha}, b = Capsule{rb / 2, hb};
      const bool turned = r.chance(0.5);
      t = judge_pair({&a, Pose{p, {}}}, {&b, Pose{q, turned ? Quat{1, 0, 0, 1} : Quat{}}});
      const L3 u{0, 0, 2 * Ld(ha)}, w = turned ? L3{0, 2 * Ld(hb), 0} : L3{0, 0, 2 * Ld(hb)};
      g = segment_distance(along(wide(p), -0.5L, u), u, along(wide(q), -0.5L, w), w) - ra / 2 - rb / 2;
    } else {
      const Vec3 h = size * Vec3(r.uniform(0.1, 1), r.uniform(0.1, 1), r.uniform(0.1, 1));
      const Shape a = Box{h};
      t = judge_pair({&a, Pose{p, {}}}, {&ball_b, Pose{q, r.rotation()}});
      const L3 out{std::fabs(d.x) - h.x(), std::fabs(d.y) - h.y(), std::fabs(d.z) - h.z()};
      const Ld deepest = std::max({out.x, out.y, out.z});
      g = deepest <= 0 ? deepest
                       : norm({std::max(out.x, Ld{0}), std::max(out.y, Ld{0}), std::max(out.z, Ld{0})});
      g -= rb;
    }
    // The depth of capsules with crossing axes also depends on the crossing: w(n) gives it, this form does
    // not.
    if (i % 3 == 1 && g < 0) {
      if (t.verdict != Verdict::overlap && g < -doubt) FAIL("the verdict differs");
      if (Ld(t.gap.lo) > g + doubt) FAIL("the depth is less than the balls' own");
    } else {
      require_gap(t, g, size, doubt);
    }
    overlaps += t.verdict == Verdict::overlap;
  }
  WARN(cases << " closed forms: " << overlaps << " overlap");
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
}

// Any direction bounds the gap from below, any two points of the bodies bound it from above. Uses the core's
// own support mappings, improved by conditional gradient steps (Frank and Wolfe 1956).
void smooth(int cases, std::uint64_t seed) {
  Rng r(seed);
  int overlaps = 0, undecided = 0, apart = 0;
  double loosest = 0;
  for (int i = 0; i < cases; ++i) {
    INFO("smooth case " << i);
    const Shape x = random_convex(r, tested_kinds[4 + i % 3]), y = random_convex(r, tested_kinds[i / 3 % 7]);
    const Pose p{r.vector(0, 0.5), r.rotation()}, q{r.vector(0, 1.1), r.rotation()};
    const PairTruth t = judge_pair({&x, p}, {&y, q});
    undecided += t.verdict == Verdict::undecided;
    overlaps += t.verdict == Verdict::overlap;
    constexpr double rounding = 1e-14;
    const auto width_of = [&](const Vec3& n) {
      return n.dot(world_support(x, p, n)) - n.dot(world_support(y, q, -n));
    };
    for (int k = 0; k < 24; ++k)
      if (-width_of(r.unit_vector()) > t.gap.hi + rounding) FAIL("a direction shows a larger gap");
    if (-width_of(t.normal) > t.gap.hi + rounding || -width_of(t.normal) < t.gap.lo - 1e-7)
      FAIL("the normal is not that of the gap");
    if (t.verdict != Verdict::disjoint) continue;
    Vec3 v = world_support(x, p, Vec3::UnitX()) - world_support(y, q, -Vec3::UnitX());
    for (int k = 0; k < 60; ++k) {
      const Vec3 w = world_support(x, p, -v) - world_support(y, q, v), d = v - w;
      const double step = d.squaredNorm() > 0 ? std::clamp(v.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
      v -= step * d;
    }
    ++apart;
    if (v.norm() < t.gap.lo - rounding) FAIL("two points are nearer than the gap");
    loosest = std::max(loosest, v.norm() - t.gap.hi);
  }
  WARN(cases << " smooth pairs: " << overlaps << " overlap, " << undecided
             << " undecided; nearest points found within " << loosest << " of the gap");
  REQUIRE(undecided <= cases / 1000);
  REQUIRE(overlaps > cases * 3 / 10);
  REQUIRE(overlaps < cases * 7 / 10);
  REQUIRE(apart > cases / 5);
}

// Motions: the core's poses in double and the discrete judge at many times; the checker for the certificate.
void motions(int cases, std::uint64_t seed) {
  Rng r(seed);
  int hits = 0, undecided = 0, pointless = 0;
  for (int i = 0; i < cases; ++i) {
    INFO("motion " << i);
    const Shape x = random_convex(r, tested_kinds[i % 7]), y = random_convex(r, tested_kinds[i / 7 % 7]);
    const Pose p{2 * r.unit_vector(), r.rotation()}, q{r.vector(0, 0.2), r.rotation()};
    const double fast = r.chance(0.3) ? 30 : 5;
    const Motion ma{-2 * p.translation + 2.2 * r.unit_vector(), r.uniform(0, fast) * r.unit_vector()},
        mb{Vec3::Zero(), r.chance(0.5) ? Vec3(r.uniform(0, fast) * r.unit_vector()) : Vec3(0, 0, 0)};
    const Placed a{&x, p}, b{&y, q};
    const TimeTruth t = judge_motion(a, ma, b, mb);
    hits += t.verdict == TimeTruth::Verdict::hit;
    undecided += t.verdict == TimeTruth::Verdict::undecided;
    const double clear = t.verdict == TimeTruth::Verdict::none ? 1 : t.t_lo;
    // Bodies that overlap at the start are never clear.
    for (int k = 0; clear > 0 && k < 60; ++k) {
      const double s = clear * r.uniform();
      if (judge_pair({&x, pose_at(p, ma, s)}, {&y, pose_at(q, mb, s)}).gap.hi < -1e-13)
        FAIL("overlap at " << s << ", before " << clear);
    }
    const ImpactCertificate c = impact_certificate(a, ma, b, mb, t);
    if (!c.claims_nothing() && !checker::check(c, a, ma, b, mb)) FAIL("the checker refuses the certificate");
    if (clear > 0 && c.clear_until < clear - 1e-9)
      FAIL("the planes end at " << c.clear_until << " of " << clear);
    pointless += t.verdict == TimeTruth::Verdict::hit && !c.contact;
  }
  WARN(cases << " motions: " << hits << " hit, " << undecided << " undecided, " << pointless
             << " hits without a point of contact that can be shown");
  REQUIRE(pointless <= cases / 100);
  REQUIRE(hits > cases * 3 / 10);
  REQUIRE(hits < cases * 7 / 10);
  REQUIRE(undecided <= 1 + cases / 100);
}

}  // namespace

TEST_CASE("some degenerate polytopes, closed forms and smooth shapes agree with second implementations",
          "[referee][exact]") {
  degenerate(6000, 71);
  closed_forms(6000, 72);
  smooth(1500, 73);
  motions(60, 74);
}

TEST_CASE("many lattice polytopes agree with the exhaustive separating-axis test", "[.nightly]") {
  lattice(nightly_cases(), 1001);
}
TEST_CASE("many degenerate polytopes agree with the exhaustive separating-axis test", "[.nightly]") {
  degenerate(nightly_cases(), 1002);
}
TEST_CASE("many spheres, capsules and boxes agree with their closed forms", "[.nightly]") {
  closed_forms(nightly_cases(), 1003);
}
TEST_CASE("many smooth pairs agree with bounds by sampling", "[.nightly]") {
  smooth(std::max(100, nightly_cases() / 20), 1004);
}
TEST_CASE("many motions agree with samples in time and have certificates", "[.nightly]") {
  motions(std::max(50, nightly_cases() / 1000), 1005);
}
