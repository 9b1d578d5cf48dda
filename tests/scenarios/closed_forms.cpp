// The closed forms of pair scenarios against the definition, using only support functions: the signed gap of
// convex bodies is -min over unit n of w(n) = h_A(n) + h_B(-n). The stated normal must reach the stated gap,
// and no direction of a dense search may fall below it.
#include <cmath>

#include "core/math/rng.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/handmade/scenario.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// h(n), in double for the support point; the body frame direction is R^T n.
double support_value(const Shape& shape, const Pose& pose, const Vec3& n) {
  const Mat3 r = rotation_matrix(pose.rotation);
  const Vec3 d = r.transpose() * n;
  const double local = std::visit(
      [&](const auto& s) -> double {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, HalfSpace>) {
          // Finite only along the plane's normal.
          const bool along = s.normal.normalized().dot(d) > 1 - 1e-12;
          return along ? s.offset / s.normal.norm() : std::numeric_limits<double>::infinity();
        } else if constexpr (has_triangles<S>) {
          return std::nan("");
        } else {
          return support(s, d).dot(d);
        }
      },
      shape);
  return local + pose.translation.dot(n);
}

double width(const Scene& s, const Vec3& n) {
  const Vec3 apart = s.bodies[1].pose.translation - s.bodies[0].pose.translation;
  Pose a = s.bodies[0].pose, b = s.bodies[1].pose;
  // Far from the origin the translations cancel; take their difference first.
  a.translation.setZero();
  b.translation = apart;
  return support_value(s.shape_of(0), a, n) + support_value(s.shape_of(1), b, -n);
}

bool is_convex_pair(const Scene& s) { return !is_mesh(s.shape_of(0)) && !is_mesh(s.shape_of(1)); }

// Coordinates in the body frame count too: a hull may lie far from its origin.
double rounding_scale(const Scene& s) { return scale_of_pair(s, 0, 1); }

struct Checked {
  int by_normal = 0, by_search = 0;
};

void check(const Case& c, const Expectation& e, Checked& n) {
  const Scene& s = c.scene;
  if (!e.gap || !is_convex_pair(s)) return;
  // w is a sum of about ten rounded products.
  const double allowed = e.gap->tolerance + 0x1p-48 * rounding_scale(s);
  if (e.normal) {
    INFO("w(normal) = " << width(s, *e.normal) << ", gap " << e.gap->value);
    CHECK(std::abs(width(s, *e.normal) + e.gap->value) <= allowed);
    ++n.by_normal;
  }
  // Only the plane's own direction can separate something from a half-space.
  for (const Shape& shape : s.shapes)
    if (kind_of(shape) == ShapeKind::half_space) return;
  Rng rng(20);
  double least = std::numeric_limits<double>::infinity();
  const Vec3 around = e.normal ? *e.normal : Vec3::UnitX();
  for (int i = 0; i < 4000; ++i) {
    // Half everywhere, half close to the stated normal, at all scales down to 2^-30.
    const Vec3 v = rng.unit_vector();
    const Vec3 d = i % 2 ? v : Vec3((around + v * std::ldexp(1.0, -(i / 2 % 30))).normalized());
    least = std::min(least, width(s, d));
  }
  INFO("least w found " << least << ", gap " << e.gap->value);
  CHECK(least >= -e.gap->value - allowed);
  ++n.by_search;
}

}  // namespace

TEST_CASE("the stated gap and normal of every convex scenario satisfy the definition",
          "[scenarios][closed-form]") {
  Checked n;
  for (const auto& s : scenarios::catalog()) {
    INFO(s.folder << "/" << s.name);
    check(s.make(), s.expect, n);
  }
  INFO(n.by_normal << " by their normal, " << n.by_search << " by search");
  CHECK(n.by_normal >= 90);
  CHECK(n.by_search >= 90);
}

TEST_CASE("no direction contradicts the gap of a corpus case", "[scenarios][corpus][closed-form]") {
  Checked n;
  for (const StoredCase& s : scenarios::load_corpus(TS_SOURCE_DIR "/scenarios/corpus")) {
    INFO(s.c.id);
    check(s.c, s.expect, n);
  }
  CHECK(n.by_search >= 20);
}
