// Bullet 3: the tables of btDefaultCollisionConfiguration. The simulation has algorithms of its own for pairs
// of boxes and of spheres; queries ask the closest-points table, where boxes go through GJK and EPA.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view engine, const Pair& p) {
  const bool simulates = engine.find("sim") != std::string_view::npos;
  const std::string_view common = common_route(p);
  if (common != "convex") return common;
  if (p.question == Question::time_of_impact) return "conservative advancement";
  if (p.is(ShapeKind::sphere, ShapeKind::sphere)) return "sphere-sphere";
  return simulates && p.is(ShapeKind::box, ShapeKind::box) ? "box-box" : "convex";
}

std::vector<Related> related() {
  using enum Respect;
  constexpr std::string_view with_margins = "asked with default margins", without = "only without margins";
  std::vector<Related> all{
      {"bullet-f32-", "-f32-", "-f64-", precision, "asked in double precision",
       "only in single precision: vanishes in double"},
      {"bullet-f64-", "-f64-", "-f32-", precision, "asked in single precision", "only in double precision"},
  };
  for (const std::string_view tuned :
       {"bullet-f32-query-tuned", "bullet-f32-sim-tuned", "bullet-f64-query-tuned", "bullet-f64-sim-tuned"})
    all.push_back({tuned, "-tuned", "", settings, with_margins, without});
  all.push_back({"bullet-", "", "-tuned", settings, "asked with margin 0", "vanishes with margin 0"});
  for (const std::string_view query : {"bullet-f32-query", "bullet-f64-query"}) {
    all.push_back(
        {query, "query", "epa@1e-9", tighter, "EPA tolerance 1e-9", "vanishes with a tighter EPA tolerance"});
    all.push_back({query, "query", "sim", path, "asked by the simulation",
                   "only in queries: vanishes in the simulation"});
    all.push_back({query, "query", "minkowski@0", solver, "asked with the Minkowski depth solver",
                   "in EPA: vanishes with the Minkowski depth solver"});
  }
  for (const std::string_view sim : {"bullet-f32-sim", "bullet-f64-sim"})
    all.push_back(
        {sim, "sim", "query", path, "asked by a query", "only in the simulation: vanishes in a query"});
  return all;
}

}  // namespace

Library bullet_library() {
  return {"Bullet",
          "bullet",
          route,
          nullptr,
          related(),
          {{"bullet-f32-", "bullet-"}, {"bullet-f64-", "bullet-"}},
          "btContinuousConvexCollision.cpp: \"don't report time of impact for motion away from the contact "
          "normal\""};
}

}  // namespace touchstone::routes
