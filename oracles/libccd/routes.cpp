// libccd knows support functions only: every pair takes one route.
#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) { return common_route(p); }

std::string_view documents(std::string_view engine, Question question, std::string_view, Fault fault) {
  const bool is_depth = fault == Fault::not_minimal || fault == Fault::depth_excess;
  if (engine.starts_with("libccd-mpr") && question == Question::contact && is_depth)
    return "G. Snethen, XenoCollide (Game Programming Gems 7): MPR finds the depth along the portal that the "
           "origin ray leaves through, not the least depth";
  return "";
}

std::vector<Related> related() {
  using enum Respect;
  constexpr std::string_view without = "only with tight tolerances",
                             with = "a matter of settings: vanishes with tight tolerances",
                             looser_helps = "vanishes with looser tolerances",
                             tighter_helps = "vanishes with tighter tolerances",
                             limit_helps = "vanishes with a limit of iterations";
  return {
      {"libccd-gjk-tuned", "-tuned", "", settings, "asked as shipped", without},
      {"libccd-mpr-tuned", "-tuned", "", settings, "asked as shipped", without},
      {"libccd-gjk", "", "-tuned", settings, "asked with tight tolerances", with},
      {"libccd-mpr", "", "-tuned", settings, "asked with tight tolerances", with},
      {"libccd-gjk", "", "@1e-2", looser, "tolerances 1e-2", looser_helps},
      {"libccd-mpr", "", "@1e-2", looser, "tolerance 1e-2", looser_helps},
      {"libccd-gjk", "", "@1e-8", tighter, "tolerances 1e-8", tighter_helps},
      {"libccd-mpr", "", "@1e-8", tighter, "tolerance 1e-8", tighter_helps},
      {"libccd-", "", "-iterations@128", iterations, "at most 128 iterations", limit_helps},
      {"libccd-gjk", "gjk", "mpr", solver, "asked by MPR", "in GJK or EPA: vanishes with MPR"},
      {"libccd-mpr", "mpr", "gjk", solver, "asked by GJK and EPA", "in MPR: vanishes with GJK and EPA"},
  };
}

}  // namespace

Library libccd_library() { return {"libccd", "libccd", route, documents, related()}; }

}  // namespace touchstone::routes
