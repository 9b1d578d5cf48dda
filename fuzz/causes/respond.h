// Asks one engine about a case and all its changed forms.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fuzz/causes/classes.h"
#include "fuzz/causes/engine_pool.h"
#include "fuzz/causes/symptom.h"
#include "fuzz/shrink/keeps_finding.h"
#include "reports/record/causes.h"

namespace touchstone::fuzz {

struct Responses {
  bool shown = false;                // the case itself shows the symptom
  double error_in_l = 0;             // of the case itself
  std::set<std::string> faults;      // of the symptom, in the case itself
  std::vector<Responded> responses;  // every intervention, in the order of the table; then other engines
  std::vector<double> errors_in_l;   // of each response where the fault stays; 0 elsewhere
  /// Symptoms of the engine when every question is put about the same bodies.
  std::set<Symptom> also;
};

/// Names and changes of the interventions that need no other engine, after those of intervention.h.
inline constexpr std::string_view fresh_process = "fresh_process", other_memory = "other_memory";

/// What detects findings with the symptom.
FoundBy found_by(const Symptom& symptom);

/// True for symptoms that only a comparison of several answers shows.
bool needs_comparison(const Symptom& s);

Responses respond(const Case& c, const Symptom& symptom, const std::string& engine,
                  const std::vector<OtherEngine>& others, EnginePool& pool);

/// The clause of a title for an intervention after which the fault vanishes; empty if it has none.
std::string meaning_of(const std::string& intervention, const std::vector<OtherEngine>& others);

}  // namespace touchstone::fuzz
