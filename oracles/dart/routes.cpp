// DART 6.12: its own detector has a routine for each pair of DARTCollide.cpp; the back ends choose as their
// libraries do. FCL holds cylinders as meshes, and every shape if it is not asked for primitive ones.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view through_fcl(const Pair& p) {
  if (p.has(ShapeKind::cylinder)) return "mesh";
  if (p.question != Question::distance) return route_of("fcl", p);
  // Unsigned distances have closed forms that signed ones lack.
  const bool is_closed =
      p.is(ShapeKind::sphere, ShapeKind::sphere) || p.is(ShapeKind::sphere, ShapeKind::box);
  return is_closed ? "sphere" : common_route(p);
}

std::string_view route(std::string_view engine, const Pair& p) {
  if (engine == "dart-fcl") return through_fcl(p);
  if (engine == "dart-fcl-mesh") return "mesh";
  if (engine == "dart-bullet") return route_of("bullet-sim", p);
  if (engine == "dart-ode") return route_of("ode", p);
  if (p.is(ShapeKind::sphere, ShapeKind::sphere)) return "sphere-sphere";
  if (p.is(ShapeKind::sphere, ShapeKind::box)) return "sphere-box";
  return p.is(ShapeKind::box, ShapeKind::box) ? "box-box" : common_route(p);
}

}  // namespace

Library dart_library() { return {"DART", "dart", route}; }

}  // namespace touchstone::routes
