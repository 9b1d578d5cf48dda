#include "core/impact/filtered/mover.h"

#include <cmath>

#include "core/math/axis_rotation.h"

namespace touchstone::impact::filtered {
namespace {

// Covers the rounding of products and a root of doubles many times over.
constexpr double inflation = 1 + 0x1p-46;
// Rounding of the axis in the body's frame, in u: of the rotation, the axis and their product.
constexpr int axis_rounding = 16;

void set_turn(Mover& m, const Vec& angular) {
  if (is_point(m)) return;
  const WideVec w = angular.cast<Wide>();
  m.speed_wide = wide_norm(w);
  m.speed = static_cast<double>(m.speed_wide);
  if (!(m.speed > 0)) return;
  m.turns = true;
  m.angular = angular;
  m.axis_wide = w / m.speed_wide;
  m.axis = m.axis_wide.cast<double>();
  const Vec local = m.start.transpose() * m.axis;
  const double off_axis = on_core(m.body, [&](const auto& core) { return core.reach_off_axis(local); });
  m.off_axis = off_axis * inflation + axis_rounding * u<double> * m.body.reach;
  m.up = local.dot(support_local<double>(m.body, local));
  m.down = -local.dot(support_local<double>(m.body, -local));
}

}  // namespace

WideMat rotation_of(const Quat& any) {
  const Quat q = in_range_of_wide(any);
  const Wide x = q.x, y = q.y, z = q.z, w = q.w;
  const Wide k = 1 / (x * x + y * y + z * z + w * w), k2 = 2 * k;
  const Wide xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  WideMat r;
  r << (ww + xx - yy - zz) * k, (x * y - w * z) * k2, (x * z + w * y) * k2,  //
      (x * y + w * z) * k2, (ww - xx + yy - zz) * k, (y * z - w * x) * k2,   //
      (x * z - w * y) * k2, (y * z + w * x) * k2, (ww - xx - yy + zz) * k;
  return r;
}

Mover make_mover(const ShapeRef& shape, const WideMat& rotation, const Motion& motion) {
  Mover m;
  m.body = shape.body<double>();
  m.start_wide = rotation;
  m.start = rotation.cast<double>();
  m.linear = motion.linear;
  set_turn(m, motion.angular);
  return m;
}

Mover make_points(std::span<const Vec3> points, const WideMat& rotation, const Motion& motion) {
  Mover m;
  m.body = body_of_vertices<double>(points);
  m.start_wide = rotation;
  m.start = rotation.cast<double>();
  m.linear = motion.linear;
  set_turn(m, motion.angular);
  return m;
}

Mat rotation_at(const Mover& m, double t, bool precise) {
  if (!m.turns || t == 0) return m.start;
  if (!precise) {
    const double angle = m.speed * t;
    return rotation_about<double>(m.axis, angle) * m.start;
  }
  const Wide angle = m.speed_wide * t;
  return (rotation_about<Wide>(m.axis_wide, angle) * m.start_wide).cast<double>();
}

}  // namespace touchstone::impact::filtered
