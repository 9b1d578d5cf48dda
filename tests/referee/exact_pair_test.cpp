// The exact level by itself: each verdict on bodies whose distance is known, the point or plane that shows
// it, and when 512-bit integers are not enough.
#include <cmath>

#include "oracles/referee/exact/exact_pair.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

using namespace touchstone::referee;

std::vector<Vec3> corners(double x, double y, double z) {
  std::vector<Vec3> v;
  for (int k = 0; k < 8; ++k) v.emplace_back(k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z);
  return v;
}

ExactBody body(std::vector<Vec3> core, double radius, const Vec3& at, const Quat& turn = {}) {
  ExactBody b;
  b.core = std::move(core);
  b.radius = radius;
  b.pose = Pose{at, turn};
  return b;
}
ExactBody box(const Vec3& at, const Quat& turn = {}) { return body(corners(1, 1, 1), 0, at, turn); }
ExactBody ball(double radius, const Vec3& at) { return body({Vec3::Zero()}, radius, at); }
ExactBody rod(double radius, const Vec3& at, const Quat& turn = {}) {
  return body({{0, 0, -2}, {0, 0, 2}}, radius, at, turn);
}

struct Known {
  const char* name;
  ExactBody a, b;
  double core_distance;  // 0: the cores meet
};

std::vector<Known> known_pairs() {
  return {{"boxes that share a corner", box({0, 0, 0}), box({2, 2, 2}), 0},
          {"boxes that share a face", box({0, 0, 0}), box({2, 0.5, 0.25}), 0},
          {"boxes 2^-52 apart", box({0, 0, 0}), box({2 + 0x1p-51, 0, 0}), 0x1p-51},
          {"boxes 2^-52 deep", box({0, 0, 0}), box({2 - 0x1p-52, 0, 0}), 0},
          {"faces", box({0, 0, 0}), box({5, 0.5, 0}), 3},
          {"crossed edges", box({0, 0, 0}), box({5, 4, 0.5}), std::sqrt(13)},
          {"corners", box({0, 0, 0}), box({3, 4, 4}), 3},
          {"a corner and a ball, apart", box({0, 0, 0}), ball(2.5, {3, 3, 2}), 3},
          {"a corner and a ball, touching", box({0, 0, 0}), ball(3, {3, 3, 2}), 3},
          {"a corner and a ball, overlapping", box({0, 0, 0}), ball(3.5, {3, 3, 2}), 3},
          {"a face and a ball, touching", box({0, 0, 0}), ball(3, {0.25, 4, 0.5}), 3},
          {"balls, touching", ball(1, {0, 0, 0}), ball(2, {2, 2, 1}), 3},
          {"concentric balls", ball(1, {1, 2, 3}), ball(2, {1, 2, 3}), 0},
          {"crossed rods, touching", rod(1, {0, 0, 0}), rod(2, {0, 3, 0}, {0, 1, 0, 1}), 3},
          {"crossed rods, the cores meet", rod(1, {0, 0, 0}), rod(2, {0, 0, 0}, {0, 1, 0, 1}), 0},
          {"a box turned by a quaternion that is not unit", box({0, 0, 0}), box({5, 0, 0}, {3, 0, 0, 4}), 3}};
}

/// Interior: the origin is inside the tetrahedron of a simplex, so four corners are needed.
Known interior() { return {"interior", box({0, 0, 0}), box({0.5, 0.25, 0.125}, {0.1, 0.2, 0.3, 1}), 0}; }

bool is_in_box(const Rational3& x) {  // |x| <= 1
  for (int k = 0; k < 3; ++k)
    if (x[k] > 1 || x[k] < -1) return false;
  return true;
}

// Distances compared without rounding: the core distance of each pair above squared is an integer or tiny.
bool overlaps(const Known& k) { return k.core_distance <= k.a.radius + k.b.radius; }

void check_verdict(const Known& k, const ExactVerdict& v) {
  CHECK(v.overlap == overlaps(k));
  // The flag is for rounded shapes at a positive distance of their cores only.
  CHECK(v.touching == (k.core_distance > 0 && k.core_distance == k.a.radius + k.b.radius));
  REQUIRE_FALSE(v.simplex.empty());
  CHECK(v.simplex.size() <= 4);
}

}  // namespace

