// Times of impact with known answers, thin walls, grazes, spins; and dense sampling as a slow second opinion.
#include "oracles/referee/counters.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;
using Hit = TimeTruth::Verdict;

namespace {

Placed at(const Shape& s, const Vec3& t, const Quat& q = {}) { return {&s, Pose{t, q}}; }
Motion moving(const Vec3& v, const Vec3& w = Vec3::Zero()) { return {v, w}; }
const Motion rest{};

void require_hit(const TimeTruth& t, double toi, double tolerance) {
  INFO("[" << t.t_lo << ", " << t.t_hi << "] " << t.note << " expected " << toi);
  REQUIRE(t.verdict == Hit::hit);
  REQUIRE(t.t_lo <= toi + tolerance);
  REQUIRE(t.t_hi >= toi - tolerance);
  REQUIRE(t.t_hi - t.t_lo <= tolerance);
}

}  // namespace

TEST_CASE("translation: polytopes and rounded shapes are decided down to neighbouring doubles",
          "[referee][motion]") {
  const Shape cube = Box{{0.5, 0.5, 0.5}}, ball = Sphere{1};
  require_hit(judge_motion(at(cube, {-5, 0, 0}), moving({10, 0, 0}), at(cube, {0, 0, 0}), rest), 0.4, 1e-15);
  require_hit(judge_motion(at(cube, {-2, 0, 0}), moving({1, 0, 0}), at(cube, {0, 0, 0}), rest), 1.0, 1e-15);
  require_hit(judge_motion(at(ball, {2, 2, 2}), moving({-0.5, -0.5, -0.5}),
                           at(Shape(Box{{1, 1, 1}}), {0, 0, 0}), moving({1, 1, 1})),
              (std::sqrt(3.0) - 1) / (1.5 * std::sqrt(3.0)), 1e-15);
  // Touching from the start; moving apart; no motion at all.
  require_hit(judge_motion(at(cube, {1, 0, 0}), moving({1, 0, 0}), at(cube, {0, 0, 0}), rest), 0, 0);
  REQUIRE(judge_motion(at(cube, {1.1, 0, 0}), moving({1, 0, 0}), at(cube, {0, 0, 0}), rest).verdict ==
          Hit::none);
  REQUIRE(judge_motion(at(cube, {1.1, 0, 0}), rest, at(cube, {0, 0, 0}), rest).verdict == Hit::none);
}

TEST_CASE("translation: an exact graze is a hit, one ulp of clearance is not", "[referee][motion][exact]") {
  const Shape cube = Box{{0.5, 0.5, 0.5}}, ball = Sphere{1};
  require_hit(judge_motion(at(cube, {-5, 1, 0}), moving({10, 0, 0}), at(cube, {0, 0, 0}), rest), 0.4, 1e-15);
  REQUIRE(
      judge_motion(at(cube, {-5, std::nextafter(1.0, 2.0), 0}), moving({10, 0, 0}), at(cube, {0, 0, 0}), rest)
          .verdict == Hit::none);
  require_hit(judge_motion(at(ball, {-10, 2, 0}), moving({20, 0, 0}), at(ball, {0, 0, 0}), rest), 0.5, 1e-15);
  const TimeTruth clear = judge_motion(at(ball, {-10, std::nextafter(2.0, 3.0), 0}), moving({20, 0, 0}),
                                       at(ball, {0, 0, 0}), rest);
  REQUIRE(clear.verdict == Hit::none);
  REQUIRE(clear.least_gap.lo >= 0);
  REQUIRE(clear.least_gap.hi <= 1e-15);
}

TEST_CASE("thin walls are never passed through", "[referee][motion]") {
  Rng r(5);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    const double spin = i % 3 == 0 ? 0 : std::pow(10.0, r.uniform(-1, 2.69));
    const Shape wall = Box{{5e-7, 0.9, 0.9}};
    const Shape body = random_convex(r, tested_kinds[r.below(7)], 0.05);
    const Placed a = at(body, {-0.5, r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5)}, r.rotation());
    const TimeTruth t = judge_motion(a, moving({1, 0, 0}, spin * r.unit_vector()), at(wall, {0, 0, 0}), rest);
    INFO(type_name(body) << " spin " << spin << " " << t.note << " [" << t.t_lo << ", " << t.t_hi << "]");
    REQUIRE(t.verdict == Hit::hit);
    REQUIRE(t.t_hi - t.t_lo <= 1e-9);
    ++hits;
  }
  REQUIRE(hits == 60);
}

