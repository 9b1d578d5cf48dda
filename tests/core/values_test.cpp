#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "core/math/expansion.h"
#include "core/math/rng.h"
#include "core/scene/scene.h"
#include "tests/support/catch.h"

using namespace touchstone;

TEST_CASE("random numbers reproduce from their seed, bit for bit", "[values][rng]") {
  // Pinned: the first numbers of seed 1, and a hash over every distribution. A change here changes every
  // campaign.
  Rng rng(1);
  CHECK(rng.next() == 0xcfc5d07f6f03c29bULL);
  Hasher h;
  Rng r = Rng::stream(42, 7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 u = r.unit_vector();
    const Quat q = r.rotation();
    h.add(u.x())
        .add(u.y())
        .add(u.z())
        .add(q.x)
        .add(q.w)
        .add(r.uniform(-2, 3))
        .add(r.below(17))
        .add(r.binary_scale(-3, 3));
  }
  INFO(hex64(h.value()));
  CHECK(hex64(h.value()) == "19067cde3dc86360");
}

TEST_CASE("unit vectors and rotations have unit length and no bias", "[values][rng]") {
  Rng rng(9);
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 20000; ++i) {
    const Vec3 u = rng.unit_vector();
    REQUIRE(std::abs(u.norm() - 1) < 1e-15);
    mean += u / 20000;
    const Mat3 m = rotation_matrix(rng.rotation());
    REQUIRE((m * m.transpose() - Mat3::Identity()).norm() < 1e-14);
    REQUIRE(m.determinant() > 0);
  }
  CHECK(mean.norm() < 0.03);
}

TEST_CASE("a double's text reads back to the same bits", "[values]") {
  Rng rng(3);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::bit_cast<double>(rng.next());
    if (!std::isfinite(x)) continue;
    REQUIRE(std::bit_cast<std::uint64_t>(*double_from_text(to_text(x))) == std::bit_cast<std::uint64_t>(x));
  }
  CHECK(to_text(-0.0) == "-0");
  CHECK_FALSE(double_from_text("1.5x"));
  CHECK_FALSE(double_from_text(""));
}

TEST_CASE("rotation matrices do not depend on the quaternion's length", "[values]") {
  const Quat q{0.25, -0.5, 0.125, 1};
  for (double s : {1e-300, 1e-3, 4.0, 1e150})
    CHECK((rotation_matrix({q.x * s, q.y * s, q.z * s, q.w * s}) - rotation_matrix(q)).norm() < 1e-15);
  CHECK(rotation_matrix({0, 0, 1, 1}) * Vec3(1, 0, 0) == Vec3(0, 1, 0));
}

TEST_CASE("orientation is exact where rounding would lie", "[values][predicates]") {
  // Four coplanar points, and the fourth moved by one ulp: the sign must change.
  const Vec3 a(0.1, 0.2, 0.3), b(1.1, 0.2, 0.3), c(0.1, 1.2, 0.3);
  CHECK(orient3d_sign(a, b, c, Vec3(7, -5, 0.3)) == 0);
  CHECK(orient3d_sign(a, b, c, Vec3(7, -5, std::nextafter(0.3, 1))) != 0);
  CHECK(orient3d_sign(a, b, c, Vec3(7, -5, std::nextafter(0.3, 1))) ==
        -orient3d_sign(a, b, c, Vec3(7, -5, std::nextafter(0.3, 0))));
}

TEST_CASE("hulls: dimension is exact, faces are closed, outward, and bound every vertex", "[values][hull]") {
  CHECK(make_hull({{1, 2, 3}, {1, 2, 3}}).dimension == 0);
  CHECK(make_hull({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}).dimension == 1);
  CHECK(make_hull({{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}, {5, 5, 0.1}}).dimension == 2);
  CHECK_THROWS_AS(make_hull({}), InputError);
  CHECK_THROWS_AS(make_hull({{0, 0, std::numeric_limits<double>::quiet_NaN()}}), InputError);
  Rng rng(4);
  int solid = 0;
  for (int k = 0; k < 300; ++k) {
    std::vector<Vec3> v;
    for (std::size_t i = 0, n = 4 + rng.below(40); i < n; ++i) v.push_back(rng.unit_vector() * 2);
    const Hull h = make_hull(v);
    REQUIRE(h.dimension == 3);
    REQUIRE_FALSE(h.faces.empty());
    ++solid;
    std::map<std::pair<int, int>, int> edges;
    for (const auto& f : h.faces) {
      const auto at = [&](int i) {
        return h.vertices[static_cast<std::size_t>(f[static_cast<std::size_t>(i)])];
      };
      const Vec3 n = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      for (const Vec3& p : h.vertices) REQUIRE(n.dot(p - at(0)) < 1e-9);
      for (std::size_t i = 0; i < 3; ++i) ++edges[{f[i], f[(i + 1) % 3]}];
    }
    for (const auto& [e, count] : edges) {
      REQUIRE(count == 1);
      REQUIRE(edges.count({e.second, e.first}) == 1);
    }
  }
  CHECK(solid == 300);
}

