// The relations of one case: the derived cases run in one batch, and an answer that contradicts the base is a
// finding about the base, which is all that is stored: the derivations are functions of the base and its
// answers.
#include <algorithm>
#include <optional>

#include "fuzz/ask/ask.h"
#include "fuzz/ask/asked_case.h"
#include "fuzz/ask/degeneracy.h"
#include "fuzz/ask/magnitude.h"
#include "fuzz/ask/unstable.h"
#include "fuzz/judge/relation.h"
#include "reports/record/result.h"
#include "scenarios/value/invalid_numbers.h"

namespace touchstone::fuzz {
namespace {

struct Asked {
  const Relation* relation;
  Derived derived;
};

std::vector<Asked> derive_all(const RelationInput& in) {
  std::vector<Asked> all;
  for (const Relation& r : relations())
    for (Derived& d : r.derive(in))
      if (is_within_numbers(in.c.scene, d.c.scene)) all.push_back({&r, std::move(d)});
  return all;
}

void add_break(CampaignResult& r, AskedCase& base, const RelationInput& in, const RelationBreak& b) {
  const Case& c = base.get();
  const auto q = static_cast<std::size_t>(b.query);
  const Question question = c.queries[q].question;
  Finding f;
  f.engine = in.card.name;
  f.question = to_string(question);
  f.fault = b.relation;
  f.shapes = shapes_of(c, b.a, b.b);
  f.blame = to_string(b.blame);
  f.degeneracy = degeneracy_of(c, b.a, b.b);
  f.magnitude = to_string(magnitude_of(b.error_in_l));
  f.count = 1;
  f.worst_in_l = b.error_in_l;
  f.first_index = base.index();
  f.examples = {base.example(b.error_in_l)};
  f.words = b.words;
  auto& kept = r.findings[f.key()];
  if (kept.count == 0 || f.first_index < kept.first_index)
    f.evidence = std::make_shared<const Evidence>(
        Evidence{c, in.base.answers[q], in.base.received, {}, b.a, b.b, -1, question});
  kept.merge(f);
}

// The forms of the case cannot be compared: one of them is not answered the same way twice. The answers are
// not kept, since they may vary from run to run.
void add_unstable(CampaignResult& r, AskedCase& base, const RelationInput& in, const RelationBreak& b) {
  const Case& c = base.get();
  const auto q = static_cast<std::size_t>(b.query);
  const Question question = c.queries[q].question;
  Finding f;
  f.engine = in.card.name;
  f.question = to_string(question);
  f.fault = to_string(Fault::unstable);
  f.shapes = shapes_of(c, b.a, b.b);
  f.blame = to_string(Blame::algorithm);
  f.degeneracy = degeneracy_of(c, b.a, b.b);
  f.magnitude = to_string(magnitude_of(0));
  f.count = 1;
  f.first_index = base.index();
  f.examples = {base.example(0)};
  f.words = "asked again, it answers differently";
  auto& kept = r.findings[f.key()];
  if (kept.count == 0 || f.first_index < kept.first_index) {
    Observation outcome_alone;
    outcome_alone.outcome = in.base.answers[q].outcome;
    f.evidence = std::make_shared<const Evidence>(
        Evidence{c, outcome_alone, in.base.received, {}, b.a, b.b, -1, question});
  }
  kept.merge(f);
}

bool any_is(const CaseObservations& o, Outcome outcome) {
  return std::any_of(o.answers.begin(), o.answers.end(),
                     [&](const Observation& a) { return a.outcome == outcome; });
}

}  // namespace

void relate_into(CampaignResult& r, const Case& c, std::uint64_t index, const EnginePtr& engine,
                 const CaseObservations& base) {
  // A case that an engine does not answer at all is not asked in some seventeen more forms, and neither is
  // one that hangs it, even if another query of the case was answered: each form would wait for the time
  // limit.
  if (!any_is(base, Outcome::answered) || any_is(base, Outcome::timed_out)) return;
  if (!invalid_numbers(c.scene).empty()) return;
  const RelationInput in{c, engine->card(), base};
  AskedCase base_case(c, index);
  const std::vector<Asked> asked = derive_all(in);
  std::vector<Case> cases;
  for (const Asked& a : asked) cases.push_back(a.derived.c);
  const auto observed = engine->run(cases);
  std::optional<bool> asked_again;  // the base case, repeated once for all breaks
  const auto base_repeats = [&] {
    if (!asked_again) asked_again = repeats(c, *engine, base);
    return *asked_again;
  };
  for (std::size_t i = 0; i < asked.size(); ++i) {
    for (const Observation& o : observed[i].answers) r.engine_ns += o.elapsed_ns;
    auto& count = r.relations[in.card.name][std::string(asked[i].relation->name)];
    ++count.asked;
    const auto broken = find_break(*asked[i].relation, in, asked[i].derived, observed[i]);
    if (!broken) continue;
    ++count.broken;
    if (base_repeats() && repeats(asked[i].derived.c, *engine, observed[i]))
      add_break(r, base_case, in, *broken);
    else
      add_unstable(r, base_case, in, *broken);
  }
}

}  // namespace touchstone::fuzz