TEST_CASE("exact pair: decided, with every seed, in long and in short integers", "[referee][exact]") {
  for (const Known& k : known_pairs()) {
    INFO(k.name);
    const ExactPair p = make_exact(k.a, k.b);
    const int last_a = static_cast<int>(k.a.core.size()) - 1, last_b = static_cast<int>(k.b.core.size()) - 1;
    const std::vector<IndexPair> other{{last_a, last_b}}, repeated{{0, 0}, {0, 0}, {last_a, 0}, {0, 0}},
        whole{{0, 0}, {last_a, 0}, {0, last_b}, {last_a, last_b}};
    for (const std::vector<IndexPair>& seed : {std::vector<IndexPair>{}, other, repeated, whole}) {
      check_verdict(k, decide(p, seed));
      if (const auto s = decide_short(k.a, k.b, seed)) check_verdict(k, *s);
    }
    // A translation with a last bit of 2^-51 needs more than 60 bits.
    const double x = 0x1p40 * std::get<Pose>(k.b.pose).translation.x();
    CHECK(decide_short(k.a, k.b, {}).has_value() == (x == std::round(x)));
  }
  CHECK(decide(make_exact(interior().a, interior().b), {}).overlap);
}

TEST_CASE("exact pair: nearest points give the distance of the cores", "[referee][exact]") {
  for (const Known& k : known_pairs()) {
    INFO(k.name);
    const ExactVerdict v = nearest(make_exact(k.a, k.b), {});
    check_verdict(k, v);
    CHECK(static_cast<double>(v.core_distance) == Approx(k.core_distance).epsilon(4e-16));
    if (k.core_distance == 0) continue;
    const Real3 n = direction_of(v);
    CHECK(static_cast<double>(n.x * n.x + n.y * n.y + n.z * n.z) == Approx(1).epsilon(1e-17));
    // B to A: the centre of A is at the origin.
    const Vec3 at = std::get<Pose>(k.b.pose).translation;
    CHECK(static_cast<double>(n.x) * at.x() + static_cast<double>(n.y) * at.y() +
              static_cast<double>(n.z) * at.z() <
          0);
  }
}

TEST_CASE("exact pair: overlap is shown by a point in both bodies", "[referee][exact]") {
  std::vector<Known> pairs = known_pairs();
  pairs.push_back(interior());
  std::size_t sizes[5] = {0, 0, 0, 0, 0};
  for (const Known& k : pairs) {
    if (!overlaps(k)) continue;
    INFO(k.name);
    const ExactPair p = make_exact(k.a, k.b);
    const ExactVerdict v = decide(p, {});
    REQUIRE(v.overlap);
    ++sizes[v.simplex.size()];
    const Rational3 x = common_point(p, v);
    const auto within = [&](const ExactBody& b) {
      const Rational3 from = x - exact(std::get<Pose>(b.pose).translation);
      const Rational radius = exact(b.radius);
      if (b.core.size() == 1) return dot(from, from) <= radius * radius;
      if (b.core.size() == 8 && std::get<Pose>(b.pose).rotation == Quat{}) return is_in_box(from);
      return true;  // turned bodies and rods: covered by the other one
    };
    CHECK(within(k.a));
    CHECK(within(k.b));
  }
  // Every dimension of the nearest face has been met.
  CHECK(sizes[1] + sizes[2] + sizes[3] + sizes[4] == 11);
  CHECK(sizes[1] > 0);
  CHECK(sizes[4] > 0);
}

TEST_CASE("exact pair: apart is shown by a plane strictly between", "[referee][exact]") {
  // The last two are nearer to each other than a double resolves their balls.
  std::vector<Known> pairs = known_pairs();
  pairs.push_back(
      {"balls 2^-60 apart", ball(1, {0, 0, 0}), ball(1, {2, 0x1p-29, 0}), std::hypot(2, 0x1p-29)});
  int planes = 0;
  for (const Known& k : pairs) {
    const ExactPair p = make_exact(k.a, k.b);
    const ExactVerdict v = decide(p, {});
    if (v.overlap) continue;
    INFO(k.name);
    ++planes;
    const ExactPlane plane = separating_plane(p, v);
    const Rational length_sq = dot(plane.direction, plane.direction);
    // The support of core ⊕ ball on each side: (offset − d·x)² against r²|d|².
    const auto check = [&](const ExactBody& b, int side) {
      if (std::get<Pose>(b.pose).rotation != Quat{}) return;
      for (const Vec3& c : b.core) {
        const Rational3 x = exact(c) + exact(std::get<Pose>(b.pose).translation);
        const Rational room = Rational(side) * (dot(plane.direction, x) - plane.offset);
        CHECK(room >= 0);
        CHECK(room * room >= exact(b.radius) * exact(b.radius) * length_sq);
        if (side > 0) CHECK(room * room > exact(b.radius) * exact(b.radius) * length_sq);
      }
    };
    check(k.a, -1);
    check(k.b, 1);
  }
  CHECK(planes == 7);
}

