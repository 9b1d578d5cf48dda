// Which parts: the points that the nearest facet or simplex takes from a polytope, one by one and in pairs,
// and the whole pair's nearest point in a curved core.
#include "oracles/referee/filter/inner_polytope.h"

#include <vector>

namespace touchstone::referee {
namespace {

// A part of `whole`: its points are in the core as the core's own support points are.
Solid part_of(const Solid& whole, std::vector<Real3> points) {
  Solid s;
  for (const Real3& p : points) s.extent = std::max(s.extent, norm(p) * (1 + dot_rounding));
  s.error = whole.error + dot_rounding * s.extent;
  s.points = std::move(points);
  return s;
}

// The direction n turned about the axis u towards c.
Real3 turned_towards(const Real3& n, const Real3& u, const Real3& c) {
  const Real along = dot(n, u);
  return along * u + norm(n - along * u) * unit_across(c, u);
}

// The parts of one body, given its points in the simplex and their weights.
std::vector<Solid> parts_of(const Solid& whole, const Simplex& nearest, bool of_a) {
  std::vector<Real3> distinct;
  Real3 mean;
  for (int i = 0; i < nearest.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Real3& p = of_a ? nearest.vertex[k].a : nearest.vertex[k].b;
    mean = mean + nearest.weight[k] * p;
    bool known = false;
    for (const Real3& q : distinct) known = known || largest(p - q) == 0;
    if (!known) distinct.push_back(p);
  }
  std::vector<Solid> parts;
  if (whole.kind != Solid::Kind::points) {
    parts.push_back(part_of(whole, {mean}));
    return parts;
  }
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    parts.push_back(part_of(whole, {distinct[i]}));
    for (std::size_t j = 0; j < i; ++j) parts.push_back(part_of(whole, {distinct[j], distinct[i]}));
  }
  return parts;
}

}  // namespace

void bound_by_parts(const Difference& d, const Simplex& nearest, Real target, CoreGap& gap) {
  const auto bound = [&](const Difference& part) {
    if (gap.hi - gap.lo <= target) return;
    const MeridianBound m = meridian_bound(part, target);
    if (!m.applies) return;
    gap.lower(m.gap.hi);
    // A part on the axis leaves the turn about it open, where the bodies do not: the best known one is tried
    // too.
    for (const Real3& n : {m.gap.direction, turned_towards(m.gap.direction, m.axis, gap.direction)})
      gap.raise(-d.width_above(d.support(n), n), n);
  };
  if (!d.b.is_swept)
    for (const Solid& part : parts_of(d.b, nearest, false)) bound(Difference(d.a, part));
  if (!d.a.is_swept)
    for (const Solid& part : parts_of(d.a, nearest, true)) bound(Difference(part, d.b));
}

}  // namespace touchstone::referee