TEST_CASE("spinning in place beside a wall: no hit when the circle clears it, a hit otherwise",
          "[referee][motion]") {
  const Shape bar = Box{{1, 0.1, 0.1}}, wall = Box{{0.1, 5, 5}};
  const double reach = std::sqrt(1 + 0.01);
  for (double spin : {1.0, 30.0, 500.0}) {
    const Placed a = at(bar, {0, 0, 0}, {0, 0, 1, 1});
    const TimeTruth clear =
        judge_motion(a, moving(Vec3::Zero(), {0, 0, spin}), at(wall, {reach + 0.1 + 1e-6, 0, 0}), rest);
    INFO("spin " << spin << " " << clear.note);
    REQUIRE(clear.verdict == Hit::none);
  }
  // Rotated by a right angle it lies along y; the corner reaches x = 0.9 at a known angle.
  const TimeTruth t = judge_motion(at(bar, {0, 0, 0}, {0, 0, 1, 1}), moving(Vec3::Zero(), {0, 0, -2}),
                                   at(wall, {1, 0, 0}), rest);
  const double angle = std::acos(-1.0) / 2 - std::atan(0.1) - std::acos(0.9 / reach);
  require_hit(t, angle / 2, 1e-14);
}

TEST_CASE("half-space and mesh in motion", "[referee][motion]") {
  const Shape ground = HalfSpace{{0, 0, 1}, 0}, ball = Sphere{0.25}, stick = Capsule{0.1, 1};
  require_hit(judge_motion(at(ball, {0, 0, 2}), moving({1, 0, -3}, {9, 9, 9}), at(ground, {0, 0, 0}), rest),
              1.75 / 3, 1e-15);
  require_hit(judge_motion(at(ground, {0, 0, 0}), rest, at(ball, {0, 0, 2}), moving({1, 0, -3})), 1.75 / 3,
              1e-15);
  // A level stick tips over: its end comes down by sin(angle).
  require_hit(judge_motion(at(stick, {0, 0, 0.6}, {0, 1, 0, 1}), moving(Vec3::Zero(), {0, 1, 0}),
                           at(ground, {0, 0, 0}), rest),
              std::asin(0.5), 1e-14);
  TriangleMesh m;
  m.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {90, 90, 90}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 3, 4}};
  const Shape floor = m;
  require_hit(judge_motion(at(ball, {0.1, 0.2, 2}), moving({0, 0, -3}), at(floor, {0, 0, 0}), rest), 1.75 / 3,
              1e-15);
  REQUIRE(judge_motion(at(ball, {0.1, 0.2, 2}), moving({0, 0, -1}), at(floor, {0, 0, 0}), rest).verdict ==
          Hit::none);
  REQUIRE(gap_at(at(ball, {0.1, 0.2, 2}), moving({0, 0, -1}), at(floor, {0, 0, 0}), rest, 1).lo ==
          Approx(0.75));
}

TEST_CASE("dense sampling finds no contact before t_lo, and none at all when the answer is no hit",
          "[referee][motion]") {
  Rng r(123);
  int hits = 0, none = 0, undecided = 0;
  constexpr int cases = 160;
  for (int i = 0; i < cases; ++i) {
    const Shape sa = random_convex(r, tested_kinds[r.below(7)]),
                sb = random_convex(r, tested_kinds[r.below(7)]);
    const Placed a = at(sa, 2.2 * r.unit_vector(), r.rotation()), b = at(sb, Vec3::Zero(), r.rotation());
    const Vec3 p = std::get<Pose>(a.pose).translation;
    const Motion ma = moving(-2 * p + 3.0 * r.unit_vector(), r.uniform(0, 6) * r.unit_vector()),
                 mb = moving(Vec3::Zero(),
                             r.chance(0.5) ? Vec3(r.uniform(0, 6) * r.unit_vector()) : Vec3(0, 0, 0));
    const TimeTruth t = judge_motion(a, ma, b, mb);
    INFO(i << " " << type_name(sa) << " " << type_name(sb) << " [" << t.t_lo << ", " << t.t_hi << "] "
           << t.note);
    hits += t.verdict == Hit::hit;
    none += t.verdict == Hit::none;
    undecided += t.verdict == Hit::undecided;
    const double clear_until = t.verdict == Hit::none ? 1 : t.t_lo;
    // Another way to compute the pose: the core's pose_at in double and the discrete judge.
    for (int k = 0; k < 100; ++k) {
      const double s = clear_until * (k + 0.5) / 100;
      const PairTruth g = judge_pair({&sa, pose_at(std::get<Pose>(a.pose), ma, s)},
                                     {&sb, pose_at(std::get<Pose>(b.pose), mb, s)});
      REQUIRE(g.gap.hi >= -1e-13);
      const Bracket h = gap_at(a, ma, b, mb, s);
      REQUIRE(h.lo <= g.gap.hi + 1e-13);
      REQUIRE(g.gap.lo <= h.hi + 1e-13);
    }
    if (t.verdict == Hit::hit) {
      REQUIRE(gap_at(a, ma, b, mb, t.t_hi).lo <= 0);
      REQUIRE(t.t_hi - t.t_lo <= 1e-6);
      REQUIRE(certified_depth_before(a, ma, b, mb, t.t_lo) == 0);
    }
    const Aabb box = outer_box(a, ma);
    for (int k = 0; k <= 20; ++k) {
      const Aabb inside = outer_box({&sa, pose_at(std::get<Pose>(a.pose), ma, k / 20.0)});
      REQUIRE((inside.lo.array() >= box.lo.array() - 1e-13).all());
      REQUIRE((inside.hi.array() <= box.hi.array() + 1e-13).all());
    }
  }
  WARN(cases << " motions: " << hits << " hit, " << none << " none, " << undecided << " undecided");
  REQUIRE(hits > cases * 3 / 10);
  REQUIRE(hits < cases * 7 / 10);
  REQUIRE(undecided <= 1);
}

