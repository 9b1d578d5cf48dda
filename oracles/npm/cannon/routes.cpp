// cannon-es: the resolvers of Narrowphase, by the types of the two shapes.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) {
  const std::string_view common = common_route(p);
  if (common != "convex") return common;
  if (p.is(ShapeKind::sphere, ShapeKind::sphere)) return "sphere-sphere";
  if (p.is(ShapeKind::sphere, ShapeKind::box)) return "sphere-box";
  if (p.has(ShapeKind::sphere)) return "sphere-convex";
  return "convex";
}

}  // namespace

Library cannon_library() { return {"cannon-es", "cannon", route}; }

}  // namespace touchstone::routes
