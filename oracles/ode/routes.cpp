// ODE 0.16: the table of colliders in collision_kernel.cpp; hulls, and cylinders with cylinders and capsules,
// go to libccd's MPR.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) {
  const std::string_view common = common_route(p);
  if (common != "convex") return common;
  if (p.has(ShapeKind::hull) || p.is(ShapeKind::cylinder, ShapeKind::cylinder) ||
      p.is(ShapeKind::capsule, ShapeKind::cylinder))
    return "libccd";
  if (p.is(ShapeKind::box, ShapeKind::box)) return "box-box";
  if (p.is(ShapeKind::box, ShapeKind::cylinder)) return "box-cylinder";
  if (p.is(ShapeKind::box, ShapeKind::capsule)) return "box-capsule";
  return "closed form";
}

}  // namespace

Library ode_library() { return {"ODE", "ode", route}; }

}  // namespace touchstone::routes
