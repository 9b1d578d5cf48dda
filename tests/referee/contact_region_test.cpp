// The true contact region: closed forms, and its definition checked point by point on touching bodies.
#include "oracles/referee/region/contact_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/referee/support.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::referee_test;
using Kind = ContactRegion::Kind;

namespace {

constexpr double slack = 1e-7;
const Vec3 down(0, 0, -1);

/// A stands on B. Both are rotated and translated together, so that nothing is axis-aligned.
struct Stack {
  Pose frame;
  Placed a, b;
  ContactRegion region() const { return contact_region(a, b, rotation_matrix(frame.rotation) * down, slack); }
};

Stack stacked(Rng& r, const Shape& a, const Pose& at, const Shape& b) {
  const Pose frame{r.vector(0, 2), r.rotation()};
  const Quat q = normalized(frame.rotation);
  return {frame,
          {&a, Pose{rotation_matrix(frame.rotation) * at.translation + frame.translation, q * at.rotation}},
          {&b, Pose{frame.translation, q}}};
}

Quat about_z(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }
Quat about_y(double angle) { return {0, std::sin(angle / 2), 0, std::cos(angle / 2)}; }
constexpr double right_angle = std::numbers::pi / 2;

}  // namespace

TEST_CASE("contact regions of closed form", "[referee][region]") {
  Rng r(3);
  const Shape cube = Box{{1, 1, 1}}, slab = Box{{4, 4, 1}}, rod = Cylinder{0.5, 2}, pill = Capsule{0.5, 2},
              ball = Sphere{1}, top = Cone{1, 1}, egg = Ellipsoid{{1, 2, 3}},
              ground = HalfSpace{{0, 0, 1}, 1};
  constexpr double disc = 1 - 1.1e-4;
  for (int i = 0; i < 20; ++i) {
    const auto polygon = [&](const Stack& s, std::size_t corners, double area) {
      const ContactRegion c = s.region();
      REQUIRE(c.kind == Kind::polygon);
      if (corners > 0) REQUIRE(c.vertices.size() == corners);
      REQUIRE(c.area == Approx(area).epsilon(corners > 0 ? 1e-12 : 1e-4));
      REQUIRE(spanned_area(c.vertices, rotation_matrix(s.frame.rotation) * down) ==
              Approx(c.area).epsilon(1e-12));
      REQUIRE(c.error < 2e-14);
    };
    const auto segment = [&](const Stack& s, double length) {
      const ContactRegion c = s.region();
      REQUIRE(c.kind == Kind::segment);
      REQUIRE(c.length == Approx(length).epsilon(1e-6));
      REQUIRE(spanned_length(c.vertices, rotation_matrix(s.frame.rotation) * down) == Approx(c.length));
    };
    const auto point = [&](const Stack& s, const Vec3& at) {
      const ContactRegion c = s.region();
      REQUIRE(c.kind == Kind::point);
      const Vec3 expected = rotation_matrix(s.frame.rotation) * at + s.frame.translation;
      REQUIRE((c.vertices[0] - expected).norm() < 1e-6);
    };
    polygon(stacked(r, cube, {{0.5, 0.25, 2}, {}}, cube), 4, 1.5 * 1.75);
    polygon(stacked(r, cube, {{0, 0, 2}, about_z(right_angle / 2)}, cube), 8, 8 * (std::sqrt(2.0) - 1));
    polygon(stacked(r, cube, {{0, 0, 1.9}, about_z(0.3)}, slab), 4, 4);
    polygon(stacked(r, rod, {{0, 0, 3}, {}}, slab), 0, std::numbers::pi / 4 * disc);
    polygon(stacked(r, rod, {{4, 0, 3}, {}}, slab), 0, std::numbers::pi / 8 * disc);  // half over the edge
    polygon(stacked(r, top, {{0, 0, 2}, {}}, slab), 0, std::numbers::pi * disc);
    polygon(stacked(r, rod, {{0, 0, 3}, {}}, ground), 0, std::numbers::pi / 4 * disc);
    polygon(stacked(r, slab, {{0, 0, 1.5}, about_z(1)}, ground), 4, 64);
    segment(stacked(r, rod, {{0, 0, 1.5}, about_y(right_angle)}, slab), 4);
    segment(stacked(r, rod, {{3, 0, 1.5}, about_y(right_angle)}, slab), 3);  // a metre beyond the edge
    segment(stacked(r, pill, {{0, 0, 1.5}, about_y(right_angle)}, slab), 4);
    segment(stacked(r, pill, {{0, 0, 1.5}, about_y(right_angle)}, ground), 4);
    segment(
        stacked(r, top,
                {{0, 0, 1 + 2 / std::sqrt(5.0) - 1 / std::sqrt(5.0)}, about_y(right_angle + std::atan(0.5))},
                slab),
        std::sqrt(5.0));
    point(stacked(r, ball, {{0.5, 0.25, 2}, {}}, slab), {0.5, 0.25, 1});
    point(stacked(r, egg, {{0.5, 0.25, 4}, {}}, slab), {0.5, 0.25, 1});
    point(stacked(r, pill, {{0.5, 0.25, 3.5}, {}}, slab), {0.5, 0.25, 1});
    point(stacked(r, top, {{0.5, 0.25, 2}, about_y(2 * right_angle)}, slab), {0.5, 0.25, 1});
    point(stacked(r, ball, {{0.5, 0.25, 2}, {}}, ground), {0.5, 0.25, 1});
    // Crossed edges: a cube on its edge above a slab on its edge, at right angles.
    point(
        stacked(r, cube, {{0, 0, 2 * std::sqrt(2.0)}, about_y(right_angle / 2)},
                Shape(Hull{{{-1, 0, std::sqrt(2.0)}, {1, 0, std::sqrt(2.0)}, {0, -1, 0}, {0, 1, 0}}, {}, 0})),
        {0, 0, std::sqrt(2.0)});
  }
  const Shape mesh = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  REQUIRE(contact_region({&mesh, Pose{}}, {&cube, Pose{}}, down, slack).kind == Kind::none);
  REQUIRE(contact_region({&cube, Pose{{9, 0, 2}, {}}}, {&cube, Pose{}}, down, slack).kind == Kind::none);
}

