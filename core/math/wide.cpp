#include "core/math/wide.h"

#include <algorithm>

#include "core/math/axis_rotation.h"

namespace touchstone {
namespace {

template <class Columns>
Columns rotated_columns(const Columns& x, const WideVec& angular, Wide t) {
  const Wide speed = wide_norm(angular);
  if (!(speed > 0) || t == 0) return x;
  return rotation_about<Wide>(angular / speed, speed * t) * x;
}

}  // namespace

Quat in_range_of_wide(const Quat& q) {
  if (wide_holds_squares) return q;
  const int e = -std::ilogb(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)}));
  return {std::ldexp(q.x, e), std::ldexp(q.y, e), std::ldexp(q.z, e), std::ldexp(q.w, e)};
}

Wide wide_norm(const WideVec& v) {
  if constexpr (wide_holds_squares) {
    return v.norm();
  } else {
    const double most = v.cast<double>().cwiseAbs().maxCoeff();
    if (!(most > 0) || !std::isfinite(most)) return most;
    const int e = std::ilogb(most);
    return ldexp(WideVec(v.unaryExpr([&](const Wide& x) { return ldexp(x, -e); })).norm(), e);
  }
}

WideMat wide_rotation(const Quat& any) {
  const Quat q = in_range_of_wide(any);
  const Wide x = q.x, y = q.y, z = q.z, w = q.w, n = x * x + y * y + z * z + w * w;
  WideMat r;
  r << (w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n,
      2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n,
      2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n;
  return r;
}

WideFrame wide_frame(const Pose& p) { return {wide_rotation(p.rotation), p.translation.cast<Wide>()}; }

WideVec turned(const WideVec& x, const WideVec& angular, Wide t) { return rotated_columns(x, angular, t); }

WideMat turned(const WideMat& columns, const WideVec& angular, Wide t) {
  return rotated_columns(columns, angular, t);
}

WideFrame wide_frame_at(const Pose& p, const Motion& m, Wide t) {
  return {turned(wide_rotation(p.rotation), m.angular.cast<Wide>(), t),
          p.translation.cast<Wide>() + t * m.linear.cast<Wide>()};
}

}  // namespace touchstone
