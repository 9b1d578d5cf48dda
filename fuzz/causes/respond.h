// Asks one engine about a case and all its changed forms.
#pragma once

#include <optional>
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

/// What is changed about the process instead of the case; asked after the interventions of intervention.h.
struct Restart {
  std::string_view name, change, if_gone;
  int telling;  // as in Intervention, before all of them
};
inline constexpr Restart fresh_process{"fresh_process", "asked in a fresh process",
                                       "needs earlier questions: vanishes in a fresh process", 700};
inline constexpr Restart other_memory{"other_memory", "asked in memory with other contents",
                                      "depends on memory that was never written", 690};
/// The name of the other engine that differs in the format of its numbers (OtherEngine::name).
inline constexpr std::string_view other_precision = "other_precision";

/// What detects findings with the symptom.
FoundBy found_by(const Symptom& symptom);

/// True for symptoms that only a comparison of several answers shows.
bool needs_comparison(const Symptom& s);

Responses respond(const Case& c, const Symptom& symptom, const std::string& engine,
                  const std::vector<OtherEngine>& others, EnginePool& pool);

/// What is wrong in the engine's answer to the case, if it shows the symptom. Nothing if the engine is
/// missing.
std::optional<Deviation> shown_by(const std::string& engine, const Case& c, const Symptom& symptom,
                                  EnginePool& pool);

/// What is known of an intervention beside the response to it.
struct Meaning {
  int telling = 0;      // how much it says about a cause that the fault vanishes (intervention.h)
  std::string if_gone;  // the clause of a title then; empty if there is none
};
Meaning meaning_of(const std::string& intervention, const std::vector<OtherEngine>& others);

}  // namespace touchstone::fuzz
