// `touchstone check`: the checker accepts the referee's certificates after a round trip through JSON, and
// refuses them with any number changed so that the claim is false.
#include <functional>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "oracles/checker/checker.h"
#include "scenarios/codec/value_codec.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

namespace touchstone::referee_test {
namespace {

Certificate stored(const Certificate& c) {
  return certificate_from_json(test::parsed<nlohmann::ordered_json>(to_json(c).dump()));
}

Pose random_pose(Rng& r, double spread) {
  Pose p;
  p.translation = r.vector(0, spread);
  p.rotation = r.rotation();
  return p;
}

}  // namespace

TEST_CASE("every certificate of a pair in general position is accepted after a round trip through JSON",
          "[referee][checker]") {
  Rng r(41);
  int planes = 0, points = 0, depths = 0, refused_points = 0, refused_depths = 0, loose = 0;
  for (int i = 0; i < 490; ++i) {
    const Shape x = random_convex(r, tested_kinds[i % 7]), y = random_convex(r, tested_kinds[i / 7 % 7]);
    const Pose px = random_pose(r, 0.5), py = random_pose(r, 0.9);
    const Placed a{&x, px}, b{&y, py};
    const PairTruth t = judge_pair(a, b);
    if (t.verdict == Verdict::undecided) continue;
    const Certificate c = stored(checkable_certificate(t, a, b));
    if (t.verdict == Verdict::disjoint) {
      REQUIRE(checker::check(c, a, b));
      REQUIRE_FALSE(checker::check(c, b, a));
      ++planes;
      continue;
    }
    ++points;
    refused_points += !checker::check(c, a, b);
    const Certificate lower = stored(depth_certificate(t, a, b));
    refused_depths += !checker::check(lower, a, b);
    Certificate upper;
    upper.kind = Certificate::Kind::depth_direction;
    upper.direction = t.normal;
    upper.offset = -t.gap.lo;
    REQUIRE(checker::check(stored(upper), a, b));
    REQUIRE(lower.offset <= upper.offset);
    // The two bounds meet: depth is proven from both sides to rounding (or to the width of the bracket).
    // Where symmetry has closed the bracket, the polytope is coarse.
    loose += upper.offset - lower.offset > t.gap.hi - t.gap.lo + 1e-13;
    ++depths;
    // Claims slightly beyond the truth are refused.
    const double beyond = 1e-12 + (t.gap.hi - t.gap.lo);
    upper.offset = -t.gap.hi - beyond;
    REQUIRE_FALSE(checker::check(upper, a, b));
    Certificate more = lower;
    more.offset = -t.gap.lo + beyond;
    REQUIRE_FALSE(checker::check(more, a, b));
  }
  CAPTURE(planes, points, depths, loose);
  CHECK(refused_points == 0);
  CHECK(refused_depths == 0);
  CHECK(loose < depths / 5);
  REQUIRE(planes > 100);
  REQUIRE(points > 200);
}

TEST_CASE("a plane through a touching pair is refused with any number changed", "[referee][checker]") {
  // B is one ulp away from touching: no other plane with these directions fits.
  const Shape box = Box{{1, 2, 3}};
  const Placed a{&box, Pose{{0, 0, 0}, {}}}, b{&box, Pose{{2 + 0x1p-51, 0, 0}, {}}};
  const Certificate c = stored(checkable_certificate(judge_pair(a, b), a, b));
  REQUIRE(c.kind == Certificate::Kind::separating_plane);
  REQUIRE(checker::check(c, a, b));
  std::vector<double> n{1, 0, 0, 1};
  const auto plane = [&](const std::vector<double>& v) {
    Certificate d;
    d.kind = Certificate::Kind::separating_plane;
    d.direction = {v[0], v[1], v[2]};
    d.offset = v[3];
    return d;
  };
  REQUIRE(checker::check(stored(plane(n)), a, b));
  for (std::size_t i = 0; i < n.size(); ++i)
    for (double by : {-1e-15, 1e-15, 1.0, -3.0}) {
      auto m = n;
      m[i] += by;
      REQUIRE_FALSE(checker::check(stored(plane(m)), a, b));
    }
}

TEST_CASE("planes of cylinder, cone and ellipsoid are decided through their square roots",
          "[referee][checker]") {
  Rng r(43);
  int held = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    const Shape x = random_convex(r, tested_kinds[4 + i % 3]), dot_shape = Sphere{0};
    const Pose p = random_pose(r, 1);
    const Vec3 n = r.unit_vector();
    const Vec3 s = world_support(x, p, n);
    const double top = n.dot(s);
    for (double slack : {1e-14, -1e-14}) {
      Certificate c;
      c.kind = Certificate::Kind::separating_plane;
      c.direction = n;
      c.offset = top + slack;
      const Placed a{&x, p}, b{&dot_shape, Pose{s + n, {}}};
      REQUIRE(checker::check(stored(c), a, b) == (slack > 0));
      ++(slack > 0 ? held : refused);
    }
  }
  REQUIRE(held == 600);
  REQUIRE(refused == 600);
}

