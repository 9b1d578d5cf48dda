// MuJoCo 3: the table of colliders, mjCOLLISIONFUNC, in engine_collision_driver.c. mj_geomDistance sends
// pairs of boxes to the convex pipeline too.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) {
  const std::string_view common = common_route(p);
  if (common != "convex") return common;
  if (p.is(ShapeKind::box, ShapeKind::box)) return p.question == Question::distance ? "convex" : "box-box";
  if (p.is(ShapeKind::box, ShapeKind::capsule)) return "box-capsule";
  constexpr ShapeKind with_sphere[] = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::cylinder,
                                       ShapeKind::box};
  for (const ShapeKind k : with_sphere)
    if (p.is(ShapeKind::sphere, k)) return "closed form";
  return p.is(ShapeKind::capsule, ShapeKind::capsule) ? "closed form" : "convex";
}

std::string_view documents(std::string_view engine, Question question, std::string_view route, Fault fault) {
  const bool is_depth = fault == Fault::not_minimal || fault == Fault::depth_excess ||
                        fault == Fault::infeasible || fault == Fault::point_depth;
  const bool is_contact = question == Question::contact || question == Question::scene_contacts;
  if (engine == "mujoco-libccd" && is_contact && route == "convex" && is_depth)
    return "MuJoCo documentation, Computation, Convex collisions: the libccd pipeline is Minkowski Portal "
           "Refinement; G. Snethen, XenoCollide (Game Programming Gems 7): MPR finds the depth along the "
           "portal "
           "that the origin ray leaves through, not the least depth";
  return "";
}

}  // namespace

Library mujoco_library() { return {"MuJoCo", "mujoco", route, documents}; }

}  // namespace touchstone::routes
