// How far a pair may advance along one direction, in doubles: each way in which it ends, never beyond the
// time of contact of a closed form.
#include <numbers>

#include "core/impact/filtered/impact_search.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::impact::filtered;

namespace {

const Shape cube = Box{{1, 1, 1}}, ball = Sphere{0.5}, rod = Capsule{0.125, 2};
const Quat along_x{0, 1, 0, 1};  // turns the axis of a rod from z to x

/// Two moving shapes, A at the origin.
struct Course {
  Mover a, b;
  Sweep sweep;
  Course(const Shape& sa, const Quat& turn, const Motion& ma, const Shape& sb, const Vec3& at,
         const Motion& mb)
      : a(make_mover(sa, wide_rotation(turn), ma)),
        b(make_mover(sb, wide_rotation({}), mb)),
        sweep(a, b, at.cast<Wide>()) {}
  Course(const Course&) = delete;
  Course& operator=(const Course&) = delete;

  Followed follow_from(double t, const Vec& turn, double end = 1) const {
    const Spot x = sweep.at(t, true);
    Features f;
    const View v = look(sweep, x, f, 0, x.error);
    return follow(sweep, x, v, turn, end);
  }
};

Motion going(const Vec3& linear, const Vec3& angular = Vec3::Zero()) { return {linear, angular}; }

// A rod along x that turns about z reaches a ball at (x, y) when the ball's centre is 0.625 from its axis.
double time_of_rod(const Vec3& at, double speed) {
  return (std::atan2(at.y(), at.x()) - std::asin(0.625 / std::hypot(at.x(), at.y()))) / speed;
}

}  // namespace

TEST_CASE("follow: clear when the separation along the direction lasts to the end", "[impact][follow]") {
  for (const double end : {1.0, 0.5}) {
    // Passes 0.25 short of the box; recedes; does not move.
    for (const Vec3& v : {Vec3(2.25, 0, 0), Vec3(-9, 0, 0), Vec3(0, 0, 0)}) {
      const Course c(ball, {}, going(v), cube, {4, 0, 0}, {});
      const Followed f = c.follow_from(0, Vec::Zero(), end);
      CHECK(f.clear);
    }
  }
}

TEST_CASE("follow: clear at any angle outside the body of revolution", "[impact][follow]") {
  // The rod's ends are 2.125 from the axis at which it turns, a thousand times a step.
  const Course apart(rod, along_x, going({0, 0, 0}, {0, 0, 6283}), ball, {0, 2.75, 0}, {});
  CHECK(apart.follow_from(0, Vec::Zero()).clear);
  const Course within(rod, along_x, going({0, 0, 0}, {0, 0, 6283}), ball, {0, 2.5, 0}, {});
  CHECK_FALSE(within.follow_from(0, Vec::Zero()).clear);
}

TEST_CASE("follow: a translation steps to within a few errors of contact", "[impact][follow]") {
  const Course c(ball, {}, going({5, 0, 0}), cube, {4, 0.25, 0.5}, {});
  const Followed f = c.follow_from(0, Vec::Zero());
  CHECK_FALSE(f.clear);
  CHECK(f.spot.t < 0.5);
  CHECK((0.5 - f.spot.t) * 5 <= 8 * f.spot.error);
  CHECK((0.5 - f.spot.t) * 5 >= f.spot.error);
}

TEST_CASE("follow: no progress from within the error of contact", "[impact][follow]") {
  const Course c(ball, {}, going({5, 0, 0}), cube, {1.5, 0.25, 0.5}, {});
  const Followed f = c.follow_from(0, Vec::Zero());
  CHECK_FALSE(f.clear);
  CHECK(f.spot.t == 0);
}