TEST_CASE("the one common point of two touching bodies is refused with any coordinate changed",
          "[referee][checker]") {
  const Shape ball = Sphere{1}, drum = Cylinder{1, 2}, top = Cone{3, 2}, egg = Ellipsoid{{1, 2, 3}};
  const Shape half = HalfSpace{{0, 0, 1}, 0};
  struct Touch {
    const Shape *a, *b;
    Vec3 at, point;
  };
  const Touch touching[] = {{&ball, &drum, {2, 0, 0}, {1, 0, 0}},
                            {&ball, &top, {0, 0, -3}, {0, 0, -1}},
                            {&egg, &ball, {0, 3, 0}, {0, 2, 0}},
                            {&half, &ball, {0, 0, 1}, {0, 0, 0}},
                            {&half, &egg, {0, 0, 3}, {0, 0, 0}}};
  int changed = 0;
  for (const Touch& t : touching) {
    const Placed a{t.a, Pose{{0, 0, 0}, {}}}, b{t.b, Pose{t.at, {}}};
    Certificate c;
    c.kind = Certificate::Kind::common_point;
    c.point = t.point;
    REQUIRE(checker::check(stored(c), a, b));
    for (int k = 0; k < 3; ++k)
      for (double by : {0x1p-51, -0x1p-51, 0.5, -7.0}) {
        Certificate d = c;
        d.point[k] += by;
        REQUIRE_FALSE(checker::check(stored(d), a, b));
        ++changed;
      }
  }
  REQUIRE(changed == 60);
}

TEST_CASE("a common point of a flat ellipsoid lies in its plane", "[referee][checker]") {
  const Shape flat = Ellipsoid{{1, 2, 0}}, ball = Sphere{1};
  const Placed a{&flat, Pose{{0, 0, 0}, {}}}, b{&ball, Pose{{0, 1.5, 0}, {}}};
  Certificate c;
  c.kind = Certificate::Kind::common_point;
  c.point = {0, 1, 0};
  REQUIRE(checker::check(c, a, b));
  c.point = {0, 1, 0x1p-60};
  REQUIRE_FALSE(checker::check(c, a, b));
  c.point = {0.9, 1.5, 0};  // beyond the ellipse
  REQUIRE_FALSE(checker::check(c, a, b));
}

TEST_CASE("an inner polytope is refused when a point, a facet or the depth is changed",
          "[referee][checker]") {
  const Shape box = Box{{1, 2, 3}}, other = Box{{1, 1, 1}};
  const Placed a{&box, Pose{{0, 0, 0}, {}}}, b{&other, Pose{{0.5, 0.25, 0.125}, {0.1, 0.2, 0.3, 1}}};
  const Certificate c = stored(depth_certificate(judge_pair(a, b), a, b));
  REQUIRE(c.kind == Certificate::Kind::inner_polytope);
  REQUIRE(c.facets.size() >= 4);
  REQUIRE(checker::check(c, a, b));
  const auto refused = [&](const std::function<void(Certificate&)>& change) {
    Certificate d = c;
    change(d);
    try {
      return !checker::check(stored(d), a, b);
    } catch (const InputError&) {
      return true;  // not even read
    }
  };
  int changed = 0;
  for (std::size_t i = 0; i < c.support_pairs.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side)
      for (int k = 0; k < 3; ++k) {
        // Away from the body that must contain it.
        const Vec3 centre = side == 0 ? Vec3(0, 0, 0) : Vec3(0.5, 0.25, 0.125);
        REQUIRE(refused([&](Certificate& d) {
          double& x = d.support_pairs[i][side][k];
          x = centre[k] + (x < centre[k] ? -8 : 8);
        }));
        ++changed;
      }
  for (std::size_t i = 0; i < c.facets.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      for (int to : {-1, static_cast<int>(c.support_pairs.size()), (c.facets[i][k] + 1) % 4}) {
        if (to == c.facets[i][0] || to == c.facets[i][1] || to == c.facets[i][2]) continue;
        REQUIRE(refused([&](Certificate& d) { d.facets[i][k] = to; }));
        ++changed;
      }
    REQUIRE(refused([&](Certificate& d) { std::swap(d.facets[i][0], d.facets[i][1]); }));
    REQUIRE(
        refused([&](Certificate& d) { d.facets.erase(d.facets.begin() + static_cast<std::ptrdiff_t>(i)); }));
  }
  REQUIRE(refused([](Certificate& d) { d.facets.clear(); }));
  Certificate none = c;
  none.support_pairs.clear();
  REQUIRE_FALSE(checker::check(none, a, b));
  REQUIRE(refused([](Certificate& d) { d.offset += 1e-13; }));
  REQUIRE(refused([](Certificate& d) { d.offset = std::numeric_limits<double>::max(); }));
  REQUIRE(changed > 60);
}

