// FCL 0.7: closed forms are specialisations of shapeIntersect in gjk_solver_libccd-inl.h and
// gjk_solver_indep-inl.h; distances have fewer, and none with enable_signed_distance, which the shipped
// engine asks for.
#include "oracles/routes/routes.h"

namespace touchstone::routes {

std::string_view fcl_route(const Pair& p) {
  const std::string_view common = common_route(p);
  if (common != "convex" || p.question == Question::distance) return common;
  if (p.question == Question::time_of_impact) return "conservative advancement";
  constexpr ShapeKind with_sphere[] = {ShapeKind::sphere, ShapeKind::box, ShapeKind::capsule,
                                       ShapeKind::cylinder};
  for (const ShapeKind k : with_sphere)
    if (p.is(ShapeKind::sphere, k)) return "sphere";
  return p.is(ShapeKind::box, ShapeKind::box) ? "box-box" : "convex";
}

std::string_view fcl_documents(std::string_view engine, Question question, std::string_view, Fault fault) {
  const bool shipped = !engine.ends_with("-tuned");
  if (shipped && question == Question::time_of_impact && (fault == Fault::missed || fault == Fault::late))
    return "fcl/narrowphase/continuous_collision_request.h: the default, CCDC_NAIVE with "
           "num_max_iterations 10, tests ten poses of the motion";
  return "";
}

}  // namespace touchstone::routes
