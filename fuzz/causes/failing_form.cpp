#include "fuzz/causes/failing_form.h"

#include <algorithm>

#include "fuzz/causes/symptom.h"
#include "fuzz/judge/relation.h"
#include "fuzz/shrink/keeps_finding.h"
#include "scenarios/value/odd_numbers.h"

namespace touchstone::fuzz {
namespace {

// The referee's findings about that question; the one with the largest error.
std::optional<Finding> worst_about(Question question, const Case& c, const EnginePtr& engine) {
  std::optional<Finding> worst;
  const auto found = findings_of({&c, 1}, engine);
  for (const auto& [key, f] : found.at(0))
    if (f.question == to_string(question) && symptom_of(f).stage != FaultStage::state &&
        (!worst || f.worst_in_l > worst->worst_in_l))
      worst = f;
  return worst;
}

std::optional<FailingForm> failing_form_of(const Case& c, const Relation& relation, const EnginePtr& engine) {
  if (!odd_numbers(c.scene).empty()) return std::nullopt;
  const CaseObservations base = engine->run({&c, 1}).at(0);
  const RelationInput in{c, engine->card(), base};
  for (Derived& d : relation.derive(in)) {
    if (!is_within_numbers(c.scene, d.c.scene)) continue;
    const auto broken = find_break(relation, in, d, engine->run({&d.c, 1}).at(0));
    if (!broken) continue;
    const Question question = c.queries[static_cast<std::size_t>(broken->query)].question;
    if (auto worst = worst_about(question, d.c, engine))
      return FailingForm{std::move(d.c), *std::move(worst)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<FailingForm> failing_form(std::span<const Case* const> cases, const std::string& relation,
                                        const EnginePtr& engine) {
  const auto all = relations();
  const auto named = std::ranges::find(all, relation, &Relation::name);
  if (named == all.end()) return std::nullopt;
  for (const Case* c : cases)
    if (auto form = failing_form_of(*c, *named, engine)) return form;
  return std::nullopt;
}

}  // namespace touchstone::fuzz
