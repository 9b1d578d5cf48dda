// PhysX 5: overlaps by the table in GuOverlapTests.cpp, sweeps by that in GuSweepTests.cpp; the contacts of a
// step by the PCM methods (GuPCMContact*.cpp), convex cores by GuContactConvexCoreConvex.cpp.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

bool has_convex_core(const Pair& p) {
  return p.has(ShapeKind::cylinder) || p.has(ShapeKind::cone) || p.has(ShapeKind::ellipsoid);
}

std::string_view route(std::string_view engine, const Pair& p) {
  const std::string_view common = common_route(p);
  if (engine == "physx-gjk" || is_broad_question(p.question) || p.has(ShapeKind::mesh)) return common;
  if (has_convex_core(p)) return "convex core";
  if (common != "convex") return common;
  if (p.has(ShapeKind::hull)) return "convex mesh";
  if (!p.is(ShapeKind::box, ShapeKind::box)) return "closed form";
  return "box-box";
}

}  // namespace

Library physx_library() { return {"PhysX", "physx", route}; }

}  // namespace touchstone::routes
