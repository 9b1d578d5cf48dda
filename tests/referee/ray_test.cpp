// Rays at cylinders, cones and ellipsoids, which are decided exactly: closed forms at exact touch and one ulp
// to either side of it, where the path grazes a side, an end, a rim, an apex, and where it starts or ends.
#include "oracles/referee/exact/ray.h"
#include "core/math/roundoff.h"
#include "oracles/checker/checker.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

using Hit = TimeTruth::Verdict;
/// A path in the body's own coordinates that shares one point with the body, at time `touch`. Moving its
/// start by an ulp along `outward` makes it miss, and against it hit.
struct Touch {
  const char* name;
  Shape shape;
  Vec3 start, way;
  int axis;
  double outward, touch;
};

const std::vector<Touch>& touches() {
  static const std::vector<Touch> all{
      {"side of a cylinder", Cylinder{1, 2}, {-5, 1, 0.5}, {10, 0, 0}, 1, 1, 0.5},
      {"oblique side of a cylinder", Cylinder{5, 2}, {7, 1, 0.25}, {-8, 6, 0.5}, 0, 1, 0.5},
      {"end of a cylinder", Cylinder{1, 2}, {-5, 0.25, 2}, {8, 0, 0}, 2, 1, 0},
      {"rim of a cylinder", Cylinder{5, 2}, {0, 0, 7}, {6, 8, -10}, 2, 1, 0.5},
      {"rim of a cylinder from below", Cylinder{5, 2}, {0, 0, -7}, {6, 8, 10}, 2, -1, 0.5},
      {"rim of a disc", Cylinder{5, 0}, {0, 0, 5}, {6, 8, -10}, 2, 1, 0.5},
      {"rim of a disc that is a cone", Cone{5, 0}, {0, 0, 5}, {6, 8, -10}, 2, 1, 0.5},
      {"side of a cone", Cone{3, 2}, {1.5, -5, 0}, {0, 10, 0}, 0, 1, 0.5},
      {"oblique side of a cone", Cone{3, 2}, {4.5, -5, -4}, {-6, 10, 8}, 0, 1, 0.5},
      {"apex of a cone", Cone{3, 2}, {-4, 0, 2}, {8, 0, 0}, 2, 1, 0.5},
      {"apex of a cone, descending", Cone{3, 2}, {-4, 2, 3}, {8, -4, -2}, 2, 1, 0.5},
      {"rim of a cone", Cone{3, 2}, {0, 0, -5}, {6, 0, 6}, 2, -1, 0.5},
      {"ellipsoid", Ellipsoid{{5, 10, 15}}, {5, 5, -1}, {-4, 6, 2}, 0, 1, 0.5},
      {"ellipsoid, long axis", Ellipsoid{{1, 1, 64}}, {-3, 0, 64}, {6, 0, 0}, 2, 1, 0.5},
      {"end on a cylinder", Cylinder{1, 2}, {4, 0, 0}, {-3, 0, 0}, 0, 1, 1},
      {"end on an apex", Cone{3, 2}, {0, 0, 8}, {0, 0, -6}, 2, 1, 1},
      {"start on an ellipsoid", Ellipsoid{{1, 2, 3}}, {0, 0, 3}, {1, 1, 1}, 2, 1, 0}};
  return all;
}

struct Posed {
  const char* name;
  std::variant<Pose, Placement> pose;
};

/// Placements that map small integers to doubles exactly; the first one keeps every double.
std::vector<Posed> poses() {
  Placement sheared{Mat3::Identity(), Vec3(1, 2, 3)};
  sheared.matrix << 1, 2, 0, 0, -1, 0.5, 0, 0, 4;
  return {
      {"at rest", Pose{}}, {"turned by 180 degrees", Pose{{0, 0, 0}, {1, 0, 0, 0}}}, {"sheared", sheared}};
}

Vec3 vector_in(const std::variant<Pose, Placement>& pose, const Vec3& v) {
  if (const auto* p = std::get_if<Pose>(&pose)) return rotation_matrix(p->rotation) * v;
  return std::get<Placement>(pose).matrix * v;
}
Vec3 translation_in(const std::variant<Pose, Placement>& pose) {
  return std::visit([](const auto& p) -> Vec3 { return p.translation; }, pose);
}

const Shape point_shape = Sphere{0};

