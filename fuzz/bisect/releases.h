// Which release of an engine has a fault: the same case is put to each, and the first that shows it is
// searched for by bisection.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/shrink/keeps_finding.h"
#include "reports/record/versions.h"

namespace touchstone::fuzz {

/// A fault, whatever the engine that commits it is called.
struct FaultSought {
  std::string question, fault;  // a crash: "crashed", wherever it happens
  FoundBy by = FoundBy::referee;
};
/// The fault in the key of a finding of that engine. Throws InputError when it is not such a key.
FaultSought fault_in(const std::string& key, const std::string& engine);

/// Puts the case to the engine and looks for the fault.
ReleaseSays ask_release(const Case& c, const FaultSought& sought, const EnginePtr& engine);

enum class Verdict { good, bad, skip };
/// As `git bisect` has them: bad shows the fault, good does not, skip cannot tell.
Verdict verdict_of(const ReleaseSays& says);

/// Where a fault begins among `count` releases, of which the last shows it.
struct FirstBad {
  std::size_t bad = 0;               // the first that is known to show it
  std::optional<std::size_t> good;   // the last before that is right; empty: all before were skipped
  std::vector<std::size_t> skipped;  // between the two: they may show it
};
/// Bisection as `git bisect` does it: it is taken for granted that whatever is older than a good release is
/// good. Each release is asked at most once, the last one not at all.
FirstBad first_bad(std::size_t count, const std::function<Verdict(std::size_t)>& ask);

}  // namespace touchstone::fuzz
