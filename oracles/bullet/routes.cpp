// Bullet 3: the tables of btDefaultCollisionConfiguration. The simulation has algorithms of its own for pairs
// of boxes and of spheres; queries ask the closest-points table, where boxes go through GJK and EPA.
#include "oracles/routes/routes.h"

namespace touchstone::routes {

std::string_view bullet_route(const Pair& p, bool simulates) {
  const std::string_view common = common_route(p);
  if (common != "convex") return common;
  if (p.question == Question::time_of_impact) return "conservative advancement";
  if (p.is(ShapeKind::sphere, ShapeKind::sphere)) return "sphere-sphere";
  return simulates && p.is(ShapeKind::box, ShapeKind::box) ? "box-box" : "convex";
}

}  // namespace touchstone::routes
