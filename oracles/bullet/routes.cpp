// Bullet 3: the tables of btDefaultCollisionConfiguration. The simulation has algorithms of its own for pairs
// of boxes and of spheres; queries ask the closest-points table, where boxes go through GJK and EPA.
#include <fmt/format.h>

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

std::string_view broad_phase(Needs::Broad b) {
  if (b == Needs::Broad::sweep) return "btAxisSweep3, with a world box around all bodies.";
  return b == Needs::Broad::all_pairs ? "btSimpleBroadphase." : "btDbvtBroadphase.";
}

std::string precision(const Needs& n) {
  if (n.error < n.float_rounding)
    return fmt::format(
        "Precision: BT_USE_DOUBLE_PRECISION; floats round this scene's coordinates by up to {:.1g}, more "
        "than the error.",
        n.float_rounding);
  return fmt::format(
      "Precision: floats round this scene's coordinates by up to {:.1g}, less than the error; that bounds no "
      "answer of Bullet's.",
      n.float_rounding);
}

std::vector<std::string> terms(const Needs& n) {
  constexpr double default_margin = 0.04;  // CONVEX_DISTANCE_MARGIN
  std::vector<std::string> all{fmt::format("Broad phase: {}", broad_phase(n.broad)), precision(n)};
  if (n.error < default_margin)
    all.emplace_back(
        "Margins: setMargin(0) for all shapes but spheres and capsules, whose margin is their radius; the "
        "default, 0.04, is more than the error.");
  if (n.margin > 0)
    all.push_back(fmt::format(
        "Pairs within {:.3g}: contactPairTest() with m_closestDistanceThreshold = {:.3g} in the callback.",
        n.margin, n.margin));
  if (n.travel || n.turning)
    all.push_back(fmt::format(
        "Bodies to be swept: setCcdMotionThreshold({}) and setCcdSweptSphereRadius(r), with the body's inner "
        "radius r.",
        n.travel_share == 1 ? "r" : fmt::format("{:.3g} * r", n.travel_share)));
  if (n.turning)
    all.emplace_back(
        "Rotation is not swept, only a sphere along a straight line: bodies that are swept because of their "
        "rotation need shorter steps.");
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
          "normal\"",
          terms};
}

}  // namespace touchstone::routes
