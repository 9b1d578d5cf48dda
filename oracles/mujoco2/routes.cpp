// MuJoCo 2.2: the table mjCOLLISIONFUNC of engine_collision_driver.c.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) {
  const std::string_view common = common_route(p);
  if (common != "convex") return common;
  const auto is_round = [](ShapeKind k) { return k == ShapeKind::sphere || k == ShapeKind::capsule; };
  if (is_round(p.a) && is_round(p.b)) return "closed form";
  if (p.is(ShapeKind::box, ShapeKind::box)) return "box-box";
  if (p.is(ShapeKind::sphere, ShapeKind::box)) return "sphere-box";
  if (p.is(ShapeKind::capsule, ShapeKind::box)) return "capsule-box";
  return "libccd";
}

}  // namespace

Library mujoco2_library() { return {"MuJoCo 2", "mujoco2", route}; }

}  // namespace touchstone::routes
