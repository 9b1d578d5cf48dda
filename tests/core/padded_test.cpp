// Padded shapes in the core: against their cores, the shapes that they degenerate to, and boxes by the
// referee.
#include "core/math/rng.h"
#include "core/narrow/bounded.h"
#include "core/narrow/narrow_phase.h"
#include "core/world/simpler_shape.h"
#include "oracles/referee/referee.h"
#include "tests/core/box_bounds.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

constexpr ShapeKind padded_kinds[] = {ShapeKind::padded_cylinder, ShapeKind::padded_cone,
                                      ShapeKind::padded_ellipsoid, ShapeKind::padded_hull};

Hull wedge() { return make_hull({{1, 0, 0}, {-1, 0.5, 0}, {0, -1, 0.5}, {0, 0, 1.5}, {0.25, 0.5, -1}}); }

std::vector<Shape> cores() {
  return {Cylinder{0.75, 1.25}, Cone{1, 0.75}, Ellipsoid{Vec3(0.5, 1, 1.5)}, wedge()};
}

}  // namespace

TEST_CASE("padding a shape gives the shape of all points within it", "[core][padded]") {
  CHECK(padded(Sphere{1}, 0.5) == Shape(Sphere{1.5}));
  CHECK(padded(Capsule{1, 2}, 0.5) == Shape(Capsule{1.5, 2}));
  CHECK(padded(Box{Vec3(1, 2, 3)}, 0.5) == Shape(RoundedBox{Vec3(1, 2, 3), 0.5}));
  CHECK(padded(RoundedBox{Vec3(1, 2, 3), 0.25}, 0.5) == Shape(RoundedBox{Vec3(1, 2, 3), 0.75}));
  CHECK(padded(HalfSpace{Vec3(0, 3, 4), 1}, 0.5) == Shape(HalfSpace{Vec3(0, 3, 4), 3.5}));
  CHECK(padded(Box{Vec3(1, 2, 3)}, 0) == Shape(Box{Vec3(1, 2, 3)}));
  CHECK_FALSE(padded(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 0.5));
  for (const Shape& core : cores()) {
    const Shape once = *padded(core, 0.25), twice = *padded(once, 0.5);
    CHECK(type_name(once) == "padded_" + std::string(type_name(core)));
    CHECK(twice == *padded(core, 0.75));
    CHECK(extent(once) == extent(core) + 0.25);
    const Shape flat = std::visit(
        [](auto s) -> Shape {
          if constexpr (requires { s.padding; }) s.padding = 0;
          return s;
        },
        once);
    CHECK(simpler_shape(flat, 0)->shape == core);
    CHECK_FALSE(simpler_shape(once, 1).has_value());
  }
}

TEST_CASE("padding brings shapes nearer by itself, until their cores touch", "[core][padded]") {
  Rng r(41);
  int apart = 0, shallow = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Shape> all = cores();
    const Shape &a = all[r.below(4)], &b = all[r.below(4)];
    const double pad_a = r.uniform(0, 1), pad_b = r.chance(0.5) ? 0 : r.uniform(0, 1);
    const Shape larger_a = *padded(a, pad_a), larger_b = *padded(b, pad_b);
    const Pose p{Vec3::Zero(), r.rotation()}, q{r.unit_vector() * r.uniform(2, 4.5), r.rotation()};
    const DistanceAnswer core = distance({&a, p}, {&b, q});
    REQUIRE(core.outcome == Outcome::answered);
    if (!(core.distance > 0.01)) continue;
    const double gap = core.distance - pad_a - pad_b;
    const DistanceAnswer d = distance({&larger_a, p}, {&larger_b, q});
    REQUIRE(d.outcome == Outcome::answered);
    CHECK(d.distance == Approx(gap).margin(1e-13));
    CHECK(overlap({&larger_a, p}, {&larger_b, q}).overlap == (gap <= 0));
    CHECK(within({&larger_a, p}, {&larger_b, q}, gap + 1e-9).within);
    CHECK_FALSE(within({&larger_a, p}, {&larger_b, q}, gap - 1e-9).within);
    const ContactAnswer c = contact({&larger_a, p}, {&larger_b, q});
    REQUIRE(c.outcome == Outcome::answered);
    REQUIRE(c.overlap == (gap <= 0));
    ++(c.overlap ? shallow : apart);
    if (c.overlap) CHECK(c.depth == Approx(-gap).margin(1e-13));
  }
  CHECK(apart > 60);
  CHECK(shallow > 60);
}

