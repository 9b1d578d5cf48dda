// FCL 0.7: closed forms are specialisations of shapeIntersect in gjk_solver_libccd-inl.h and
// gjk_solver_indep-inl.h; distances have fewer, and none with enable_signed_distance, which the shipped
// engine asks for.
#include <fmt/format.h>

#include "oracles/routes/routes.h"

namespace touchstone::routes {
namespace {

std::string_view route(std::string_view, const Pair& p) {
  const std::string_view common = common_route(p);
  if (common != "convex" || p.question == Question::distance) return common;
  if (p.question == Question::time_of_impact) return "conservative advancement";
  constexpr ShapeKind with_sphere[] = {ShapeKind::sphere, ShapeKind::box, ShapeKind::capsule,
                                       ShapeKind::cylinder};
  for (const ShapeKind k : with_sphere)
    if (p.is(ShapeKind::sphere, k)) return "sphere";
  return p.is(ShapeKind::box, ShapeKind::box) ? "box-box" : "convex";
}

std::string_view documents(std::string_view engine, Question question, std::string_view, Fault fault) {
  const bool shipped = !engine.ends_with("-tuned");
  if (shipped && question == Question::time_of_impact && (fault == Fault::missed || fault == Fault::late))
    return "fcl/narrowphase/continuous_collision_request.h: the default, CCDC_NAIVE with "
           "num_max_iterations 10, tests ten poses of the motion";
  return "";
}

// Settings name other calls (queries.cpp): the signed distance as shipped and the unsigned one with tight
// tolerances; for the libccd solver, contacts by the signed distance instead of collide(); and conservative
// advancement instead of ten samples.
std::vector<Related> related() {
  using enum Respect;
  constexpr std::string_view without = "only with tight tolerances",
                             with = "a matter of settings: vanishes with tight tolerances",
                             looser_helps = "vanishes with looser tolerances",
                             tighter_helps = "vanishes with tighter tolerances";
  const std::vector<Question> of_indep{Question::distance, Question::time_of_impact},
      of_libccd{Question::distance, Question::contact, Question::time_of_impact};
  return {
      {"fcl-libccd-tuned", "-tuned", "", settings, "asked as shipped", without, of_libccd},
      {"fcl-indep-tuned", "-tuned", "", settings, "asked as shipped", without, of_indep},
      {"fcl-libccd", "", "-tuned", settings, "asked with tight tolerances", with, of_libccd},
      {"fcl-indep", "", "-tuned", settings, "asked with tight tolerances", with, of_indep},
      {"fcl-libccd", "", "@1e-3", looser, "tolerances 1e-3", looser_helps},
      {"fcl-indep", "", "@1e-3", looser, "tolerances 1e-3", looser_helps},
      {"fcl-libccd", "", "@1e-9", tighter, "tolerances 1e-9", tighter_helps},
      {"fcl-indep", "", "@1e-9", tighter, "tolerances 1e-9", tighter_helps},
      {"fcl-libccd", "libccd", "indep", solver, "asked with GST_INDEP", "only with GST_LIBCCD"},
      {"fcl-indep", "indep", "libccd", solver, "asked with GST_LIBCCD", "only with GST_INDEP"},
  };
}

std::string_view manager(Needs::Broad b) {
  if (b == Needs::Broad::sweep) return "SSaPCollisionManager; SaPCollisionManager loses pairs.";
  if (b == Needs::Broad::all_pairs) return "NaiveCollisionManager.";
  return "DynamicAABBTreeCollisionManager; SpatialHashingCollisionManager misses boxes that touch.";
}

std::vector<std::string> terms(const Needs& n) {
  constexpr double taken_for_gap = 2.1e-4;  // depths of curved shapes of unit size, measured with FCL 0.7
  std::vector<std::string> all{fmt::format("Broad phase: {}", manager(n.broad))};
  if (n.verdict_only) {
    all.emplace_back(
        "Verdicts: collide() with gjk_tolerance 1e-12; the default, 1e-6, misses shallow overlaps.");
  } else {
    all.emplace_back("Gaps: distance() with distance_tolerance 1e-12, not its default, 1e-6.");
    all.emplace_back(
        "Depths, where that returns -1: distance() with enable_signed_distance and distance_tolerance 1e-7; "
        "with less it aborts for many pairs. A depth of collide() is only an upper bound.");
    if (n.curved && n.error < taken_for_gap)
      all.push_back(
          fmt::format("Curved shapes: depths of up to {} (of bodies of unit size) may be taken for gaps: "
                      "more than the error.",
                      taken_for_gap));
  }
  if (n.margin > 0)
    all.push_back(
        fmt::format("Pairs within {:.3g}: the manager's distance() with a callback that sets dist to {:.3g}.",
                    n.margin, n.margin));
  if (n.half_spaces)
    all.emplace_back(
        "Half-spaces: collide() only; with GST_LIBCCD, distance() and continuousCollide() crash.");
  if (n.travel || n.turning)
    all.push_back(fmt::format(
        "Bodies to be swept: continuousCollide() with CCDM_LINEAR and CCDC_CONSERVATIVE_ADVANCEMENT{}; the "
        "default, CCDC_NAIVE, tests ten poses.",
        n.surfaces ? ", not for meshes" : ""));
  return all;
}

}  // namespace

Library fcl_library() { return {"FCL", "fcl", route, documents, related(), {}, {}, terms}; }

}  // namespace touchstone::routes
