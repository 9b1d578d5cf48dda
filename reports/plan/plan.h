// Finds the cheapest model that suffices for a scene (core/world/fidelity.h): chosen by measuring on the
// scene's own course, and validated by the referee on a sample of its pairs.
#pragma once

#include <functional>
#include <optional>

#include "core/world/fidelity.h"
#include "reports/plan/course.h"
#include "reports/record/observation_json.h"
#include "reports/record/plan.h"

namespace touchstone::fuzz {

using PlanProgress = std::function<void(const std::string&)>;

struct PlanOptions {
  double error = 0;  // in the scene's unit; 0: default_error
  std::uint64_t seed = 1;
  int rounds = 5;             // interleaved measurements of each way; the minimum counts
  int judged = 48;            // pairs that the referee judges
  double margin = 0;          // pairs this near matter, in the scene's unit
  bool verdict_only = false;  // which pairs, and nothing else about them
  bool solid_meshes = false;  // treat closed, convex meshes as solids
  /// If set, this plan is measured and judged instead of choosing one.
  std::optional<Fidelity> given;
};

/// The least error that double can prove on this scene: 2^-44 of its largest coordinate.
double least_error(const Course& course);
/// A millionth of the smallest body, but not less than the least error.
double default_error(const Course& course);

/// The errors for which candidates of a plan are made: `error` itself, and of 1e-3, 1e-6, 1e-9 and so on
/// those from `least` up to it. A plan for a tighter error holds for a looser one too, and is a candidate for
/// it.
std::vector<double> candidate_errors(double error, double least);

/// Throws InputError when the error is below the least, or a given plan does not fit this scene.
Plan make_plan(const Course& course, const PlanOptions& options, const PlanProgress& progress = {});

// A plan as JSON, so that it can be run again.

/// "double", "double alone", "float".
std::string_view to_string(Arithmetic a);
Json to_json(const Fidelity& f);
/// Throws InputError with the JSON path, prefixed by `place`.
Fidelity fidelity_from_json(const Json& j, const std::string& place);

}  // namespace touchstone::fuzz