TEST_CASE("prisms that touch: the region's points are in both bodies, those around it are not",
          "[referee][region]") {
  Rng r(11);
  int inside = 0, outside = 0, none = 0;
  for (int i = 0; i < 120; ++i) {
    // Random polygons as the faces of prisms of height 1, one upright on the other, exactly at gap 0.
    const auto prism = [&] {
      Hull h;
      const int n = 3 + static_cast<int>(r.below(6));
      for (int k = 0; k < n; ++k) {
        const double angle = r.uniform(0, 6.28), size = r.uniform(0.3, 1);
        for (double z : {0.0, 1.0})
          h.vertices.emplace_back(size * std::cos(angle), size * std::sin(angle), z);
      }
      return Shape(h);
    };
    const Shape x = prism(), y = prism();
    const Placed a{&x, Pose{{r.uniform(-0.7, 0.7), r.uniform(-0.7, 0.7), 1}, {}}}, b{&y, Pose{}};
    const ContactRegion c = contact_region(a, b, down, slack);
    none += c.kind == Kind::none;
    if (c.kind == Kind::point || c.kind == Kind::segment) continue;
    const auto in_region = [&](const Vec3& p, double margin) {
      for (std::size_t k = 0; k < c.vertices.size(); ++k) {
        // Counter-clockwise against the normal, which is -z.
        const Vec3 d = c.vertices[(k + 1) % c.vertices.size()] - c.vertices[k];
        if (Vec3(d.cross(p - c.vertices[k])).dot(down) < -margin * d.norm()) return false;
      }
      return c.kind == Kind::polygon;
    };
    for (const Vec3& v : c.vertices) {
      REQUIRE(distance_to(a, v).lo <= 4 * c.error);
      REQUIRE(distance_to(b, v).lo <= 4 * c.error);
    }
    for (int k = 0; k < 60; ++k) {
      const Vec3 p(r.uniform(-1, 1), r.uniform(-1, 1), 1);
      const bool both = distance_to(a, p).hi <= 0 && distance_to(b, p).hi <= 0;
      if (in_region(p, -1e-9)) {
        REQUIRE(both);
        ++inside;
      } else if (!in_region(p, 1e-9)) {
        REQUIRE_FALSE(both);
        ++outside;
      }
    }
  }
  CAPTURE(none);
  REQUIRE(inside > 200);
  REQUIRE(outside > 1000);
}

