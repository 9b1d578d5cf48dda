#include "scenarios/exhaustive/box_scene.h"

#include <cmath>

#include "core/math/roundoff.h"
#include "core/math/through_float.h"

namespace touchstone::fuzz {
namespace {

// Knuth's TwoSum: the rounding error of a + b is a double, even when it underflows.
bool sum_is_exact(double a, double b) {
  const double s = a + b, bb = s - a;
  return (a - (s - bb)) + (b - bb) == 0;
}

bool holds(double x, Scalar scalar) { return std::isfinite(x) && nearest(x, scalar) == x; }

}  // namespace

double nearest(double x, Scalar scalar) { return scalar == Scalar::float64 ? x : through_float(x); }

double next_number(double x, int direction, Scalar scalar) {
  const double to = direction < 0 ? -infinity : infinity;
  if (scalar == Scalar::float64) return std::nextafter(x, to);
  return static_cast<double>(std::nextafter(static_cast<float>(x), static_cast<float>(to)));
}

double unit_in_last_place(Scalar scalar) { return scalar == Scalar::float64 ? 0x1p-52 : 0x1p-23; }

std::optional<Aabb> exact_corners(const Vec3& t, const Vec3& h, Scalar scalar) {
  for (int k = 0; k < 3; ++k) {
    if (!(h[k] >= 0) || !sum_is_exact(t[k], h[k]) || !sum_is_exact(t[k], -h[k])) return std::nullopt;
    for (const double x : {t[k], h[k], t[k] - h[k], t[k] + h[k]})
      if (!holds(x, scalar)) return std::nullopt;
  }
  return Aabb{t - h, t + h};
}

std::optional<Placing> placing_of(Aabb box, Scalar scalar) {
  // The middle of two neighbouring numbers is not representable: the upper end may have to move on by one or
  // two.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Placing p{box.lo / 2 + box.hi / 2, box.hi / 2 - box.lo / 2};
    if (exact_corners(p.t, p.h, scalar)) return p;
    for (int k = 0; k < 3; ++k) {
      const double t = p.t[k], h = p.h[k];
      if (!exact_corners(Vec3::Constant(t), Vec3::Constant(h), scalar))
        box.hi[k] = next_number(box.hi[k], 1, scalar);
    }
  }
  return std::nullopt;
}

int add_box(Scene& s, const Placing& p, bool fixed) {
  Body b;
  b.shape = static_cast<int>(s.shapes.size());
  b.pose.translation = p.t;
  b.is_static = fixed;
  s.shapes.push_back(Box{p.h});
  s.bodies.push_back(std::move(b));
  return static_cast<int>(s.bodies.size()) - 1;
}

void insert_all(Scene& s) {
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) step_insert(s, i);
}

}  // namespace touchstone::fuzz
