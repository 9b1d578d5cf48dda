// Outlines of supporting faces, in doubles and in extended precision: order, clipping, common parts of edges.
#include "core/narrow/outline.h"

#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::narrow::outline;

namespace {

using Point = std::array<double, 2>;

template <class R>
Corners<R> outline_of(const std::vector<Point>& points) {
  Corners<R> c;
  for (const auto& [x, y] : points) c.add({R(x), R(y), R(0), static_cast<std::uint32_t>(c.size + 1), 0});
  return c;
}

template <class R>
std::vector<Point> points_of(const Corners<R>& c) {
  std::vector<Point> r;
  for (const Corner<R>& k : c) r.push_back({static_cast<double>(k.x), static_cast<double>(k.y)});
  return r;
}

// Twice the area; positive: counter-clockwise.
template <class R>
double area_of(const Corners<R>& c) {
  R sum = 0;
  for (int i = 0; i < c.size; ++i) {
    const Corner<R>&a = c[i], &b = c[(i + 1) % c.size];
    sum += a.x * b.y - a.y * b.x;
  }
  return static_cast<double>(sum);
}

constexpr double tolerance = 1e-12;

template <class R>
Corners<R> ordered(const std::vector<Point>& points) {
  Corners<R> c = outline_of<R>(points);
  convex_order(c, R(tolerance));
  return c;
}

template <class R>
Corners<R> clipped(const std::vector<Point>& subject, const std::vector<Point>& window) {
  Corners<R> c = outline_of<R>(subject);
  clip(c, outline_of<R>(window), R(tolerance), true);
  return c;
}

const std::vector<Point> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};

}  // namespace

TEMPLATE_TEST_CASE("outline: convex order is counter-clockwise, without points on edges or inside",
                   "[narrow][outline]", float, double, Wide) {
  const std::vector<Point> mixed{{1, 1}, {2, 2}, {0, 0}, {1, 0}, {0, 2}, {2, 0}, {0.5, 1.5}};
  CHECK(points_of(ordered<TestType>(mixed)) == square);
  CHECK(area_of(ordered<TestType>(mixed)) == 8);
  const std::vector<Point> line{{1, 1}, {0, 0}, {2, 2}};
  CHECK(points_of(ordered<TestType>(line)) == std::vector<Point>{{0, 0}, {2, 2}});
  CHECK(ordered<TestType>({{1, 1}, {1, 1 + tolerance / 4}}).size == 1);
  CHECK(ordered<TestType>({{1, 1}}).size == 1);
}

TEMPLATE_TEST_CASE("outline: two corners are ordered by x, then by y, and are one where they coincide",
                   "[narrow][outline]", float, double, Wide) {
  using R = TestType;
  const Corners<R> by_x = ordered<R>({{2, 1}, {0, 5}}), by_y = ordered<R>({{1, 3}, {1, -3}});
  REQUIRE(by_x.size == 2);
  CHECK(by_x[0].x == R(0));
  CHECK(by_x[0].y == R(5));
  CHECK(by_x[1].x == R(2));
  REQUIRE(by_y.size == 2);
  CHECK(by_y[0].y == R(-3));
  CHECK(by_y[1].y == R(3));
  const Corners<R> one = ordered<R>({{1, 1}, {1 - tolerance / 4, 1 + tolerance / 4}});
  REQUIRE(one.size == 1);
  CHECK(one[0].x <= R(1));
  CHECK(ordered<R>({{1, 1}, {1, 1.5}}).size == 2);
}