/// A ray and its body, in either order, with the truth and a certificate.
struct Cast {
  Placed a, b;
  Motion ma, mb;
  TimeTruth truth;
  ImpactCertificate certificate;

  Cast(const Placed& body, const Vec3& start, const Vec3& way, bool ray_first) {
    const Placed point{&point_shape, Pose{start, {}}};
    // Both also travel together.
    const Vec3 both(ray_first ? Vec3(0, 0, 0) : Vec3(64, -32, 16));
    a = ray_first ? point : body;
    b = ray_first ? body : point;
    ma = {ray_first ? Vec3(way + both) : both, Vec3::Zero()};
    mb = {ray_first ? both : Vec3(way + both), Vec3::Zero()};
    truth = judge_motion(a, ma, b, mb);
    certificate = impact_certificate(a, ma, b, mb, truth);
  }
  bool accepts() const { return checker::check(certificate, a, ma, b, mb); }
};

void require_certified(const Cast& c) {
  REQUIRE(c.accepts());
  REQUIRE(c.certificate.contact.has_value() == (c.truth.verdict == Hit::hit));
  const double until = c.truth.verdict == Hit::none ? 1 : c.truth.t_lo;
  REQUIRE(c.certificate.tracks.empty() == (until == 0));
  if (until > 0) REQUIRE(c.certificate.clear_until == until);
}

double nextafter_by(double x, double towards) { return std::nextafter(x, towards * infinity); }

}  // namespace

TEST_CASE("a ray that touches a curved body in one point hits it there", "[referee][motion][ray][exact]") {
  for (const Touch& t : touches())
    for (const Posed& p : poses())
      for (const bool ray_first : {false, true}) {
        INFO(t.name << ", " << p.name << ", ray " << (ray_first ? "first" : "second"));
        const Placed body{&t.shape, p.pose};
        const Cast c(body, translation_in(p.pose) + vector_in(p.pose, t.start), vector_in(p.pose, t.way),
                     ray_first);
        REQUIRE(c.truth.verdict == Hit::hit);
        if (t.touch == 0.5 || t.touch == 1) {
          REQUIRE(c.truth.t_lo == std::nextafter(t.touch, 0));
          REQUIRE(c.truth.t_hi == t.touch);
        }
        require_certified(c);
      }
}

TEST_CASE("a ray one ulp farther out misses, and one ulp farther in hits", "[referee][motion][ray][exact]") {
  for (const Touch& t : touches())
    for (const int side : {-1, 1})
      for (const bool ray_first : {false, true}) {
        INFO(t.name << ", ray " << (ray_first ? "first" : "second") << ", side " << side);
        const Placed body{&t.shape, Pose{}};
        Vec3 start = t.start;
        // From zero, an ulp of 1: the difference must not be lost in what is added to it.
        start[t.axis] =
            start[t.axis] == 0 ? side * t.outward * 0x1p-52 : nextafter_by(start[t.axis], side * t.outward);
        const Cast c(body, start, t.way, ray_first);
        REQUIRE(c.truth.verdict == (side > 0 ? Hit::none : Hit::hit));
        if (side > 0) {
          REQUIRE(c.truth.least_gap.lo >= 0);
          REQUIRE(c.truth.least_gap.hi < 1e-13);
        }
        require_certified(c);
      }
}

TEST_CASE("times of rays are those of the closed form, between neighbouring doubles",
          "[referee][motion][ray][exact]") {
  const Shape cylinder = Cylinder{1, 2};
  for (const double y : {0.0, 0.5, 1 - 0x1p-53, 1 - 0x1p-30}) {
    const Cast c({&cylinder, Pose{}}, {-5, y, 0}, {10, 0, 0}, false);
    const long double t = (5 - std::sqrt((1 - static_cast<long double>(y)) * (1 + y))) / 10;
    INFO(y);
    REQUIRE(c.truth.verdict == Hit::hit);
    REQUIRE(c.truth.t_hi <= std::nextafter(c.truth.t_lo, 1.0));
    REQUIRE(c.truth.t_lo <= t + 1e-18L);
    REQUIRE(c.truth.t_hi >= t - 1e-18L);
  }
}