TEST_CASE("follow: a direction that turns with the face goes farther, and none goes too far",
          "[impact][follow]") {
  for (const double speed : {0.75, 1.5, 6.0})
    for (const Vec3& at : {Vec3(0, 1.5, 0), Vec3(-0.5, 1.25, 0), Vec3(1, 1, 0.1)}) {
      INFO(speed << ", ball at " << at.transpose());
      const Course c(rod, along_x, going({0, 0, 0}, {0, 0, speed}), ball, at, {});
      // At z = 0.1 the ball is hit a little later.
      const double angle_of_ball = std::atan2(at.y(), at.x()),
                   across = std::sqrt(0.625 * 0.625 - at.z() * at.z());
      const double t = (angle_of_ball - std::asin(across / std::hypot(at.x(), at.y()))) / speed;
      if (at.z() == 0) CHECK(t == Approx(time_of_rod(at, speed)));
      const Followed fixed = c.follow_from(0, Vec::Zero()), turned = c.follow_from(0, {0, 0, speed}),
                     wrong = c.follow_from(0, {1, -2, -speed});
      for (const Followed& f : {fixed, turned, wrong}) {
        if (f.clear) CHECK(t > 1);
        CHECK(f.spot.t <= std::min(t, 1.0));
        CHECK(f.spot.t >= 0);
      }
      if (t <= 1) {
        CHECK(turned.spot.t >= fixed.spot.t);
        // The gap is that of the rod and the ball.
        const double left = std::hypot(at.x(), at.y()) * std::sin(angle_of_ball - speed * turned.spot.t);
        CHECK(std::hypot(left, at.z()) >= 0.625);
      }
    }
}

TEST_CASE("search: a hit at the time of contact, clear, undecided at the start and undecided later",
          "[impact][follow]") {
  const double accuracy = 3e-14;  // the product's, for bodies of this size
  const auto run = [&](const Course& c) { return search(c.sweep, 0, 1, accuracy, {}); };
  const Course hit(rod, along_x, going({0, 0, 0}, {0, 0, 1.5}), ball, {0, 1.5, 0}, {});
  const Search h = run(hit);
  REQUIRE(h.end == SearchEnd::hit);
  CHECK(h.clear_until == Approx(time_of_rod({0, 1.5, 0}, 1.5)).epsilon(1e-13));
  CHECK(h.gap >= 0);
  CHECK(h.gap <= accuracy);
  CHECK((h.b - h.a).norm() <= 1e-12);

  const Course clear(rod, along_x, going({0, 0, 0}, {0, 0, 0.5}), ball, {0, 1.5, 0}, {});
  const Search k = run(clear);
  CHECK(k.end == SearchEnd::clear);
  CHECK(k.clear_until == 1);
  CHECK_FALSE(answer_of(k, Vec::Zero()).toi);

  const Course met(ball, {}, going({5, 0, 0}), cube, {1.25, 0, 0}, {});
  CHECK(run(met).end == SearchEnd::start);
  const Course touching(ball, {}, going({-5, 0, 0}), cube, {1.5, 0, 0}, {});
  CHECK(run(touching).end == SearchEnd::start);

  // So fast that the gap between two doubles of t exceeds the accuracy.
  const Course fast(ball, {}, going({0x1p30, 0, 0}), cube, {1.5 + 0x1p30 * 0.375, 0, 0}, {});
  const Search u = run(fast);
  CHECK(u.end == SearchEnd::unsure);
  CHECK(u.clear_until < 0.375);
  CHECK(u.clear_until == Approx(0.375).epsilon(1e-12));
}

TEST_CASE("search: against a plane, a corner of a tumbling box comes first", "[impact][follow]") {
  const Mover a = make_mover(cube, wide_rotation({}), {Vec3::Zero(), Vec3(std::numbers::pi / 2, 0, 0)});
  const Mover face;
  const Sweep sweep(a, face, WideVec(0, 0, -1.25));
  const Search s = search(sweep, 0, 1, 3e-14, Vec3(0, 0, -1));
  REQUIRE(s.end == SearchEnd::hit);
  const double angle = std::acos(1.25 / std::sqrt(2.0));
  CHECK(s.clear_until == Approx((std::numbers::pi / 4 - angle) / (std::numbers::pi / 2)).epsilon(1e-13));
}