TEMPLATE_TEST_CASE("outline: clipping keeps what is inside the window", "[narrow][outline]", float, double,
                   Wide) {
  using Points = std::vector<Point>;
  // A square turned by 45°, on whose edges the window's corners lie.
  CHECK(points_of(clipped<TestType>({{1, -1}, {3, 1}, {1, 3}, {-1, 1}}, square)) ==
        Points{{2, 0}, {2, 2}, {0, 2}, {0, 0}});
  CHECK(points_of(clipped<TestType>({{1, 1}, {3, 1}, {3, 3}, {1, 3}}, square)) ==
        Points{{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  CHECK(points_of(clipped<TestType>({{-1, 1}, {3, 1}}, square)) == Points{{0, 1}, {2, 1}});
  CHECK(clipped<TestType>({{3, 0}, {4, 0}, {4, 1}}, square).size == 0);
  // A common edge stays, up to the tolerance.
  CHECK(clipped<TestType>({{0, -1}, {2, -1}, {2, tolerance / -4}, {0, 0}}, square).size == 2);
}

TEMPLATE_TEST_CASE("outline: two edges have an interval in common, or none", "[narrow][outline]", float,
                   double, Wide) {
  using Points = std::vector<Point>;
  const auto common = [](const Points& a, const Points& b) {
    const Corners<TestType> x = outline_of<TestType>(a), y = outline_of<TestType>(b);
    const EdgePair<TestType> e(x, y);
    REQUIRE(e.is_collinear(TestType(tolerance)));
    return points_of(e.common(7));
  };
  CHECK(common({{0, 1}, {4, 1}}, {{5, 1}, {3, 1}}) == Points{{3, 1}, {4, 1}});
  CHECK(common({{0, 1}, {4, 1}}, {{1, 1}, {2, 1}}) == Points{{1, 1}, {2, 1}});
  CHECK(common({{0, 1}, {4, 1}}, {{5, 1}, {6, 1}}).empty());
  const auto a = outline_of<TestType>({{0, 0}, {4, 0}}), b = outline_of<TestType>({{1, -1}, {1, 3}});
  const EdgePair<TestType> crossing(a, b);
  CHECK_FALSE(crossing.is_collinear(TestType(tolerance)));
  CHECK(static_cast<double>(crossing.s0) == -1);
  CHECK(static_cast<double>(crossing.s1) == 3);
}

TEST_CASE("outline: storage is bounded in double, and not in extended precision", "[narrow][outline]") {
  Corners<double> narrow;
  Corners<Wide> wide;
  for (int i = 0; i <= Corners<double>::capacity; ++i) {
    CHECK_FALSE(narrow.overflow);
    narrow.add({static_cast<double>(i), 0, 0, 0, 0});
    wide.add({Wide(i), 0, 0, 0, 0});
  }
  CHECK(narrow.overflow);
  CHECK(narrow.size == Corners<double>::capacity);
  CHECK_FALSE(wide.overflow);
  CHECK(wide.size == Corners<double>::capacity + 1);
  const Corners<Wide> copy = wide;
  CHECK(copy.size == wide.size);
  CHECK(copy[wide.size - 1].x == Wide(Corners<double>::capacity));
}

TEMPLATE_TEST_CASE("outline: an edge crosses the window's boundary once, twice or not at all",
                   "[narrow][outline]", float, double, Wide) {
  using R = TestType;
  const auto crossings = [](const Point& from, const Point& to) {
    const auto corner = [](const Point& p) { return Corner<R>{R(p[0]), R(p[1]), R(0), 0, 0}; };
    const Crossings<R> c = crossings_of(corner(from), corner(to), outline_of<R>(square), R(tolerance));
    std::vector<Point> out;
    for (const auto& [share, border] : {std::pair(c.enters, c.entrance), std::pair(c.leaves, c.exit)}) {
      const double t = static_cast<double>(share);
      if (border >= 0) out.push_back({from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t});
    }
    return out;
  };
  CHECK(crossings({1, 1}, {3, 1}) == std::vector<Point>{{2, 1}});
  CHECK(crossings({-1, 1}, {1, 1}) == std::vector<Point>{{0, 1}});
  CHECK(crossings({-2, 0.5}, {6, 0.5}) == std::vector<Point>{{0, 0.5}, {2, 0.5}});
  CHECK(crossings({1, 3}, {3, 1}) == std::vector<Point>{});  // passes a corner
  CHECK(crossings({1, 2.5}, {3, 0.5}) == std::vector<Point>{{1.5, 2}, {2, 1.5}});
  CHECK(crossings({0.5, 0.5}, {1.5, 1}) == std::vector<Point>{});  // inside
  CHECK(crossings({3, 3}, {4, 5}) == std::vector<Point>{});
  CHECK(crossings({1, 1}, {2, 1}) == std::vector<Point>{});      // ends on the boundary
  CHECK(crossings({2, 0.5}, {2, 1.5}) == std::vector<Point>{});  // runs along it
  const auto holds_point = [](double x, double y) {
    return holds(outline_of<R>(square), Corner<R>{R(x), R(y), 0, 0, 0}, R(tolerance));
  };
  CHECK(holds_point(1, 1));
  CHECK(holds_point(2, 2));
  CHECK_FALSE(holds_point(2.25, 1));
  CHECK_FALSE(holds_point(1, -0.25));
}