TEST_CASE("a padded shape rests on a plane, a box and a mesh by its padding", "[core][padded]") {
  const Shape plane = HalfSpace{Vec3(0, 0, 1), 0}, floor = Box{Vec3(4, 4, 1)},
              mesh = TriangleMesh{{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  // Lowest point of each core, at its own height.
  const std::pair<Shape, double> all[] = {{Padded<Cylinder>{{0.75, 1.25}, 0.25}, 1.25},
                                          {Padded<Cone>{{1, 0.75}, 0.25}, 0.75},
                                          {Padded<Ellipsoid>{{Vec3(0.5, 1, 1.5)}, 0.25}, 1.5},
                                          {Padded<Hull>{wedge(), 0.25}, 1}};
  for (const auto& [shape, height] : all)
    for (const double gap : {-0.125, -0.0625, 0.5}) {
      INFO(type_name(shape) << " " << gap);
      const PlacedShape body{&shape, Pose{Vec3(0, 0, height + 0.25 + gap), {}}};
      const PlacedShape grounds[] = {{&plane, Pose{}}, {&floor, Pose{Vec3(0, 0, -1), {}}}, {&mesh, Pose{}}};
      for (const PlacedShape& ground : grounds) {
        const ContactAnswer c = contact(body, ground);
        REQUIRE(c.outcome == Outcome::answered);
        CHECK(c.overlap == (gap < 0));
        if (gap > 0) CHECK(distance(body, ground).distance == Approx(gap).margin(1e-14));
        if (!(gap < 0)) continue;
        CHECK(c.depth == Approx(-gap).margin(1e-14));
        CHECK(c.normal.z() == Approx(-1).margin(1e-14));
      }
    }
}

TEST_CASE("the deepest point of a manifold lies on a rim", "[core][padded]") {
  const Shape a = Padded<Cylinder>{{0.6549367597442901, 0.6778650769857232}, 0.14632727886613167},
              b = Cylinder{0.0023708191449056688, 0.7477462292220931};
  const Pose p{Vec3(-1.065920579678589, 0.07983796614382749, 0.7016588758411934),
               {-0.7448737938339958, 0.4340838025184384, -0.0028286375030144285, -0.5066816381717021}};
  const Pose q{Vec3::Zero(),
               {-0.41538711282810814, -0.8455566574736981, 0.217067043527609, -0.2556743712467459}};
  for (const bool exchanged : {false, true}) {
    const ContactAnswer c = exchanged ? contact({&b, q}, {&a, p}) : contact({&a, p}, {&b, q});
    REQUIRE(c.manifold.size() == 1);
    const Vec3 to_b = exchanged ? Vec3(-c.normal) : c.normal;
    const auto& deepest = *std::ranges::max_element(c.manifold, {}, &ContactPoint::depth);
    const Vec3 on_b =
        rotation_matrix(q.rotation).transpose() * (deepest.position - to_b * (deepest.depth / 2));
    CHECK(std::hypot(on_b.x(), on_b.y()) == Approx(0.0023708191449056688).epsilon(0).margin(1e-15));
    CHECK(std::abs(on_b.z()) == Approx(0.7477462292220931).epsilon(0).margin(1e-15));
  }
}

TEST_CASE("beside the support point, too, the deepest point lies on the rim", "[core][padded]") {
  const double radius = 0.4053074550674155;
  const Shape a = Cylinder{radius, 0.573309263980696}, b = Capsule{0.2580858898500609, 1.0630113792334914};
  const Pose p{Vec3(0, 0, 0),
               {0.29471323071481376, 0.7495111777822936, -0.34048747019993175, 0.48522715160828206}};
  const Pose q{Vec3(-0.5808153492094879, 0.20655245710514936, 0.7277758133063561),
               {0.4694506427496947, -0.7685853635802279, -0.12385734534671011, -0.4165957163915796}};
  for (const bool exchanged : {false, true}) {
    const ContactAnswer c = exchanged ? contact({&b, q}, {&a, p}) : contact({&a, p}, {&b, q});
    REQUIRE(c.manifold.size() == 2);
    const Vec3 from_a = exchanged ? Vec3(-c.normal) : c.normal;
    const auto& deepest = *std::ranges::max_element(c.manifold, {}, &ContactPoint::depth);
    const Vec3 on_a = rotation_matrix(p.rotation).transpose() *
                      (deepest.position + from_a * (deepest.depth / 2) - p.translation);
    CHECK(std::hypot(on_a.x(), on_a.y()) == Approx(radius).epsilon(0).margin(1e-15));
  }
}

TEST_CASE("boxes around padded shapes hold them, and no more", "[core][padded]") {
  Rng r(42);
  for (const Shape& core : cores()) {
    const Shape s = *padded(core, 0.5);
    CHECK(bounding_radius(s) >= bounding_radius(core) + 0.5);
    CHECK(bounding_radius(s) <= bounding_radius(core) + 0.5 + 1e-14);
    testing::check_boxes(r, s, 100);
  }
  for (const ShapeKind k : padded_kinds) CHECK(is_convex(k));
}
