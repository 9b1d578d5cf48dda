#include "fuzz/causes/causes.h"

#include <utility>

#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/numbers.h"

namespace touchstone::fuzz {
namespace {

// What the engine shows in the case: the same fault, or else another with the same symptom; the one with the
// largest error.
std::optional<Finding> finding_in(const Case& c, const Finding& wanted, const EnginePtr& engine) {
  const Symptom symptom = symptom_of(wanted);
  const auto found = findings_of({&c, 1}, engine, found_by(symptom));
  const auto rank = [&](const Finding& f) { return std::pair(f.fault == wanted.fault, f.worst_in_l); };
  std::optional<Finding> best;
  for (const auto& [key, f] : found.at(0))
    if (symptom_of(f) == symptom && (!best || rank(f) > rank(*best))) best = f;
  return best;
}

CauseCase as_case(const Case& c, const Finding& f) {
  return {f.engine, f.key(), case_to_json(c), f.words, f.worst_in_l, measure(c)};
}

}  // namespace

void add_evidence(Cause& cause, const Representative& r, const CausesConfig& config, EnginePool& pool) {
  const EnginePtr& engine = pool.named(r.finding->engine);
  if (!engine) return;
  engine->resume();
  cause.library = engine->card().library + " " + engine->card().version;
  std::optional<Finding> shown = finding_in(r.first.smallest, r.shown(), engine);
  if (shown) cause.smallest = as_case(r.first.smallest, *shown);
  if (r.first.defensible) {
    shown = finding_in(*r.first.defensible, r.shown(), engine);
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