TEST_CASE("points bear a weight on the region if its centroid is among them", "[referee][region]") {
  const Shape floor = Box{{5, 5, 1}}, box = Box{{1, 1, 1}};
  const ContactRegion r = contact_region({&floor, Pose{}}, {&box, Pose{{0, 0, 1.75}, {}}}, {0, 0, 1}, 1e-6);
  REQUIRE(r.kind == ContactRegion::Kind::polygon);
  const auto holds = [&](const std::vector<Vec3>& points) { return holds_centroid(r, points, {0, 0, 1}); };
  CHECK(holds({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}) == true);
  CHECK(holds({{-1, -1, 1}, {1, 1, 0.75}}) == true);  // a diagonal
  CHECK(holds({{0, 0, 1}}) == true);
  CHECK(holds({{-1, -1, 1}, {1, -1, 1}, {1, -0.5, 1}}) == false);
  CHECK(holds({{0.1, 0, 1}}) == false);
  CHECK(holds({}) == false);
  const Shape ball = Sphere{1};
  const ContactRegion point =
      contact_region({&floor, Pose{}}, {&ball, Pose{{0, 0, 1.75}, {}}}, {0, 0, 1}, 1e-6);
  CHECK_FALSE(holds_centroid(point, {{0, 0, 1}}, {0, 0, 1}));
}

TEST_CASE("heights of corners below a support plane", "[referee][region]") {
  const auto heights = [](const Shape& s, const Quat& q, const Vec3& n) {
    return corner_heights({&s, Pose{Vec3(3, 2, 1), q}}, n);
  };
  const auto are = [](const std::vector<double>& x, const std::vector<double>& expected) {
    REQUIRE(x.size() >= expected.size());
    for (const double e : expected)
      CHECK(std::any_of(x.begin(), x.end(), [&](double h) { return std::abs(h - e) < 1e-12; }));
    for (const double h : x)
      CHECK(std::any_of(expected.begin(), expected.end(), [&](double e) { return std::abs(h - e) < 1e-12; }));
  };
  const double s = std::sin(0.25), c = std::cos(0.25);
  are(heights(Box{{1, 1, 1}}, Quat{}, down), {0, 2});
  are(heights(Box{{1, 2, 3}}, Quat{}, 2 * Vec3(s, 0, c)), {0, 2 * s, 6 * c, 2 * s + 6 * c});
  are(heights(Box{{1, 2, 3}}, about_y(0.25), Vec3(s, 0, c)), {0, 6});
  are(heights(Cylinder{1, 3}, Quat{}, Vec3(s, 0, c)), {0, 2 * s, 6 * c, 2 * s + 6 * c});
  are(heights(Cone{1, 3}, Quat{}, Vec3(0, 0, 1)), {0, 6});
  are(heights(Sphere{1}, Quat{}, down), {0});
  CHECK(heights(HalfSpace{{0, 0, 1}, 0}, Quat{}, down).empty());
}

