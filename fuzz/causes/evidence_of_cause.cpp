#include "fuzz/causes/evidence_of_cause.h"

#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/case_size.h"

namespace touchstone::fuzz {
namespace {

// The finding with the symptom that the engine shows in the case; the one with the largest error.
std::optional<Finding> finding_in(const Case& c, const Symptom& symptom, const EnginePtr& engine) {
  const auto found = findings_of({&c, 1}, engine, found_by(symptom));
  std::optional<Finding> best;
  for (const auto& [key, f] : found.at(0))
    if (symptom_of(f) == symptom && (!best || f.worst_in_l > best->worst_in_l)) best = f;
  return best;
}

CauseCase as_case(const Case& c, const Finding& f) {
  return {f.engine, f.key(), case_to_json(c), f.words, f.worst_in_l, measure(c)};
}

}  // namespace

void add_evidence(Cause& cause, const Representative& r, const Symptom& symptom, const CausesConfig& config,
                  EnginePool& pool) {
  const EnginePtr& engine = pool.named(r.finding->engine);
  if (!engine) return;
  engine->take_back();
  cause.library = engine->card().library + " " + engine->card().version;
  std::optional<Finding> shown = finding_in(r.first.smallest, symptom, engine);
  if (shown) cause.smallest = as_case(r.first.smallest, *shown);
  if (r.first.defensible) {
    shown = finding_in(*r.first.defensible, symptom, engine);
    if (shown) cause.defensible = as_case(*r.first.defensible, *shown);
  }
  if (!shown) return;
  write_evidence(*shown);
  const Json& certificate = shown->evidence_json.at("certificate");
  if (certificate.value("kind", "none") != "none") cause.certificate = certificate;
  if (!config.program) return;
  try {
    cause.program = config.program(*shown, engine->card());
  } catch (const InputError& e) {
    cause.no_program = e.reason();
  }
}

}  // namespace touchstone::fuzz
