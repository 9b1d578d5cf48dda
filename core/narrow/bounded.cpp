#include "core/narrow/bounded.h"

#include <cmath>

#include "core/math/roundoff.h"
#include "core/tolerance.h"

namespace touchstone {
namespace {

// Values of n·x on the placed shape relative to its origin.
Interval<double> extent_along(const PlacedShape& s, const Vec3& n) {
  const Vec3 local = rotation_matrix(s.pose.rotation).transpose() * n;
  return std::visit([&](const auto& x) { return x.extent_along(local); }, *s.shape);
}

double reach_of(const PlacedShape& s) {
  const double r = s.bounding_radius();
  if (std::isfinite(r)) return r;
  return infinity;
}

}  // namespace

// The gap along any unit n is a lower bound. Roundings, relative to the offset and both reaches: a few of the
// matrices and of the support values, and the length of n; narrow_bound_factor covers them all.
double distance_lower_bound(const PlacedShape& a, const PlacedShape& b) {
  const Vec3 offset = b.pose.translation - a.pose.translation;
  const double length = offset.stableNorm(), reach = reach_of(a) + reach_of(b);
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(reach)) return -infinity;
  const Vec3 n = offset / length;
  const double gap = length + extent_along(b, n).lo - extent_along(a, n).hi;
  const double coordinates = a.pose.translation.lpNorm<1>() + b.pose.translation.lpNorm<1>() + length + reach;
  const double bound = gap - tolerance::narrow_bound_factor * coordinates;
  return std::isfinite(bound) ? bound : -infinity;
}

BoundedDistanceAnswer distance(const PlacedShape& a, const PlacedShape& b, double at_most,
                               Arithmetic arithmetic, PairMemory* memory) {
  BoundedDistanceAnswer r;
  // In float the bound is that of the bodies as given, which the float path does not see.
  r.lower_bound = arithmetic == Arithmetic::float32 ? -infinity : distance_lower_bound(a, b);
  if (r.lower_bound > at_most) return r;
  const DistanceAnswer d = distance(a, b, arithmetic, memory);
  r.outcome = d.outcome;
  if (d.outcome != Outcome::answered) return r;
  r.distance = d;
  r.lower_bound = std::max(r.lower_bound, d.distance - d.error_bound);
  return r;
}

WithinAnswer within(const PlacedShape& a, const PlacedShape& b, double margin, Arithmetic arithmetic,
                    PairMemory* memory) {
  if (margin == 0) {
    const OverlapAnswer o = overlap(a, b, arithmetic, memory);
    return {o.outcome, o.overlap, o.error_bound};
  }
  const BoundedDistanceAnswer d = distance(a, b, margin, arithmetic, memory);
  if (!d.distance) return {d.outcome, false, 0};
  return {d.outcome, d.distance->distance <= margin, d.distance->error_bound};
}

}  // namespace touchstone
