#include "fuzz/causes/plain_cases.h"

#include <tuple>
#include <vector>

#include "fuzz/causes/symptom.h"
#include "fuzz/judge/relation.h"
#include "fuzz/shrink/keeps_finding.h"

namespace touchstone::fuzz {
namespace {

// The case, then what the relations derive from it and from the engine's answers to it.
std::vector<Case> forms_of_case(const Case& c, const EnginePtr& engine) {
  std::vector<Case> forms{c};
  const CaseObservations base = engine->run({&c, 1}).at(0);
  const RelationInput in{c, engine->card(), base};
  for (const Relation& r : relations())
    for (Derived& d : r.derive(in))
      if (is_within_numbers(c.scene, d.c.scene)) forms.push_back(std::move(d.c));
  return forms;
}

}  // namespace

std::optional<PlainForm> plain_form(const Case& c, Question question, const EnginePtr& engine) {
  const std::vector<Case> forms = forms_of_case(c, engine);
  const auto found = findings_of(forms, engine, FoundBy::referee);
  const auto rank = [&](const Finding& f) {
    const Symptom s = symptom_of(f);
    return std::tuple(s.question != question, s.stage, -f.worst_in_l);
  };
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const Finding* best = nullptr;
    for (const auto& [key, f] : found[i])
      if (!best || rank(f) < rank(*best)) best = &f;
    if (best) return PlainForm{forms[i], *best};
  }
  return std::nullopt;
}

}  // namespace touchstone::fuzz