TEST_CASE("certified depth is the deepest point of a passage", "[referee][motion]") {
  const Shape ball = Sphere{1};
  const double d =
      certified_depth_before(at(ball, {-5, 1.5, 0}), moving({10, 0, 0}), at(ball, {0, 0, 0}), rest, 1);
  REQUIRE(d <= 0.5);
  REQUIRE(d >= 0.5 - 1e-12);
  REQUIRE(certified_depth_before(at(ball, {-5, 1.5, 0}), moving({10, 0, 0}), at(ball, {0, 0, 0}), rest,
                                 0.3) == 0);
}

TEST_CASE("the depth of a passage through a mesh is that of one triangle", "[referee][motion]") {
  TriangleMesh m;
  m.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Shape floor = m, ball = Sphere{0.5}, die = Box{{1, 2, 0.5}}, ground = HalfSpace{{0, 0, 1}, 0};
  const Placed flat = at(floor, {0, 0, 0});
  // At most half its height; before that, the depth of the lowest point.
  const auto of_ball = [&](double t) {
    return deepest_before(flat, rest, at(ball, {3, 1, 2}), moving({0, 0, -4}), t);
  };
  REQUIRE(std::abs(of_ball(1).depth - 0.5) < 1e-9);
  REQUIRE(std::abs(of_ball(1).t - 0.5) < 1e-6);
  REQUIRE(of_ball(1).part_a == 0);
  REQUIRE(of_ball(0.375).depth == 0);
  REQUIRE(of_ball(0.4).depth == Approx(0.1));
  REQUIRE(certified_depth_before(at(ball, {3, 1, 2}), moving({0, 0, -4}), flat, rest, 0.4) == Approx(0.1));
  const Placed box = at(die, {-2, 1, 2});
  REQUIRE(gap_at(box, moving({0, 0, -4}), flat, rest, 0.45).hi == Approx(-0.3));
  REQUIRE(gap_at(box, moving({0, 0, -4}), flat, rest, 0.45).lo == Approx(-0.3));
  REQUIRE(gap_at(box, moving({0, 0, -4}), flat, rest, 0.95).lo == Approx(1.3));  // has left below
  REQUIRE(std::abs(certified_depth_before(box, moving({0, 0, -4}), flat, rest, 1) - 0.5) < 1e-9);
  // Past the border it can leave sideways: 0.25 of it is above the floor.
  REQUIRE(std::abs(certified_depth_before(at(die, {5.75, 1, 2}), moving({0, 0, -4}), flat, rest, 1) - 0.25) <
          1e-9);
  REQUIRE(gap_at(flat, moving({0, 0, -4}), at(ground, {0, 0, -2}), rest, 0.75).hi == Approx(-1));
  REQUIRE(certified_depth_before(at(ground, {0, 0, -2}), rest, flat, moving({0, 0, -4}), 1) == Approx(2));
}

