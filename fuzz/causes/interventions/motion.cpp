// How the bodies move.
#include <algorithm>

#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {

std::optional<Case> stop_turning(const Case& c) {
  Case r = c;
  bool any = false;
  for (Body& b : r.scene.bodies)
    if (b.motion && !b.motion->angular.isZero(0)) {
      b.motion->angular.setZero();
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

std::optional<Case> move_b_only(const Case& c) {
  if (c.queries.empty() || c.queries[0].question != Question::time_of_impact) return std::nullopt;
  Case r = c;
  Body& a = r.scene.bodies[static_cast<std::size_t>(c.queries[0].a)];
  Body& b = r.scene.bodies[static_cast<std::size_t>(c.queries[0].b)];
  if (!a.motion || !a.motion->angular.isZero(0) || a.motion->linear.isZero(0)) return std::nullopt;
  if (!is_convex(kind_of(r.scene.shape_of(c.queries[0].b)))) return std::nullopt;
  if (!b.motion) b.motion = Motion{};
  b.motion->linear -= a.motion->linear;
  a.motion.reset();
  return r;
}

std::optional<Case> release_static(const Case& c) {
  Case r = c;
  bool any = false;
  for (Body& b : r.scene.bodies)
    if (b.is_static && is_convex(kind_of(r.scene.shapes[static_cast<std::size_t>(b.shape)]))) {
      b.is_static = false;
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

}  // namespace touchstone::fuzz
