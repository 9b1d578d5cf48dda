#include "core/world/sweep_criterion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// About ten roundings lie between a shape's numbers and a radius or a bound.
constexpr double down = 1 - 0x1p-40, up = 1 + 0x1p-40;
bool is_half_space(const InnerExtent& e) { return std::isinf(e.reach); }

}  // namespace

InnerExtent inner_extent(const Shape& shape) {
  const InnerRadii r = std::visit([](const auto& s) { return s.inner_radii(); }, shape);
  return {r.anywhere * down, r.about_origin * (r.about_origin > 0 ? down : up), bounding_radius(shape)};
}

double turn_bound(const InnerExtent& e, const Motion& m) {
  const double speed = m.angular.norm();
  if (speed == 0 || is_half_space(e)) return 0;
  return std::min(e.reach * speed / 2, e.reach - e.about_origin) * up;
}

double pass_bound(const InnerExtent& e, const Motion& m) {
  return m.linear.norm() / 2 * up + turn_bound(e, m);
}

double pass_bound(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb) {
  const bool passes = !is_half_space(a) && !is_half_space(b);
  const double travel = passes ? (ma.linear - mb.linear).norm() / 2 * up : 0;
  return travel + turn_bound(a, ma) + turn_bound(b, mb);
}

bool is_flagged(const InnerExtent& e, const Motion& m, double share) {
  return !is_half_space(e) && pass_bound(e, m) > share * e.inner;
}

bool needs_sweep(const InnerExtent& a, const Motion& ma, const InnerExtent& b, const Motion& mb,
                 double share) {
  const double thickness = (is_half_space(a) ? 0 : a.inner) + (is_half_space(b) ? 0 : b.inner);
  return pass_bound(a, ma, b, mb) > share * thickness;
}

}  // namespace touchstone
