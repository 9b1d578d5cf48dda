#include "scenarios/exhaustive/box_scene.h"

#include <cmath>
#include <limits>

#include "core/math/through_float.h"

namespace touchstone::fuzz {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Knuth's TwoSum: the rounding error of a + b is a double, even when it underflows.
bool sum_is_exact(double a, double b) {
  const double s = a + b, bb = s - a;
  return (a - (s - bb)) + (b - bb) == 0;
}

bool holds(double x, Scalar scalar) { return std::isfinite(x) && nearest(x, scalar) == x; }

// 0: identity; 1 and 2: about (1,1,1) by one and two thirds; 3: none of these.
unsigned thirds_of(const Quat& q) {
  if (q.x == 0 && q.y == 0 && q.z == 0) return 0;
  if (q.x != q.y || q.y != q.z || std::abs(q.w) != std::abs(q.x)) return 3;
  return q.w == q.x ? 1 : 2;
}

Vec3 turned(const Vec3& h, unsigned thirds) {
  if (thirds == 1) return {h.z(), h.x(), h.y()};
  if (thirds == 2) return {h.y(), h.z(), h.x()};
  return h;
}

std::optional<Aabb> half_space_box(const HalfSpace& s, const Pose& pose) {
  if (thirds_of(pose.rotation) != 0) return std::nullopt;
  Aabb box{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  for (int k = 0; k < 3; ++k) {
    if (s.normal[k] == 0) continue;
    if (std::abs(s.normal[k]) != 1 || std::abs(s.normal.sum()) != 1) return std::nullopt;
    const double at = pose.translation[k] + s.normal[k] * s.offset;
    (s.normal[k] > 0 ? box.hi : box.lo)[k] = at;
  }
  return box;
}

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

std::optional<Aabb> exact_box(const Shape& shape, const Pose& pose) {
  if (const auto* s = std::get_if<HalfSpace>(&shape)) return half_space_box(*s, pose);
  const auto* b = std::get_if<Box>(&shape);
  const unsigned thirds = thirds_of(pose.rotation);
  if (!b || thirds == 3) return std::nullopt;
  const Vec3 h = turned(b->half_extents, thirds);
  return Aabb{pose.translation - h, pose.translation + h};
}

Quat turn_by_thirds(unsigned thirds) {
  if (thirds == 1) return {1, 1, 1, 1};
  if (thirds == 2) return {1, 1, 1, -1};
  return {};
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
