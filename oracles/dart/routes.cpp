// DART 6.12: its own detector has a routine for each pair of DARTCollide.cpp; the back ends choose as their
// libraries do. FCL holds cylinders as meshes, and every shape if it is not asked for primitive ones.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view through_fcl(const Pair& p) {
  if (p.has(ShapeKind::cylinder)) return "mesh";
  if (p.question != Question::distance) return fcl_route(p);
  // Unsigned distances have closed forms that signed ones lack.
  const bool is_closed =
      p.is(ShapeKind::sphere, ShapeKind::sphere) || p.is(ShapeKind::sphere, ShapeKind::box);
  return is_closed ? "sphere" : common_route(p);
}

}  // namespace

std::string_view dart_route(std::string_view engine, const Pair& p) {
  if (engine == "dart-fcl") return through_fcl(p);
  if (engine == "dart-fcl-mesh") return "mesh";
  if (engine == "dart-bullet") return bullet_route(p, /*simulates=*/true);
  if (engine == "dart-ode") return ode_route(p);
  if (p.is(ShapeKind::sphere, ShapeKind::sphere)) return "sphere-sphere";
  if (p.is(ShapeKind::sphere, ShapeKind::box)) return "sphere-box";
  return p.is(ShapeKind::box, ShapeKind::box) ? "box-box" : common_route(p);
}

}  // namespace touchstone::routes
