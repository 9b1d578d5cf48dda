// Bodies at rest: the manifold is complete, and does not change when poses move by an ulp.
#include <algorithm>
#include <vector>

#include "core/math/rng.h"
#include "core/narrow/narrow_phase.h"
#include "core/shape/rim.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Pose at(double x, double y, double z, Quat q = {}) { return {Vec3(x, y, z), q}; }

Hull cube(double h) {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i) v.emplace_back(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h);
  return make_hull(std::move(v));
}

double area(const Manifold& m) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i + 1 < m.size(); ++i)
    sum += (m[i].position - m[0].position).cross(m[i + 1].position - m[0].position);
  return sum.norm() / 2;
}

std::vector<std::uint32_t> ids(const Manifold& m) {
  std::vector<std::uint32_t> r;
  for (const ContactPoint& p : m) r.push_back(p.feature);
  std::sort(r.begin(), r.end());
  return r;
}

struct Rest {
  const char* name;
  Shape a, b;
  Pose pose_a, pose_b;
  std::size_t points;
};

std::vector<Rest> rests() {
  constexpr double s = 0.70710678118654752440, sink = 1e-3;
  const Quat lying{s, 0, 0, s}, yaw{0, 0, 0.3, 1};
  return {
      {"box on box", Box{{1, 1, 1}}, Box{{0.5, 0.5, 0.5}}, {}, at(0.1, 0.2, 1.5 - sink, yaw), 4},
      {"box on the edge of a box",
       Box{{1, 1, 1}},
       Box{{0.5, 0.5, 0.5}},
       {},
       at(1.1, 0.2, 1.5 - sink, yaw),
       0},
      {"cube hull on box", Box{{1, 1, 1}}, cube(0.5), {}, at(0.1, 0.2, 1.5 - sink, yaw), 4},
      {"standing cylinder on box",
       Box{{1, 1, 1}},
       Cylinder{0.5, 0.5},
       {},
       at(0.1, 0.2, 1.5 - sink, yaw),
       convex::rim_corners},
      {"lying cylinder on box", Box{{1, 1, 1}}, Cylinder{0.5, 0.5}, {}, at(0.1, 0.2, 1.5 - sink, lying), 2},
      {"lying capsule on box", Box{{1, 1, 1}}, Capsule{0.25, 0.5}, {}, at(0.1, 0.2, 1.25 - sink, lying), 2},
      {"standing cone on box",
       Box{{1, 1, 1}},
       Cone{0.5, 0.5},
       {},
       at(0.1, 0.2, 1.5 - sink, yaw),
       convex::rim_corners},
      {"ball on box", Box{{1, 1, 1}}, Sphere{0.5}, {}, at(0.1, 0.2, 1.5 - sink), 1},
      {"box on the ground", HalfSpace{}, Box{{0.5, 0.5, 0.5}}, {}, at(0.1, 0.2, 0.5 - sink, yaw), 4},
      {"lying cylinder on the ground",
       HalfSpace{},
       Cylinder{0.5, 0.5},
       {},
       at(0.1, 0.2, 0.5 - sink, lying),
       2},
  };
}

}  // namespace

TEST_CASE("a resting body's normal, points and feature ids are stable under ulps", "[narrow][manifold]") {
  for (const Rest& rest : rests()) {
    INFO(rest.name);
    const ContactAnswer first = contact({&rest.a, rest.pose_a}, {&rest.b, rest.pose_b});
    REQUIRE(first.overlap);
    if (rest.points > 0) CHECK(first.manifold.size() == rest.points);
    Rng r(7);
    for (int frame = 0; frame < 200; ++frame) {
      Pose a = rest.pose_a, b = rest.pose_b;
      for (Pose* p : {&a, &b}) {
        p->translation += 0x1p-52 * Vec3(r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1));
        p->rotation.x += 0x1p-52 * r.uniform(-1, 1);
        p->rotation.y += 0x1p-52 * r.uniform(-1, 1);
      }
      const ContactAnswer c = contact({&rest.a, a}, {&rest.b, b});
      REQUIRE(c.overlap);
      CHECK((c.normal - first.normal).norm() <= 0x1p-48);
      CHECK(std::abs(c.depth - first.depth) <= 0x1p-48);
      REQUIRE(c.manifold.size() == first.manifold.size());
      CHECK(ids(c.manifold) == ids(first.manifold));
      for (const ContactPoint& p : c.manifold) {
        double nearest = 1;
        for (const ContactPoint& q : first.manifold)
          nearest = std::min(nearest, (p.position - q.position).norm());
        CHECK(nearest <= 1e-7);
      }
    }
  }
}

TEST_CASE("face contacts cover the true polygon; four points keep most of it and the deepest",
          "[narrow][manifold]") {
  const Shape big = Box{{1, 1, 1}}, small = Box{{0.5, 0.5, 0.5}}, drum = Cylinder{0.5, 0.5};
  Rng r(3);
  long reduced_points = 0;
  for (int i = 0; i < 200; ++i) {
    // A small box rotated about z, entirely above a large one: its own face is the polygon.
    const double angle = r.uniform(0, 1.5);
    const Pose pose =
        at(r.uniform(-0.2, 0.2), r.uniform(-0.2, 0.2), 1.49, {0, 0, std::sin(angle), std::cos(angle)});
    const ContactAnswer c = contact({&big, {}}, {&small, pose});
    REQUIRE(c.overlap);
    CHECK(area(c.manifold) == Approx(1).epsilon(1e-12));
    // Half off the edge: x from 0.5 on is outside the window.
    const ContactAnswer cut = contact({&big, {}}, {&small, at(1, r.uniform(-0.4, 0.4), 1.49)});
    CHECK(area(cut.manifold) == Approx(0.5).epsilon(1e-12));
    const ContactAnswer octagon =
        contact({&big, {}}, {&drum, at(0.6, 0.1, 1.49, {0, 0, std::sin(angle), std::cos(angle)})});
    const Manifold four = reduced(octagon);
    CHECK(four.size() <= 4);
    CHECK(area(four) >= 0.5 * area(octagon.manifold));
    double deepest = 0;
    for (const ContactPoint& p : four) {
      deepest = std::max(deepest, p.depth);
      ++reduced_points;
    }
    CHECK(deepest == octagon.depth);
  }
  CHECK(reduced_points >= 600);
}