TEST_CASE("a spinning body meets a mesh when it first meets one of its triangles", "[referee][motion]") {
  Rng r(81);
  int hits = 0;
  for (int i = 0; i < 40; ++i) {
    TriangleMesh whole;
    for (int k = 0; k < 6; ++k) {
      for (int j = 0; j < 3; ++j) whole.vertices.push_back(r.vector(0, 1));
      whole.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    const Shape body = random_convex(r, tested_kinds[r.below(std::size(tested_kinds))], 0.5);
    const Vec3 from = 3 * r.unit_vector();
    const Motion way = moving(-1.5 * from + r.vector(0, 0.5), r.vector(0, 6));
    const auto meets = [&](const TriangleMesh& m) {
      const Shape mesh = m;
      return judge_motion(at(body, from), way, at(mesh, Vec3::Zero()), rest);
    };
    double lo = 1, hi = 1;
    bool hit = false;
    for (const auto& t : whole.triangles) {
      const TimeTruth part = meets({whole.vertices, {t}});
      lo = std::min(lo, part.t_lo);
      if (part.verdict != Hit::hit) continue;
      hit = true;
      hi = std::min(hi, part.t_hi);
    }
    const TimeTruth all = meets(whole);
    REQUIRE((all.verdict == Hit::hit) == hit);
    if (!hit) continue;
    ++hits;
    REQUIRE(all.t_lo == lo);
    REQUIRE(all.t_hi == hi);
  }
  CHECK(hits > 10);
}

TEST_CASE("a rotating half-space: closed form for a ball, and a large box in its place",
          "[referee][motion]") {
  const Shape ground = HalfSpace{{0, 0, 2}, 0}, ball = Sphere{0.5};
  // The plane through the origin tips up towards a ball at (3, 0, 1): -3 sin(wt) + cos(wt) = 1/2.
  const double w = 0.7, expected = (std::acos(0.5 / std::sqrt(10.0)) - std::atan(3.0)) / -w;
  for (const Vec3& v : {Vec3(0, 0, 0), Vec3(5, -7, 9)}) {
    const TimeTruth t = judge_motion(at(ball, {3, 0, 1}), moving(v), at(ground, {0, 0, 0}),
                                     moving(v, {0, expected > 0 ? w : -w, 0}));
    require_hit(t, std::abs(expected), 1e-14);
    require_hit(judge_motion(at(ground, {0, 0, 0}), moving(v, {0, expected > 0 ? w : -w, 0}),
                             at(ball, {3, 0, 1}), moving(v)),
                std::abs(expected), 1e-14);
  }
  REQUIRE(
      judge_motion(at(ball, {3, 0, 1}), rest, at(ground, {0, 0, 0}), moving({0, 0, 0}, {0, 0, 8})).verdict ==
      Hit::none);
  Rng r(77);
  int hits = 0, none = 0, undecided = 0;
  const Shape slab = Box{{1000, 1000, 500}};
  for (int i = 0; i < 60; ++i) {
    const Shape x = random_convex(r, tested_kinds[i % 7]);
    const Quat q = r.rotation();
    const Vec3 up = rotation_matrix(q) * Vec3(0, 0, 1);
    const Placed a = at(x, r.uniform(1, 3) * up + r.vector(0, 1), r.rotation());
    const Motion ma = moving(r.vector(0, 1.5), r.vector(0, 3)), mb = moving(r.vector(0, 1), r.vector(0, 0.8));
    const Shape half = HalfSpace{{0, 0, 1}, 0.25};
    Hull lowered;  // the slab with its top at z = 1/4, about the same origin
    for (int k = 0; k < 8; ++k)
      lowered.vertices.emplace_back(k & 1 ? 1000 : -1000, k & 2 ? 1000 : -1000, k & 4 ? 0.25 : -1000);
    const Shape great = lowered;
    const TimeTruth t = judge_motion(a, ma, {&half, Pose{{0, 0, 0}, q}}, mb),
                    u = judge_motion(a, ma, {&great, Pose{{0, 0, 0}, q}}, mb);
    INFO(i << " " << type_name(x) << " [" << t.t_lo << ", " << t.t_hi << "] [" << u.t_lo << ", " << u.t_hi
           << "] " << t.note << u.note);
    undecided += t.verdict == Hit::undecided || u.verdict == Hit::undecided;
    if (t.verdict == Hit::undecided || u.verdict == Hit::undecided) continue;
    REQUIRE(t.verdict == u.verdict);
    hits += t.verdict == Hit::hit;
    none += t.verdict == Hit::none;
    if (t.verdict == Hit::hit) {
      REQUIRE(t.t_lo <= u.t_hi);
      REQUIRE(u.t_lo <= t.t_hi);
      REQUIRE(t.t_hi - t.t_lo < 1e-12);
    }
    for (double s : {0.0, 0.3, 1.0}) {
      const Bracket g = gap_at(a, ma, {&half, Pose{{0, 0, 0}, q}}, mb, s),
                    h = gap_at(a, ma, {&great, Pose{{0, 0, 0}, q}}, mb, s);
      REQUIRE(g.hi - g.lo < 1e-14);
      REQUIRE(g.lo <= h.hi);
      REQUIRE(h.lo <= g.hi);
    }
  }
  CAPTURE(undecided);
  REQUIRE(undecided <= 1);
  REQUIRE(hits >= 5);
  REQUIRE(none > 10);
}

TEST_CASE("two half-spaces in motion", "[referee][motion]") {
  const Shape up = HalfSpace{{0, 0, 1}, 0}, down = HalfSpace{{0, 0, -3}, 0},
              slanted = HalfSpace{{0, 1e-9, -1}, 0};
  const Placed a = at(up, {0, 0, 0}), b = at(down, {5, 5, 1});
  const auto judged = [&](const Motion& ma, const Motion& mb) { return judge_motion(a, ma, b, mb); };
  require_hit(judged(rest, moving({9, 9, -3})), 1.0 / 3, 1e-16);
  require_hit(judged(moving({0, 0, 1}), rest), 1, 0);
  require_hit(judged(moving({0, 0, 4}), rest), 0.25, 0);
  const TimeTruth clear = judged(moving({0, 0, 1 - 0x1p-53}), moving({0, 0, 0}, {0, 0, 7}));
  REQUIRE(clear.verdict == Hit::none);
  REQUIRE(clear.least_gap.lo <= 0x1p-53);
  REQUIRE(clear.least_gap.hi >= 0x1p-53);
  REQUIRE(clear.least_gap.hi < 0x1p-52);
  require_hit(judged(rest, moving({0, 0, 9}, {1e-300, 0, 0})), 0, 1e-300);
  require_hit(judge_motion(a, rest, at(slanted, {0, 0, 1}), rest), 0, 0);
  require_hit(judge_motion(a, rest, at(down, {0, 0, -1}), moving({0, 0, 9})), 0, 0);
  for (const auto& [t, gap] : {std::pair{0.25, 0.25}, std::pair{0.5, -0.5}}) {
    const Bracket g = gap_at(a, rest, b, moving({9, 9, -3}), t);
    REQUIRE(g.lo <= gap);
    REQUIRE(g.hi >= gap);
    REQUIRE(g.hi - g.lo <= 2.3e-16);
  }
}

TEST_CASE("the certified depth of a turning motion is that of a dense search, and never more",
          "[referee][motion]") {
  Rng r(501);
  int deep = 0;
  double worst = 0;
  for (int i = 0; i < 42; ++i) {
    const Shape sa = random_convex(r, tested_kinds[i % 7]), sb = random_convex(r, tested_kinds[i / 7 % 7]);
    const Placed a = at(sa, 1.2 * r.unit_vector(), r.rotation()), b = at(sb, Vec3::Zero(), r.rotation());
    const Vec3 p = std::get<Pose>(a.pose).translation;
    const Motion ma = moving(-2 * p + 0.5 * r.unit_vector(), r.uniform(0, 9) * r.unit_vector()),
                 mb = moving(Vec3::Zero(), r.uniform(0, 9) * r.unit_vector());
    const double d = certified_depth_before(a, ma, b, mb, 1);
    // Computed another way, with poses in double: samples 1/400 apart, plus the most that the depth can
    // change between them.
    double lo = 0, hi = 0;
    constexpr int n = 400;
    for (int k = 0; k <= n; ++k) {
      const double s = k / static_cast<double>(n);
      const PairTruth g = judge_pair({&sa, pose_at(std::get<Pose>(a.pose), ma, s)},
                                     {&sb, pose_at(std::get<Pose>(b.pose), mb, s)});
      lo = std::max(lo, -g.gap.hi);
      hi = std::max(hi, -g.gap.lo);
    }
    const double rate =
        ma.linear.norm() + ma.angular.norm() * bounding_radius(sa) + mb.angular.norm() * bounding_radius(sb);
    INFO(i << " " << type_name(sa) << " " << type_name(sb) << " " << d << " " << lo);
    REQUIRE(d <= std::max(hi, 0.0) + rate / (2 * n) + 1e-12);
    worst = std::max(worst, lo - d);
    deep += d > 0.01;
  }
  CAPTURE(worst);
  CHECK(worst <= 1e-4);
  REQUIRE(deep > 20);
}
