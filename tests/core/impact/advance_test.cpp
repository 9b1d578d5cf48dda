// Conservative advancement in extended precision: each way in which it ends, and the time of contact against
// a closed form.
#include <numbers>

#include "core/impact/advance.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::impact;

namespace {

MovingCore moving(const Shape& s, const Vec3& at, const Vec3& linear, const Vec3& angular = Vec3::Zero(),
                  const Quat& turn = {}) {
  return moving_core(narrow::make_core(s, wide_frame({at, turn})), {linear, angular});
}

const Shape cube = Box{{1, 1, 1}}, ball = Sphere{0.5}, rod = Capsule{0.125, 2}, drum = Cylinder{1, 1};
const narrow::WidePlane floor_plane{WideVec::UnitZ(), 0};

// A rod along x that turns about z reaches a ball at (x, y) when the ball's centre is 0.625 from its axis.
double time_of_rod(double x, double y, double speed) {
  return (std::atan2(y, x) - std::asin(0.625 / std::hypot(x, y))) / speed;
}
MovingCore turning_rod(double speed) {
  return moving(rod, Vec3::Zero(), Vec3::Zero(), {0, 0, speed}, {0, 1, 0, 1});
}

}  // namespace

TEST_CASE("advance: a hit at the time of contact", "[impact][advance]") {
  SECTION("a ball onto the face of a box, at a time that is a double") {
    const Advance x =
        advance(moving(ball, {-4, 0.25, 0.5}, {5, 0, 0}), moving(cube, {0, 0, 0}, {0, 0, 0}), 0, {1, 1e-14});
    REQUIRE(x.answer.toi);
    CHECK(*x.answer.toi == 0.5);
    CHECK(x.answer.outcome == Outcome::answered);
    CHECK_FALSE(x.gap_opened);
    CHECK(x.answer.normal_ab == Vec3(1, 0, 0));
    for (const Vec3& w : x.answer.witness_w) CHECK((w - Vec3(-1, 0.25, 0.5)).norm() <= 1e-14);
  }
  SECTION("a turning rod onto a ball") {
    for (const double speed : {1.0, 1.25, 40.0}) {
      const double t = time_of_rod(0, 1.5, speed);
      const Advance x = advance(turning_rod(speed), moving(ball, {0, 1.5, 0}, {0, 0, 0}), 0, {1, 1e-13});
      REQUIRE((x.answer.toi.has_value() == (t <= 1)));
      if (x.answer.toi) CHECK(*x.answer.toi == Approx(t).epsilon(1e-13));
    }
  }
  SECTION("a tumbling box onto a plane") {
    // A face down at the end of a quarter turn; a corner of the cube, √2 from its axis, comes first.
    const Advance x = advance(moving(cube, {0, 0, 1.25}, {0, 0, 0}, {std::numbers::pi / 2, 0, 0}),
                              floor_plane, 0, {1, 1e-14});
    REQUIRE(x.answer.toi);
    const double angle = std::acos(1.25 / std::sqrt(2.0));
    CHECK(*x.answer.toi == Approx((std::numbers::pi / 4 - angle) / (std::numbers::pi / 2)).epsilon(1e-13));
    CHECK(x.answer.normal_ab == Vec3(0, 0, -1));
  }
}

TEST_CASE("advance: without contact it is clear to the end", "[impact][advance]") {
  for (const Wide end : {Wide(1), Wide(0.25)}) {
    const Goal goal{end, 1e-14};
    for (const Advance& x :
         {advance(moving(ball, {-4, 0, 0}, {2.25, 0, 0}), moving(cube, {0, 0, 0}, {0, 0, 0}), 0, goal),
          advance(turning_rod(1), moving(ball, {1, -1, 0}, {0, 0, 0}), 0, goal),
          advance(moving(cube, {0, 0, 1.5}, {0, 0, 0}, {1, 2, 3}, {1, 2, 3, 4}),
                  narrow::WidePlane{WideVec::UnitZ(), -1}, 0, goal)}) {
      CHECK(x.answer.outcome == Outcome::answered);
      CHECK_FALSE(x.answer.toi);
      CHECK_FALSE(x.gap_opened);
      CHECK(x.answer.clear_until == static_cast<double>(end));
      CHECK(x.answer.separation > 0);
    }
  }
  // At the end of the step its gap is the distance that is left.
  const Advance x =
      advance(moving(ball, {-4, 0, 0}, {2.25, 0, 0}), moving(cube, {0, 0, 0}, {0, 0, 0}), 0, {1, 1e-14});
  CHECK(x.answer.separation == Approx(0.25).epsilon(1e-15));
}

