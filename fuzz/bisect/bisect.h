// Finds what a finding depends on: which bodies, which query of the script, which stage of the engine, which
// value of one number. Each function only puts variants of the case to the engine. A variant shows the
// finding when the engine has the same fault on the same question; its magnitude and the pair may differ.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/shrink/keeps_finding.h"

namespace touchstone::fuzz {

/// Returns for each case whether the engine commits the fault on the finding's question anywhere in it.
/// `engine` must outlive the result.
StillShows commits_fault(const EnginePtr& engine, const Finding& finding);

struct BodiesNeeded {
  std::vector<int> bodies;  // indices in the original case, ascending
  Case smallest;            // with only these bodies
};
/// Finds a minimal set of bodies: no single one can be dropped. Precondition: c shows the finding.
BodiesNeeded which_bodies(const Case& c, const StillShows& shows);

struct StepNeeded {
  int query = 0;              // first query of the script (from 0) at which the finding shows
  int queries = 0;            // in the whole script
  std::vector<Step> changes;  // between the previous query and this one
  Case shortest;              // the script up to that query
};
/// Precondition: c shows the finding. Throws InputError when it has no script.
StepNeeded which_step(const Case& c, const StillShows& shows);

/// One stage of an engine, with the faults found in it. Empty: right, or the engine gives no such answer.
struct Stage {
  std::string_view name;            // "representation", "broad phase", "overlap", …
  std::vector<std::string> faults;  // "question fault", sorted
};
/// Puts every question about bodies a and b alone, at their poses in that step (< 0: their own poses).
/// Returns the stages in the order in which an engine passes through them.
std::vector<Stage> which_stage(const Case& c, int a, int b, int step, const EnginePtr& engine);

struct Threshold {
  double shows = 0, shows_not = 0;  // adjacent doubles, or where the search ended
  bool neighbours = false;
  std::size_t tried = 0;
};
/// Bisects the number at `pointer` (a JSON pointer into the case's JSON form) from its own value, which shows
/// the finding, towards `to`, which must not. Throws InputError if there is no number at `pointer` or `to`
/// also shows it.
Threshold which_value(const Case& c, const std::string& pointer, double to, const StillShows& shows);

}  // namespace touchstone::fuzz
