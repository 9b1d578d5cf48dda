// The point of a simplex nearest to the origin, in all three arithmetics: every region of a point, an edge, a
// triangle and a tetrahedron, in every order of the corners, and degenerate simplices.
#include <algorithm>
#include <vector>

#include "core/math/rng.h"
#include "core/narrow/simplex.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

using Points = std::vector<Vec3>;

/// Foot of the origin, the weights of all corners, and whether it is enclosed.
struct Foot {
  Vec3 point = Vec3::Zero();
  std::vector<double> weight;
  int corners = 0;  // with a positive weight
  bool encloses = false;
  double margin = 0;
};

template <class R>
Foot foot_of(const Points& points) {
  narrow::Simplex<R> s;
  s.size = static_cast<int>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    s.p[i].w = points[i].cast<R>();
    s.p[i].a = V3<R>::Constant(static_cast<R>(static_cast<double>(i)));  // labels the corner
  }
  V3<R> v = V3<R>::Zero();
  R dist_sq = 0, margin = 0;  // 0: nothing is nearer yet, so that all four faces are tried
  Foot r;
  r.encloses =
      narrow::reduce < !std::is_floating_point_v<R> || (sizeof(R) > sizeof(double)) > (s, v, dist_sq, margin);
  r.weight.assign(points.size(), 0);
  if (r.encloses) {
    r.margin = static_cast<double>(margin);
    return r;
  }
  r.point = v.template cast<double>();
  CHECK(static_cast<double>(dist_sq) == Approx(r.point.squaredNorm()).epsilon(1e-6));
  r.corners = s.size;
  if (s.size == 3) narrow::refine_weights<R>(s.p[0].w, s.p[1].w, s.p[2].w, v, s.weight.data());
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.size); ++k)
    r.weight[static_cast<std::size_t>(static_cast<double>(s.p[k].a[0]))] = static_cast<double>(s.weight[k]);
  return r;
}

// Necessary and sufficient for the nearest point v of a convex hull: v is a convex combination of the
// corners, and the plane through v across v has all of them beyond it.
void check_optimal(const Points& points, const Foot& f, double tolerance) {
  double sum = 0, size = 0;
  Vec3 combined = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(f.weight[i] >= 0);
    sum += f.weight[i];
    combined += f.weight[i] * points[i];
    size = std::max(size, points[i].norm());
  }
  CHECK(sum == Approx(1).epsilon(tolerance));
  CHECK((combined - f.point).norm() <= tolerance * size);
  const double length = f.point.norm();
  for (const Vec3& p : points) CHECK(f.point.dot(p) >= length * (length - tolerance * size));
}

struct Region {
  const char* name;
  Points points;
  Vec3 nearest;
  int corners;  // that support it
};

