#include "oracles/routes/routes.h"

namespace touchstone::routes {

std::string_view common_route(const Pair& p) {
  if (is_broad_question(p.question)) return "pairs";
  if (p.has(ShapeKind::mesh)) return "mesh";
  if (p.has(ShapeKind::half_space)) return "half-space";
  return "convex";
}

}  // namespace touchstone::routes