TEST_CASE("exact pair: motion is the hull over all times, placements need not be rotations",
          "[referee][exact]") {
  // A ball that passes through a box between its two times overlaps in its hull, at neither end.
  ExactBody moving = ball(0.5, {-4, 0, 0});
  moving.velocity_to = {8, 0, 0};
  moving.times = {0, 1};
  CHECK(decide(make_exact(box({0, 0, 0}), moving), {}).overlap);
  moving.times = {0, 0.25};
  CHECK_FALSE(decide(make_exact(box({0, 0, 0}), moving), {}).overlap);
  moving.times = {0, 0.3125};  // arrives at −1.5
  CHECK(decide(make_exact(box({0, 0, 0}), moving), {}).touching);
  moving.velocity_from = {8, 0, 0};
  CHECK_FALSE(decide(make_exact(box({0, 0, 0}), moving), {}).overlap);
  // A cube stretched to half extents 3, 1, 1/4.
  ExactBody stretched = box({0, 0, 0});
  Placement place;
  place.matrix.diagonal() = Vec3(3, 1, 0.25);
  place.translation = {4, 0, 0};
  stretched.pose = place;
  CHECK(decide(make_exact(box({0, 0, 0}), stretched), {}).overlap);
  std::get<Placement>(stretched.pose).translation = {4 + 0x1p-50, 0, 0};
  const ExactVerdict v = nearest(make_exact(box({0, 0, 0}), stretched), {});
  CHECK_FALSE(v.overlap);
  CHECK(static_cast<double>(v.core_distance) == 0x1p-50);
}

TEST_CASE("exact pair: short integers refuse motion and numbers that are too long", "[referee][exact]") {
  const ExactBody a = box({0, 0, 0});
  CHECK(decide_short(a, box({3, 0, 0}), {}).has_value());
  ExactBody moving = box({3, 0, 0});
  moving.velocity_to = {1, 0, 0};
  CHECK_FALSE(decide_short(a, moving, {}).has_value());
  CHECK_FALSE(decide_short(moving, a, {}).has_value());
  // Parts longer than 200 bits, and parts that fit while their sum on one grid does not.
  CHECK_FALSE(decide_short(a, box({3, 0, 0}, {0.1, 0x1p-60 / 3, 0.3, 1}), {}).has_value());
  CHECK_FALSE(decide_short(a, box({3, 0x1p-80, 0}), {}).has_value());
  CHECK(decide(make_exact(a, box({3, 0x1p-80, 0})), {}).overlap == false);
  // The same placement as a matrix.
  ExactBody placed = box({0, 0, 0});
  placed.pose = Placement{Mat3::Identity(), {1.5, 0, 0}};
  const auto s = decide_short(a, placed, {});
  REQUIRE(s);
  CHECK(s->overlap);
}

TEST_CASE("exact half-space: above, touching, below, and numbers that are too long", "[referee][exact]") {
  const auto ask = [](double height, double offset = 0, const Vec3& normal = {0, 0, 1}) {
    return overlaps_half_space_short(normal, offset, Pose{}, box({0, 0, height}));
  };
  CHECK(ask(1 + 0x1p-30) == false);
  CHECK(ask(1) == true);
  CHECK(ask(0.5) == true);
  CHECK(ask(-9) == true);
  // The offset is in units of the normal's length: {z : 2 z <= 3}.
  CHECK(ask(2.5, 3, {0, 0, 2}) == true);
  CHECK(ask(2.5 + 0x1p-20, 3, {0, 0, 2}) == false);
  // A ball at distance 5 from an oblique plane.
  CHECK(overlaps_half_space_short({0, 3, 4}, 0, Pose{}, ball(5, {0, 3, 4})) == true);
  CHECK(overlaps_half_space_short({0, 3, 4}, 0, Pose{}, ball(5 - 0x1p-20, {0, 3, 4})) == false);
  // A plane turned by a right angle: its normal is −y.
  CHECK(overlaps_half_space_short({0, 0, 1}, 0, Pose{Vec3::Zero(), {1, 0, 0, 1}}, ball(1, {0, -2, 0})) ==
        false);
  CHECK(overlaps_half_space_short({0, 0, 1}, 0, Pose{Vec3::Zero(), {1, 0, 0, 1}}, ball(1, {0, -1, 0})) ==
        true);
  CHECK_FALSE(ask(0x1p-80).has_value());
  CHECK_FALSE(ask(3, 0x1p-200).has_value());
  CHECK_FALSE(ask(3, 0x1p200).has_value());
}

}  // namespace touchstone::referee_test