void check_region(const Region& region) {
  Points p = region.points;
  std::vector<std::size_t> order(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) order[i] = i;
  do {
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = region.points[order[i]];
    INFO(region.name << ", first corner " << order[0]);
    int arithmetic = 0;
    for (const Foot& f : {foot_of<Wide>(p), foot_of<double>(p), foot_of<float>(p)}) {
      INFO("arithmetic " << arithmetic);
      const double tolerance = arithmetic++ == 2 ? 1e-6 : 1e-14;
      CHECK_FALSE(f.encloses);
      CHECK(f.corners == region.corners);
      CHECK((f.point - region.nearest).norm() <= tolerance * (1 + region.nearest.norm()));
      check_optimal(p, f, tolerance);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

const Points around_origin{{-1, -1, -1}, {3, -1, -1}, {-1, 3, -1}, {-1, -1, 3}};

Points moved(Points p, const Vec3& by) {
  for (Vec3& x : p) x += by;
  return p;
}

}  // namespace

TEST_CASE("simplex: each region of a point, an edge, a triangle and a tetrahedron", "[narrow][simplex]") {
  const Points edge{{-1, 2, 0}, {1, 2, 0}};
  const Points triangle{{-1, -1, 2}, {2, -1, 2}, {-1, 2, 2}};
  for (const Region& region : std::vector<Region>{
           {"point", {{3, 4, 12}}, {3, 4, 12}, 1},
           {"edge, inside", edge, {0, 2, 0}, 2},
           {"edge, one end", moved(edge, {3, 0, 0}), {2, 2, 0}, 1},
           {"edge, other end", moved(edge, {-3, 0, 0}), {-2, 2, 0}, 1},
           {"triangle, inside", triangle, {0, 0, 2}, 3},
           {"triangle, first edge", moved(triangle, {0, 2, 0}), {0, 1, 2}, 2},
           {"triangle, second edge", moved(triangle, {-1.5, -1.5, 0}), {-1, -1, 2}, 2},
           {"triangle, third edge", moved(triangle, {2, 0, 0}), {1, 0, 2}, 2},
           {"triangle, corner between two edges", moved(triangle, {3, 3, 0}), {2, 2, 2}, 1},
           {"triangle, acute corner", moved(triangle, {-6, 1, 0}), {-4, 0, 2}, 1},
           {"tetrahedron, face", moved(around_origin, {0, 0, 3}), {0, 0, 2}, 3},
           {"tetrahedron, oblique face", moved(around_origin, {-1, -1, -1}), {-2. / 3, -2. / 3, -2. / 3}, 3},
           {"tetrahedron, edge", moved(around_origin, {0, 3, 3}), {0, 2, 2}, 2},
           {"tetrahedron, corner", moved(around_origin, {3, 3, 3}), {2, 2, 2}, 1},
           {"tetrahedron, acute corner", moved(around_origin, {-6, 1, 1}), {-3, 0, 0}, 1}})
    check_region(region);
}

TEST_CASE("simplex: a tetrahedron around the origin is enclosing, with its margin", "[narrow][simplex]") {
  Points p = around_origin;
  std::vector<std::size_t> order{0, 1, 2, 3};
  do {
    for (std::size_t i = 0; i < 4; ++i) p[i] = around_origin[order[i]];
    CHECK(foot_of<Wide>(p).encloses);
    // The planes are x, y, z = −1 and x + y + z = 1.
    for (const Foot& f : {foot_of<double>(p), foot_of<float>(p)}) {
      CHECK(f.encloses);
      CHECK(f.margin <= 1 / std::sqrt(3.0) + 1e-7);
      CHECK(f.margin == Approx(1 / std::sqrt(3.0)).epsilon(1e-5));
    }
  } while (std::next_permutation(order.begin(), order.end()));
  // Barely inside, and barely outside, of the oblique face.
  for (const double off : {1e-9, -1e-9}) {
    const Points near = moved(around_origin, Vec3::Constant((off - 1) / 3));
    CHECK(foot_of<Wide>(near).encloses == (off > 0));
    const Foot f = foot_of<double>(near);
    CHECK(f.encloses == (off > 0));
    if (off > 0) CHECK(f.margin == Approx(off / std::sqrt(3.0)).epsilon(1e-4));
    if (off < 0) CHECK(f.point.norm() == Approx(-off / std::sqrt(3.0)).epsilon(1e-6));
  }
}

TEST_CASE("simplex: repeated, collinear and coplanar corners still have a nearest point",
          "[narrow][simplex]") {
  const Vec3 p(1, 2, 2), q(-1, 2, 2), r(0, 2, 5);
  struct Case {
    const char* name;
    Points points;
    Vec3 nearest;
  };
  for (const Case& c : std::vector<Case>{
           {"a point twice", {p, p}, p},
           {"a point three times", {p, p, p}, p},
           {"a point four times", {p, p, p, p}, p},
           {"an end twice", {p, p, q}, {0, 2, 2}},
           {"both ends twice", {p, q, p, q}, {0, 2, 2}},
           {"a corner twice", {p, q, r, r}, {0, 2, 2}},
           {"collinear", {{-1, 1, 0}, {0.25, 1, 0}, {2, 1, 0}}, {0, 1, 0}},
           {"collinear, beyond an end", {{1, 1, 0}, {2, 1, 0}, {4, 1, 0}}, {1, 1, 0}},
           {"four collinear", {{-1, 1, 0}, {0.25, 1, 0}, {2, 1, 0}, {5, 1, 0}}, {0, 1, 0}},
           {"coplanar, a square", {{-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}}, {0, 0, 3}},
           {"coplanar, one inside", {{-3, -3, 3}, {3, -3, 3}, {0, 3, 3}, {0, -1, 3}}, {0, 0, 3}},
           {"a plane through the origin", {{1, 1, 0}, {3, 1, 0}, {1, 3, 0}, {2, 2, 0}}, {1, 1, 0}},
           {"a sliver", {{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}, {0, 0, 1 + 0x1p-52}}, {0, 0, 1}}}) {
    int arithmetic = 0;
    for (const Foot& f : {foot_of<Wide>(c.points), foot_of<double>(c.points)}) {
      INFO(c.name << ", arithmetic " << arithmetic++);
      CHECK_FALSE(f.encloses);
      CHECK((f.point - c.nearest).norm() <= 1e-14);
      check_optimal(c.points, f, 1e-14);
    }
  }
}

TEST_CASE("simplex: the direction of a short foot between long edges is accurate", "[narrow][simplex]") {
  // A needle 2e7 long and 1e-3 wide, at distance 1: the foot's direction is that of its plane.
  const Points needle{{-1e7, 1, -1e-4}, {1e7, 1, -2e-4}, {3, 1, 1e-3}};
  // An edge of 2e8 at distance 1e-3.
  const Points edge{{-1e8, 1e-3, 0}, {1e8, 1e-3, 0}};
  for (const Foot& f : {foot_of<Wide>(needle), foot_of<double>(needle)}) {
    CHECK((f.point - Vec3(0, 1, 0)).norm() <= 1e-12);
    CHECK(std::abs(f.point.x()) <= 1e-15);
  }
  for (const Foot& f : {foot_of<Wide>(edge), foot_of<double>(edge)}) {
    CHECK((f.point - Vec3(0, 1e-3, 0)).norm() <= 1e-18);
    CHECK(f.corners == 2);
  }
}

TEST_CASE("simplex: random corners give the optimal point in both arithmetics", "[narrow][simplex]") {
  Rng r(2026);
  int enclosing = 0;
  int by_corners[5] = {0, 0, 0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    Points p;
    const auto n = 1 + r.below(4);
    const Vec3 shift = r.unit_vector() * r.uniform(0, 1.5);
    for (std::uint64_t k = 0; k < n; ++k) p.push_back(shift + r.unit_vector());
    const Foot wide = foot_of<Wide>(p), narrow = foot_of<double>(p);
    REQUIRE(wide.encloses == narrow.encloses);
    enclosing += wide.encloses;
    if (wide.encloses) {
      // The origin is on the inner side of every face.
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 &a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &c = p[(k + 3) % 4];
        const Vec3 normal = (b - a).cross(c - a).normalized();
        REQUIRE(normal.dot(-a) * normal.dot(p[k] - a) > 0);
        CHECK(narrow.margin <= std::abs(normal.dot(a)) + 1e-12);
      }
      continue;
    }
    ++by_corners[wide.corners];
    REQUIRE((wide.point - narrow.point).norm() <= 1e-9);
    check_optimal(p, wide, 1e-12);
    check_optimal(p, narrow, 1e-9);
  }
  CHECK(enclosing > 100);
  for (int n = 1; n <= 3; ++n) CHECK(by_corners[n] > 1000);
}

TEST_CASE("simplex: the normal of a triangle is across all its edges, needles included",
          "[narrow][simplex]") {
  const auto check = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& expected, double tolerance) {
    const WideVec wide[] = {a.cast<Wide>(), b.cast<Wide>(), c.cast<Wide>()};
    for (const Vec3& n : {Vec3(narrow::triangle_normal<Wide>(wide[0], wide[1], wide[2]).cast<double>()),
                          Vec3(narrow::upright_normal<Wide>(wide[0], wide[1], wide[2]).cast<double>()),
                          narrow::triangle_normal<double>(a, b, c), narrow::upright_normal<double>(a, b, c)})
      CHECK((n - expected).norm() <= tolerance * expected.norm());
  };
  // Each edge is the longest once; the length is twice the area.
  check({0, 0, 0}, {3, 0, 0}, {1, 1, 0}, {0, 0, 3}, 1e-15);
  check({1, 1, 0}, {0, 0, 0}, {3, 0, 0}, {0, 0, 3}, 1e-15);
  check({3, 0, 0}, {1, 1, 0}, {0, 0, 0}, {0, 0, 3}, 1e-15);
  check({0, 0, 0}, {1e7, 0, 0}, {5e6, 1, 0}, {0, 0, 1e7}, 1e-15);
  // Collinear: no normal.
  CHECK(narrow::triangle_normal<double>({0, 0, 0}, {1, 1, 1}, {3, 3, 3}).norm() == 0);
  CHECK(narrow::upright_normal<double>({0, 0, 0}, {1, 1, 1}, {3, 3, 3}).norm() == 0);
  // Of a needle in any direction, the upright one is orthogonal to the needle.
  Rng r(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 along = r.unit_vector() * 1e7, a = r.unit_vector(), b = a + along,
               c = a + along / 3 + r.unit_vector();
    const Vec3 n = narrow::upright_normal<double>(a, b, c).normalized();
    CHECK(std::abs(n.dot((b - a).normalized())) <= 4e-16);
  }
}