TEST_CASE("a mesh is apart when each triangle has a plane, and not when one lacks it", "[referee][checker]") {
  // A tent over the ball: no single plane separates.
  const Shape tent = TriangleMesh{{{-3, -3, 0}, {3, -3, 0}, {0, -3, 3}, {-3, 3, 0}, {3, 3, 0}, {0, 3, 3}},
                                  {{0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}}};
  const Shape ball = Sphere{1};
  const Placed a{&tent, Pose{}}, b{&ball, Pose{{0, 0, 1}, {}}};
  const PairTruth t = judge_pair(a, b);
  REQUIRE(t.verdict == Verdict::disjoint);
  const Certificate c = stored(checkable_certificate(t, a, b));
  REQUIRE(c.rationals.size() >= 8);
  REQUIRE(checker::check(c, a, b));
  for (std::size_t i = 0; i < c.rationals.size(); ++i) {
    Certificate d = c;
    d.rationals.erase(d.rationals.begin() + static_cast<std::ptrdiff_t>(i));
    REQUIRE_FALSE(checker::check(d, a, b));
  }
  Certificate half = c;
  half.rationals.resize(4);
  REQUIRE_FALSE(checker::check(half, a, b));
  Certificate no = c;
  no.rationals[0] = "1/0";
  REQUIRE_THROWS_AS(checker::check(no, a, b), InputError);
}

TEST_CASE("depth in a half-space is certified from both sides", "[referee][checker]") {
  Rng r(47);
  int checked = 0;
  for (int i = 0; i < 400; ++i) {
    const Shape h = HalfSpace{r.unit_vector(), r.uniform(-0.2, 0.2)};
    const Shape x = random_convex(r, tested_kinds[i % 7]);
    const Pose ph = random_pose(r, 0.2), px = random_pose(r, 0.3);
    const Placed plane{&h, ph}, body{&x, px};
    const bool first = r.chance(0.5);
    const Placed &a = first ? plane : body, &b = first ? body : plane;
    const PairTruth t = judge_pair(a, b);
    if (t.verdict == Verdict::undecided) continue;
    REQUIRE(checker::check(stored(checkable_certificate(t, a, b)), a, b));
    if (t.verdict != Verdict::overlap) continue;
    Certificate upper;
    upper.kind = Certificate::Kind::depth_direction;
    upper.direction = t.normal;
    upper.offset = width(a, b, t.normal).hi;
    REQUIRE(upper.offset <= -t.gap.lo * (1 + 1e-15));
    REQUIRE(checker::check(stored(depth_certificate(t, a, b)), a, b));
    REQUIRE(checker::check(stored(upper), a, b));
    Certificate more = stored(depth_certificate(t, a, b));
    more.offset += 1e-13;
    upper.offset -= 1e-13;
    REQUIRE_FALSE(checker::check(more, a, b));
    REQUIRE_FALSE(checker::check(upper, a, b));
    ++checked;
  }
  REQUIRE(checked > 100);
}

TEST_CASE("what is not a certificate is bad input", "[referee][checker]") {
  for (const char* text : {R"({})", R"({"kind": "hearsay"})", R"({"kind": "common_point", "point": [1, 2]})",
                           R"({"kind": "common_point", "point": [1, 2, "x"]})",
                           R"({"kind": "separating_plane", "direction": [1, 0, 0]})",
                           R"({"kind": "inner_polytope", "offset": 1})"})
    REQUIRE_THROWS_AS(certificate_from_json(test::parsed<nlohmann::ordered_json>(text)), InputError);
}

TEST_CASE("a rational has a denominator of 1 or more, lowest terms or not, and a bounded length",
          "[referee][checker]") {
  const Shape ball = Sphere{1};
  const Placed a{&ball, Pose{}}, b{&ball, Pose{}};
  const auto point = [](const std::string& x) {
    Certificate c;
    c.kind = Certificate::Kind::common_point;
    c.rationals = {x, "0", "0"};
    return c;
  };
  for (const char* good : {"1", "0", "-1", "-0", "2/4", "-3/6", "8/8", "0/5"})
    CHECK(checker::check(point(good), a, b));
  CHECK_FALSE(checker::check(point("9/8"), a, b));
  const std::string digits(50'001, '1');
  for (const std::string& bad :
       {std::string("-1/-2"), std::string("1/-0"),  std::string("1/-1"), std::string("1/0"),
        std::string("1/00"),  std::string("01"),    std::string("1/01"), std::string("--1"),
        std::string("1//2"),  std::string("1/2/3"), std::string(),       std::string("/"),
        std::string("/1"),    std::string("1/"),    std::string("-"),    std::string("+1"),
        std::string(" 1"),    std::string("1.5"),   std::string("0x1"),  digits,
        "1/" + digits}) {
    INFO(bad.substr(0, 10));
    CHECK_THROWS_AS(checker::check(point(bad), a, b), InputError);
  }
  nlohmann::ordered_json many = {{"kind", "separating_plane"}};
  for (int i = 0; i < 44; ++i) many["rationals"].push_back(std::string(49'000, '7'));
  CHECK_THROWS_AS(certificate_from_json(many), InputError);
}

}  // namespace touchstone::referee_test
