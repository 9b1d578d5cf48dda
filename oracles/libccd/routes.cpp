// libccd knows support functions only: every pair takes one route.
#include "oracles/routes/routes.h"

namespace touchstone::routes {

std::string_view libccd_route(const Pair& p) { return common_route(p); }

std::string_view libccd_documents(std::string_view engine, Question question, std::string_view, Fault fault) {
  const bool is_depth = fault == Fault::not_minimal || fault == Fault::depth_excess;
  if (engine.starts_with("libccd-mpr") && question == Question::contact && is_depth)
    return "G. Snethen, XenoCollide (Game Programming Gems 7): MPR finds the depth along the portal that the "
           "origin ray leaves through, not the least depth";
  return "";
}

}  // namespace touchstone::routes
