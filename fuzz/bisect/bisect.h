// What a finding depends on: which bodies, which query of the script, which stage of the engine, which value
// of one number. Each asks the engine about variants of the case and nothing else. A variant shows the
// finding when the engine is wrong in the same way about the same question; how wrong, and for which pair,
// may differ.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/shrink/keeps_finding.h"

namespace touchstone::fuzz {

/// For each case: does the engine commit the fault (of the question) anywhere in it? `engine` must outlive
/// the result.
StillShows commits_fault(const EnginePtr& engine, const Finding& finding);

struct BodiesNeeded {
  std::vector<int> bodies;  // of the case asked about, ascending
  Case smallest;            // with these alone
};
/// Fewest bodies: no single one of them can go. Precondition: c shows it.
BodiesNeeded which_bodies(const Case& c, const StillShows& shows);

struct StepNeeded {
  int query = 0;              // of the script, from 0: the first by which the finding shows
  int queries = 0;            // that the script has
  std::vector<Step> changes;  // between the query before and this one
  Case shortest;              // the script up to that query
};
/// Precondition: c shows it and has a script.
StepNeeded which_step(const Case& c, const StillShows& shows);

/// The stages that an engine passes through, in order, each with what it is found wrong about; empty: right,
/// or it has no such answer.
struct Stage {
  std::string_view name;            // "representation", "broad phase", "overlap", …
  std::vector<std::string> faults;  // fault names, sorted
};
/// Asks everything about bodies a and b alone, where the step (< 0: their own poses) has them.
std::vector<Stage> which_stage(const Case& c, int a, int b, int step, const EnginePtr& engine);

struct Threshold {
  double shows = 0, shows_not = 0;  // neighbouring doubles, or where the search ended
  bool neighbours = false;
  std::size_t tried = 0;
};
/// Bisects the number at `pointer` (a JSON pointer into the case's JSON form) from its own value, which shows
/// the finding, towards `to`, which must not. Throws InputError: no number there, or `to` shows it too.
Threshold which_value(const Case& c, const std::string& pointer, double to, const StillShows& shows);

}  // namespace touchstone::fuzz
