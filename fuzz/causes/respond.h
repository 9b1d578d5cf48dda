// Asks one engine about a case and all its changed forms.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fuzz/causes/classes.h"
#include "fuzz/causes/deviation.h"
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
  Deviation deviation;               // of the case itself
  /// Of each response where the fault stays; without a manner elsewhere.
  std::vector<Deviation> deviations;
  std::vector<ErrorLaw> laws;  // of deviations_of
  /// Symptoms of the engine when every question is put about the same bodies.
  std::set<Symptom> also;
};

/// Of the case and of every form that shows the fault in the same part of the answer.
std::vector<Deviation> deviations_of(const Responses& r);

/// Names and changes of the interventions that need no other engine, after those of intervention.h.
inline constexpr std::string_view fresh_process = "fresh_process", other_memory = "other_memory";
/// The name of the other engine that differs in the format of its numbers (OtherEngine::name).
inline constexpr std::string_view other_precision = "other_precision";

/// What detects findings with the symptom.
FoundBy found_by(const Symptom& symptom);

/// True for symptoms that only a comparison of several answers shows.
bool needs_comparison(const Symptom& s);

Responses respond(const Case& c, const Symptom& symptom, const std::string& engine,
                  const std::vector<OtherEngine>& others, EnginePool& pool);

/// How much it says about a cause that the fault vanishes (intervention.h).
int telling_of(const std::string& intervention, const std::vector<OtherEngine>& others);

/// The clause of a title for an intervention after which the fault vanishes; empty if it has none.
std::string meaning_of(const std::string& intervention, const std::vector<OtherEngine>& others);

}  // namespace touchstone::fuzz
