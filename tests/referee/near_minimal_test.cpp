// The directions in which bodies separate about equally soon, against closed forms.
#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

bool has(const NearMinimalNormals& r, const Vec3& n) {
  for (const Vec3& m : r.normals)
    if ((m - n).norm() < 1e-6) return true;
  return false;
}

}  // namespace

TEST_CASE("a cube's centre in a cube: six directions, the next much worse", "[referee][normals]") {
  const Shape outer = Box{{1, 1, 1}}, inner = Box{{0.25, 0.25, 0.25}};
  const NearMinimalNormals r = near_minimal_normals({&outer, Pose{}}, {&inner, Pose{}});
  REQUIRE(r.certified);
  REQUIRE_FALSE(r.continuum);
  REQUIRE(r.normals.size() == 6);
  for (int k = 0; k < 3; ++k) {
    REQUIRE(has(r, Vec3::Unit(k)));
    REQUIRE(has(r, -Vec3::Unit(k)));
  }
  for (double w : r.widths) REQUIRE(std::abs(w - 1.25) < 1e-15);
}

TEST_CASE("a box off the middle of a box: one direction, and the second best is that of the next face",
          "[referee][normals]") {
  const Shape outer = Box{{3, 2, 1}}, inner = Box{{0.5, 0.25, 0.125}};
  const NearMinimalNormals r =
      near_minimal_normals({&outer, Pose{{1, 2, 3}, {}}}, {&inner, Pose{{1.5, 2.25, 3.0625}, {}}});
  REQUIRE(r.certified);
  REQUIRE(r.normals.size() == 1);
  REQUIRE(has(r, Vec3(0, 0, 1)));
  REQUIRE(std::abs(r.depth - (1.125 - 0.0625)) < 1e-15);
  REQUIRE(std::abs(r.second_best - (1.125 + 0.0625)) < 1e-15);
  REQUIRE(std::abs(r.conditioning - 0.125) < 1e-15);
}

TEST_CASE("within the slack faces count as equal, beyond it as second best", "[referee][normals]") {
  const Shape box = Box{{1, 1, 1}}, ball = Sphere{0.25};
  for (const auto& [off, count] : {std::pair{1e-8, 6}, std::pair{1e-5, 5}}) {
    const NearMinimalNormals r = near_minimal_normals({&box, Pose{}}, {&ball, Pose{{-off, 0, 0}, {}}});
    CAPTURE(off, r.slack, r.second_best);
    REQUIRE(r.certified);
    // -x is best by `off`; the four sideways ones follow at `off`, +x at twice that.
    REQUIRE(static_cast<int>(r.normals.size()) == (off < 1e-6 ? count : 1));
    REQUIRE(has(r, Vec3(-1, 0, 0)));
    if (off > 1e-6) REQUIRE(std::abs(r.conditioning - off) < 1e-15);
  }
}

TEST_CASE("concentric spheres have a continuum of directions, eccentric ones a single direction",
          "[referee][normals]") {
  const Shape a = Sphere{1}, b = Sphere{0.5};
  const NearMinimalNormals all = near_minimal_normals({&a, Pose{}}, {&b, Pose{}});
  REQUIRE(all.continuum);
  REQUIRE_FALSE(all.certified);
  REQUIRE(all.normals.size() > 100);
  for (double w : all.widths) REQUIRE(std::abs(w - 1.5) < 1e-15);
  const NearMinimalNormals one = near_minimal_normals({&a, Pose{}}, {&b, Pose{{0.25, 0, 0}, {}}});
  REQUIRE_FALSE(one.continuum);
  REQUIRE(one.normals.size() == 1);
  REQUIRE(has(one, Vec3(1, 0, 0)));
}

TEST_CASE("parallel capsules beside each other have one direction, found at a sharp minimum",
          "[referee][normals]") {
  const Shape a = Capsule{1, 1};
  for (const double off : {0.5, 1e-3, 1.5}) {
    const NearMinimalNormals r = near_minimal_normals({&a, Pose{}}, {&a, Pose{{off, 0, 0}, {}}});
    INFO(off);
    REQUIRE_FALSE(r.continuum);
    REQUIRE(r.normals.size() == 1);
    CHECK((r.normals[0] - Vec3(1, 0, 0)).norm() < 1e-3);
    CHECK(std::abs(r.widths[0] - (2 - off)) < 1e-6);
    CHECK(r.second_best > 2 - off);
  }
}