TEST_CASE("corners beyond a face: of the body, on the face's border, and at the face's corners",
          "[referee][region]") {
  const Shape table = Box{{1, 1, 1}}, box = Box{{0.5, 0.5, 0.5}};
  const Vec3 up(0, 0, 1);
  const auto corners = [&](const Shape& a, const Shape& b, const Pose& at_b) {
    return corners_beyond_face({&a, Pose{}}, {&b, at_b}, up, 1e-7);
  };
  const auto are = [](const std::optional<std::vector<Vec3>>& is, const std::vector<Vec3>& expected) {
    REQUIRE(is.has_value());
    CHECK(is->size() == expected.size());
    for (const Vec3& e : expected)
      CHECK(std::any_of(is->begin(), is->end(), [&](const Vec3& p) { return (p - e).norm() < 1e-12; }));
  };
  // Sunk by a quarter, half-way to the plane at z = 1: all inside, across a side, around a corner.
  const double z = 0.875;
  are(corners(table, box, {{0, 0, 1.25}, {}}),
      {{-0.5, -0.5, z}, {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}});
  are(corners(table, box, {{0.75, 0, 1.25}, {}}),
      {{0.25, -0.5, z}, {1, -0.5, z}, {1, 0.5, z}, {0.25, 0.5, z}});
  are(corners(table, box, {{0.75, 0.75, 1.25}, {}}),
      {{0.25, 0.25, z}, {1, 0.25, z}, {1, 1, z}, {0.25, 1, z}});
  are(corners(table, box, {{0, 0, 1.75}, {}}), {});
  // An edge that hangs over a side: at the side it is as deep as its slope says.
  const Shape pole = Capsule{0.25, 1};
  const Quat lean = about_y(right_angle - 0.25);
  const double s = std::sin(0.25), c = std::cos(0.25);  // the pole's axis is (c, 0, s)
  const double lower_end = 1.2 - s, at_side = lower_end + s / c * (1 - (1 - c));
  are(corners(table, pole, {{1, 0, 1.2}, lean}),
      {{1 - c, 0, (lower_end - 0.25 + 1) / 2}, {1, 0, (at_side - 0.25 + 1) / 2}});
  // A face with a round border is a polygon.
  const Shape drum = Cylinder{1, 1}, plate = Box{{3, 3, 0.5}};
  const auto below_plate = corners(drum, plate, {{0, 0, 1.25}, {}});
  REQUIRE(below_plate.has_value());
  CHECK(below_plate->size() == rim_corners);
  // A box that stands on an edge, in the table as a whole: its upper edge is above the lower one.
  const Quat on_edge{std::sin(right_angle / 4), 0, 0, std::cos(right_angle / 4)};
  const double w = std::sqrt(0.5);
  are(corners(table, box, {{0, 0, 0}, on_edge}), {{-0.5, 0, (1 - w) / 2},
                                                  {0.5, 0, (1 - w) / 2},
                                                  {-0.5, w, 0.5},
                                                  {0.5, w, 0.5},
                                                  {-0.5, -w, 0.5},
                                                  {0.5, -w, 0.5}});
  // A leaning drum over a side: its lowest point, and the line up from there.
  const Quat leaning = about_y(right_angle - 0.25);
  const double low = 1.9 - c - s, over_side = low + s / c * (1 - (1 - c + s));
  are(corners(table, drum, {{1, 0, 1.9}, leaning}),
      {{1 - c + s, 0, (low + 1) / 2}, {1, 0, (over_side + 1) / 2}});
  const Shape ground = HalfSpace{{0, 0, 1}, 0};
  CHECK_FALSE(corners(ground, box, {{0, 0, 0.25}, {}}).has_value());
  CHECK_FALSE(corners_beyond_face({&table, Pose{}}, {&box, Pose{{0, 0, 1.25}, {}}}, {0.1, 0, 1}, 1e-7));
}

TEST_CASE("distance from what points span", "[referee][region]") {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  const Vec3 up(0, 0, 2);
  const auto distance = [&](const Vec3& p) { return distance_from_span(p, square, up); };
  CHECK(distance({0.5, 0.25, 0.25}) == Approx(0).margin(1e-15));
  CHECK(distance({0.5, 0.25, 0.75}) == Approx(0.25));
  CHECK(distance({0.5, 0.25, -0.5}) == Approx(0.5));
  CHECK(distance({0.5, -2, 0}) == Approx(2));
  CHECK(distance({4, 5, 0.5}) == Approx(5));
  CHECK(distance({4, 1, 4.5}) == Approx(5));
  CHECK(distance_from_span({1, 0, 1}, {{1, 0, 0}}, up) == Approx(1));
  CHECK(distance_from_span({1, 2, 0}, {{0, 0, 0}, {3, 0, 0}}, up) == Approx(2));
}