TEST_CASE("a box's eight corners have twelve triangles, coplanar ones included, and twelve edges",
          "[values][hull]") {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i) v.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 2.0 : -2.0, i & 4 ? 3.0 : -3.0});
  const Hull h = make_hull(v);
  CHECK(h.faces.size() == 12);
  CHECK(h.edges.size() == 12);
  for (const auto& [i, k] : h.edges) CHECK(((i ^ k) == 1 || (i ^ k) == 2 || (i ^ k) == 4));
}

TEST_CASE("edges of a hull: those of its faces, and of a flat one its outline", "[values][hull]") {
  Rng rng(6);
  for (int n = 0; n < 100; ++n) {
    std::vector<Vec3> v;
    for (std::size_t i = 0, count = 4 + rng.below(40); i < count; ++i) v.push_back(rng.unit_vector() * 2);
    const Hull h = make_hull(v);
    CHECK(2 * h.edges.size() == 3 * h.faces.size());
    std::set<std::pair<int, int>> sides;
    for (const auto& f : h.faces)
      for (std::size_t k = 0; k < 3; ++k) sides.insert({f[k], f[(k + 1) % 3]});
    for (const auto& [i, k] : h.edges) CHECK((sides.contains({i, k}) && sides.contains({k, i})));
  }
  const auto sorted = [](const std::vector<Vec3>& v) {
    std::set<std::pair<int, int>> edges;
    for (const auto& [i, k] : make_hull(v).edges) edges.insert({std::min(i, k), std::max(i, k)});
    return edges;
  };
  using Edges = std::set<std::pair<int, int>>;
  // A square that leans, its middle, the middle of a side and a corner twice.
  CHECK(sorted({{0, 0, 0}, {1, 1, 1}, {2, 0, 2}, {2, 2, 2}, {0, 2, 0}, {1, 0, 1}, {2, 2, 2}}) ==
        Edges{{0, 2}, {2, 3}, {3, 4}, {0, 4}});
  CHECK(sorted({{0, 0, 0}, {0, 0, 2}, {0, 0, 1}}) == Edges{{0, 1}});
  CHECK(sorted({{1, 2, 3}, {1, 2, 3}}).empty());
}

TEST_CASE("a bad scene is refused with the place of the fault", "[values][scene]") {
  Scene s;
  s.shapes = {Sphere{1}};
  s.bodies.resize(2);
  CHECK_NOTHROW(validate(s));
  const auto place = [&](auto&& change) {
    Scene bad = s;
    change(bad);
    try {
      validate(bad);
    } catch (const InputError& e) {
      return e.place();
    }
    return std::string("accepted");
  };
  CHECK(place([](Scene& x) { x.bodies[1].pose.rotation = {0, 0, 0, 0}; }) == "bodies[1].pose.rotation");
  CHECK(place([](Scene& x) { x.bodies[0].pose.translation.y() = NAN; }) == "bodies[0].pose.translation");
  CHECK(place([](Scene& x) { x.shapes[0] = Sphere{-1}; }) == "shapes[0].radius");
  CHECK(place([](Scene& x) { x.bodies[0].shape = 3; }) == "bodies[0].shape");
  CHECK(place([](Scene& x) { x.script = {{Step::Op::remove, 0, {}}}; }) == "script[0]");
  CHECK(place([](Scene& x) { x.ignored = {{1, 0}}; }) == "ignored[0]");
  CHECK(place([](Scene& x) { x.shapes[0] = HalfSpace{Vec3::Zero(), 0}; }) == "shapes[0].normal");
}

TEST_CASE("the hash of a scene depends on every number", "[values][scene]") {
  Scene s;
  s.shapes = {Box{{1, 2, 3}}};
  s.bodies.resize(1);
  const auto h = hash(s);
  Scene t = s;
  std::get<Box>(t.shapes[0]).half_extents.z() = std::nextafter(3.0, 4.0);
  CHECK(hash(t) != h);
  t = s;
  t.bodies[0].pose.rotation.w = 2;
  CHECK(hash(t) != h);
  t = s;
  t.bodies[0].motion = Motion{};
  CHECK(hash(t) != h);
}

TEST_CASE("the bounding radius of a hull is not less than any vertex's distance, and tight",
          "[values][shape]") {
  static_assert(std::numeric_limits<long double>::digits >= 64,
                "the test needs more digits than the product");
  Rng rng(31);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec3> v;
    for (int k = 0; k < 6; ++k) v.push_back(rng.vector(0.1, 1) * rng.binary_scale(-30, 30));
    long double farthest = 0;
    for (const Vec3& x : v) {
      const auto square = [](double c) { return static_cast<long double>(c) * c; };
      farthest = std::max(farthest, std::sqrt(square(x.x()) + square(x.y()) + square(x.z())));
    }
    const double radius = bounding_radius(make_hull(v));
    CHECK(static_cast<long double>(radius) >= farthest);
    CHECK(static_cast<long double>(radius) <= farthest * (1 + 0x1p-48L));
  }
}