TEST_CASE("a ball on a cylinder's axis leaves in every lateral direction, or in two along the axis",
          "[referee][normals]") {
  const Shape tall = Cylinder{1, 3}, flat = Cylinder{3, 1}, ball = Sphere{0.5};
  const NearMinimalNormals round = near_minimal_normals({&tall, Pose{}}, {&ball, Pose{}});
  REQUIRE(round.continuum);
  for (const Vec3& n : round.normals) REQUIRE(std::abs(n.z()) < 1e-3);
  const NearMinimalNormals two = near_minimal_normals({&flat, Pose{}}, {&ball, Pose{}});
  REQUIRE_FALSE(two.continuum);
  REQUIRE(two.normals.size() == 2);
  REQUIRE(has(two, Vec3(0, 0, 1)));
  REQUIRE(has(two, Vec3(0, 0, -1)));
}

TEST_CASE("random boxes: the listed directions and the second best are those of the fifteen axes",
          "[referee][normals]") {
  Rng r(9);
  int judged = 0;
  for (int i = 0; i < 400; ++i) {
    const auto s = [&] { return r.uniform(0.2, 1); };
    const Shape x = Box{{s(), s(), s()}}, y = Box{{s(), s(), s()}};
    const Pose px{r.vector(0, 1), r.rotation()}, py{px.translation + r.vector(0, 0.4), r.rotation()};
    const Placed a{&x, px}, b{&y, py};
    if (judge_pair(a, b).verdict != Verdict::overlap) continue;
    const NearMinimalNormals n = near_minimal_normals(a, b);
    REQUIRE(n.certified);
    ++judged;
    const Mat3 ma = rotation_matrix(px.rotation), mb = rotation_matrix(py.rotation);
    std::vector<Vec3> axes;
    for (int k = 0; k < 3; ++k) {
      axes.push_back(ma.col(k));
      axes.push_back(mb.col(k));
    }
    for (int k = 0; k < 9; ++k) axes.push_back(ma.col(k / 3).cross(mb.col(k % 3)).normalized());
    double least = 1e9;
    for (const Vec3& m : axes)
      for (const double sign : {1.0, -1.0}) least = std::min(least, width(a, b, sign * m).hi);
    REQUIRE(std::abs(least - n.depth) < 1e-14);
    // The second best is one of the axes' values, and no direction near another local minimum does better.
    bool is_axis = !std::isfinite(n.second_best);
    for (const Vec3& m : axes)
      for (const double sign : {1.0, -1.0})
        is_axis |= std::abs(width(a, b, sign * m).hi - n.second_best) < 1e-13;
    REQUIRE(is_axis);
    REQUIRE(n.conditioning >= n.slack);
    for (std::size_t k = 0; k < n.normals.size(); ++k) {
      const Bracket w = width(a, b, n.normals[k]);
      REQUIRE(w.lo <= n.widths[k] + 1e-14);
      REQUIRE(w.hi >= n.widths[k] - 1e-14);
      // A local minimum: w is not smaller slightly to either side.
      for (int j = 0; j < 8; ++j) {
        const Vec3 beside = (n.normals[k] + 1e-4 * r.unit_vector()).normalized();
        REQUIRE(width(a, b, beside).hi >= w.lo - 1e-14);
      }
    }
  }
  REQUIRE(judged > 200);
}

TEST_CASE("separate bodies have one direction, with unbounded conditioning", "[referee][normals]") {
  const Shape a = Box{{1, 1, 1}}, b = Cone{0.5, 1};
  const NearMinimalNormals r = near_minimal_normals({&a, Pose{}}, {&b, Pose{{4, 0.1, 0.2}, {}}});
  REQUIRE(r.certified);
  REQUIRE(r.normals.size() == 1);
  REQUIRE(std::isinf(r.conditioning));
}

}  // namespace touchstone::referee_test
