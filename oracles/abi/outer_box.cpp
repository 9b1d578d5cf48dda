#include "oracles/abi/plugin_scene.h"

#include <cmath>

#include "core/math/error_free.h"
#include "core/math/roundoff.h"

namespace touchstone {
namespace {

/// Relative to the sum of the shape's coordinates. An entry of the rotation has an error of at most 10
/// roundings and an extent along a row of it eight more: (3 · 10 + 8) · 2⁻⁵³ < 2⁻⁴⁷. Tested by: tests/oracles
/// "the box of a step contains the body".
constexpr double turning_slack = 0x1p-47;

// The sum, rounded to the next double in the direction `outward`. The
// error is NaN if the sum overflows: then one step is enough.
double rounded_sum(double a, double b, double outward) {
  const Rounded s = two_sum(a, b);
  if (std::isinf(a) || std::isinf(b)) return s.value;
  const bool is_outside = outward > 0 ? s.error <= 0 : s.error >= 0;
  return is_outside ? s.value : std::nextafter(s.value, outward);
}

Interval<double> extent_along(const Shape& shape, const Vec3& row) {
  return std::visit([&](const auto& s) { return s.extent_along(row); }, shape);
}

Aabb unbounded() { return {Vec3::Constant(-infinity), Vec3::Constant(infinity)}; }

// The box about the origin of a shape that is not turned; a size may be infinite, and 0 · ∞ is not a number.
Aabb unturned(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return {-box->half_extents, box->half_extents};
  Aabb r;
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = extent_along(shape, Vec3::Unit(axis));
    r.lo[axis] = along.lo;
    r.hi[axis] = along.hi;
  }
  return r;
}

Aabb turned(const Shape& shape, const Quat& rotation, double sum) {
  const Mat3 matrix = rotation_matrix(rotation);
  const double slack = turning_slack * std::abs(sum);
  Aabb r;
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = extent_along(shape, matrix.row(axis));
    r.lo[axis] = rounded_sum(along.lo, -slack, -infinity);
    r.hi[axis] = rounded_sum(along.hi, slack, infinity);
  }
  return r;
}

}  // namespace

Aabb outer_box(const Shape& shape, const Pose& pose) {
  const double sum = std::visit([](const auto& s) { return static_cast<double>(s.coordinate_sum()); }, shape);
  const bool is_turned = pose.rotation != Quat{};
  if (!is_bounded(kind_of(shape)) || (is_turned && std::isinf(sum))) return unbounded();
  Aabb box = is_turned ? turned(shape, pose.rotation, sum) : unturned(shape);
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = rounded_sum(pose.translation[axis], box.lo[axis], -infinity);
    box.hi[axis] = rounded_sum(pose.translation[axis], box.hi[axis], infinity);
  }
  return box;
}

}  // namespace touchstone