TEST_CASE("rays that start in a body, lie in its surface, or do not move", "[referee][motion][ray][exact]") {
  const Shape cone = Cone{3, 2}, disc = Cylinder{5, 0}, flat = Ellipsoid{{2, 3, 0}};
  const auto cast = [](const Shape& s, const Vec3& start, const Vec3& way) {
    return judge_motion({&s, Pose{}}, Motion{}, {&point_shape, Pose{start, {}}}, {way, Vec3::Zero()});
  };
  REQUIRE(cast(cone, {0, 0, 1}, {0, 0, 9}).t_hi == 0);
  REQUIRE(cast(cone, {0, 0, 2}, {0, 0, 0}).verdict == Hit::hit);
  REQUIRE(cast(cone, {0, 0, std::nextafter(2.0, 3.0)}, {0, 0, 0}).verdict == Hit::none);
  REQUIRE(cast(cone, {6, 0, -6}, {-8, 0, 12}).verdict == Hit::none);  // parallel to the side, outside
  REQUIRE(cast(cone, {6, 0, -6}, {-9, 0, 12}).verdict == Hit::hit);   // along the side
  REQUIRE(cast(cone, {6, 0, -6}, {-9, 0, 12}).t_hi == std::nextafter(1.0 / 3, 1.0));
  REQUIRE(cast(disc, {-10, 0, 0}, {20, 0, 0}).t_hi == 0.25);  // in the disc's plane
  REQUIRE(cast(disc, {-10, 0, 0x1p-1000}, {20, 0, 0}).verdict == Hit::none);
  REQUIRE(cast(flat, {0, 0, 1}, {2, 0, -1}).t_hi == 1);
  REQUIRE(cast(flat, {0, 0, 1}, {2.5, 0, -1}).verdict == Hit::none);
}

TEST_CASE("no ray that grazes a turned body is undecided, and its certificate holds",
          "[referee][motion][ray]") {
  Rng r(24);
  int hits = 0, none = 0;
  for (int i = 0; i < 300; ++i) {
    const Shape s = random_convex(r, tested_kinds[4 + i % 3]);
    const Pose pose{r.vector(0, 2), r.rotation()};
    const Vec3 n = r.unit_vector(), way = perpendicular(Double3{n.x(), n.y(), n.z()}).x * r.unit_vector();
    // Through the farthest point along n, across n up to rounding.
    const Vec3 across = way - n.dot(way) * n, far = world_support(s, pose, n);
    const Cast c({&s, pose}, far - 0.5 * across, across, i % 2 == 0);
    INFO(i << " " << type_name(s));
    REQUIRE(c.truth.verdict != Hit::undecided);
    (c.truth.verdict == Hit::hit ? hits : none) += 1;
    if (c.truth.verdict == Hit::hit) {
      REQUIRE(c.truth.t_hi <= std::nextafter(std::nextafter(c.truth.t_lo, 2.0), 2.0));
      REQUIRE(gap_at(c.a, c.ma, c.b, c.mb, c.truth.t_hi).lo < 1e-15);
    }
    require_certified(c);
  }
  REQUIRE(hits > 30);
  REQUIRE(none > 30);
}

TEST_CASE("signs of quadratics at each other's roots are exact", "[referee][exact][ray]") {
  const Quadratic two{{-2, 0, 1}};  // roots ±√2
  const auto roots = roots_of(two);
  REQUIRE(roots.size() == 2);
  for (const QuadraticRoot& t : roots) REQUIRE(sign_at(two, t) == 0);
  REQUIRE(
      sign_at({{Rational("-141421356237309504880168872421"), Rational("100000000000000000000000000000"), 0}},
              roots[1]) < 0);
  REQUIRE(
      sign_at({{Rational("-141421356237309504880168872420"), Rational("100000000000000000000000000000"), 0}},
              roots[1]) > 0);
  REQUIRE(sign_at({{4, 0, -2}}, roots[0]) == 0);
  REQUIRE(roots_of({{1, 0, 1}}).empty());
  REQUIRE(roots_of({{7, 0, 0}}).empty());
  double lo = 0, hi = 0;
  enclose(roots_of({{Rational(-1) / 2, 0, 1}})[1], lo, hi);
  REQUIRE(hi == std::nextafter(lo, 1.0));
  REQUIRE(lo * lo <= 0.5);
  enclose(roots_of({{Rational(-1) / 4, 0, 1}})[1], lo, hi);
  REQUIRE(lo == 0.5);
  REQUIRE(hi == 0.5);
}

}  // namespace touchstone::referee_test