TEST_CASE("advance: a gap that has opened returns to double", "[impact][advance]") {
  const double slight = 0x1p-40, leave = 1e-9;
  const Goal goal{1, 1e-14, Wide(leave)};
  SECTION("a turning rod recedes from a ball") {
    const Advance x = advance(turning_rod(6), moving(ball, {1, -0.625 - slight, 0}, {0, 0, 0}), 0, goal);
    REQUIRE(x.gap_opened);
    CHECK_FALSE(x.answer.toi);
    CHECK(x.answer.outcome == Outcome::answered);
    CHECK(x.answer.separation > leave);
    const double angle = 6 * x.answer.clear_until;
    const double gap = std::sin(angle) - (0.625 + slight) * (1 - std::cos(angle)) + slight;
    CHECK(x.answer.separation == Approx(gap).epsilon(1e-6));
  }
  SECTION("the corner of a tumbling box leaves a plane") {
    const Quat eighth{std::sin(std::numbers::pi / 8), 0, 0, std::cos(std::numbers::pi / 8)};
    const Advance x = advance(moving(cube, {0, 0, std::sqrt(2.0) + slight}, {0, 0, 0}, {9, 0, 0}, eighth),
                              floor_plane, 0, goal);
    REQUIRE(x.gap_opened);
    CHECK_FALSE(x.answer.toi);
    CHECK(x.answer.separation > leave);
    const double half = std::sin(9 * x.answer.clear_until / 2);
    CHECK(x.answer.separation == Approx(std::sqrt(8.0) * half * half + slight).epsilon(1e-6));
  }
}

TEST_CASE("advance: not converged when time has no finer resolution", "[impact][advance]") {
  // In the last bit of t, the rod's surface travels farther than the gap that counts as contact.
  const double speed = 0x1p30;
  // A ball one radian ahead of the rod at t = 0.5, at distance 1.5 from its axis.
  const double ahead = static_cast<double>(std::fmod(0x1p29L, 2 * std::numbers::pi_v<long double>)) + 1;
  const Advance x =
      advance(turning_rod(speed), moving(ball, Vec3(std::cos(ahead), std::sin(ahead), 0) * 1.5, {0, 0, 0}),
              0.5, {1, 1e-14});
  CHECK(x.answer.outcome == Outcome::not_converged);
  CHECK_FALSE(x.answer.toi);
  // Half a turn is 3e-9: clear as far as the rod gets, to a double.
  const double contact = (1 - std::asin(0.625 / 1.5)) / speed;
  CHECK(x.answer.clear_until >= 0.5);
  CHECK(x.answer.clear_until - 0.5 == Approx(contact).margin(0x1p-52));
  CHECK(x.answer.separation > 0);
  CHECK(x.answer.separation < 1e-6);
}

TEST_CASE("advance: not converged when the steps run out", "[impact][advance]") {
  // A drum that turns about its own axis just above a plane: nothing changes, but the bound on how far a body
  // turns does not know about its roundness. A step is about √(2 gap)/|ω|.
  const double gap = 0x1p-40;
  const Advance x = advance(moving(drum, {0, 0, 1 + gap}, {0, 0, 0}, {0, 1e4, 0}, {1, 0, 0, 1}), floor_plane,
                            0, {1, 1e-14});
  CHECK(x.answer.outcome == Outcome::not_converged);
  CHECK_FALSE(x.answer.toi);
  CHECK(x.answer.clear_until > 0);
  CHECK(x.answer.clear_until < 1);
  CHECK(x.answer.separation == Approx(gap).epsilon(1e-3));
}

TEST_CASE("advance: a hit between two doubles is on the side whose gap is smaller", "[impact][advance]") {
  int later = 0, earlier = 0;
  for (int i = 0; i < 64; ++i) {
    // So fast that they travel about 1e-14 between two doubles.
    const double start = 60 + i / 7.0, speed = 100;
    const Advance x = advance(moving(ball, {-start, 0, 0}, {speed, 0, 0}), moving(cube, {0, 0, 0}, {0, 0, 0}),
                              0, {1, 128 * 0x1p-53 * start});
    REQUIRE(x.answer.toi);
    const Wide gap = Wide(start) - Wide(1.5) - Wide(speed) * Wide(*x.answer.toi);
    CHECK(std::abs(static_cast<double>(gap)) <= 128 * 0x1p-53 * start);
    CHECK(x.answer.separation == Approx(static_cast<double>(gap)).margin(1e-18));
    (gap < 0 ? later : earlier) += 1;
  }
  CHECK(later > 5);
  CHECK(earlier > 5);
}
