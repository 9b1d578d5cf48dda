#include "fuzz/causes/respond.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/input_error.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/judge/judge.h"

namespace touchstone::fuzz {
namespace {

struct Answer {
  Response response = Response::not_applicable;
  double error_in_l = 0;
  std::set<std::string> faults;  // with the symptom
};

// The bodies whose faults count, of a case to which others were added.
struct Bodies {
  int first = 0, end = std::numeric_limits<int>::max();
  bool has(const FaultReport& f) const {
    return (f.a < 0 && f.b < 0) || (f.a >= first && f.b >= first && f.a < end && f.b < end);
  }
};

bool is_verdict(const Judgement& j) {
  return j.ruling() == Ruling::right || j.ruling() == Ruling::wrong || j.ruling() == Ruling::failed;
}

// Judges the answers to one case, which settles every symptom that one answer can show.
Answer judged(const Case& c, const EngineCard& card, const CaseObservations& observed, const Symptom& s,
              const Bodies& bodies = {}, std::set<Symptom>* found = nullptr) {
  Truth truth(c.scene);
  const auto judgements = judge(c, card, observed, truth);
  Answer answer;
  bool all_decided = true, any_wrong = false;
  for (std::size_t i = 0; i < c.queries.size(); ++i) {
    const Question q = c.queries[i].question;
    for (const FaultReport& f : judgements[i].faults) {
      if (found) found->insert({folded(q), stage_of(f.fault), ""});
      if (!shows(s, q, f, judgements[i], observed.answers[i]) || !bodies.has(f)) continue;
      answer.response = Response::stays;
      answer.faults.emplace(to_string(f.fault));
      answer.error_in_l = std::max(answer.error_in_l, f.error_in_l);
    }
    if (folded(q) != s.question) continue;
    all_decided &= is_verdict(judgements[i]);
    any_wrong |= !judgements[i].faults.empty();
  }
  if (answer.response == Response::stays) return answer;
  answer.response = any_wrong ? Response::differs : all_decided ? Response::gone : Response::open;
  return answer;
}

Answer compared(const std::map<std::string, Finding>& found, const Symptom& s) {
  Answer answer{Response::gone, 0, {}};
  for (const auto& [key, f] : found) {
    const Symptom other = symptom_of(f);
    if (other == s) return {Response::stays, f.worst_in_l, {f.fault}};
    if (other.question == s.question) answer.response = Response::differs;
  }
  return answer;
}

// The engine's answers to all cases, for one symptom. `bodies`: one a case, or empty: all.
std::vector<Answer> answers_of(std::span<const Case> cases, const EnginePtr& e, const Symptom& s,
                               std::span<const Bodies> bodies = {}) {
  std::vector<Answer> all;
  if (needs_comparison(s)) {
    for (const auto& found : findings_of(cases, e, found_by(s))) all.push_back(compared(found, s));
    return all;
  }
  const auto observed = e->run(cases);
  for (std::size_t i = 0; i < cases.size(); ++i)
    all.push_back(judged(cases[i], e->card(), observed[i], s, bodies.empty() ? Bodies{} : bodies[i]));
  return all;
}

bool is_valid_case(const Case& c) try {
  validate(c.scene);
  return true;
} catch (const InputError&) {
  return false;
}

// Proposals may fail where numbers leave their range: a hull cannot be built from infinities.
std::optional<Case> changed(const Intervention& i, const Case& c) try {
  std::optional<Case> r = i.changed(c);
  if (!r || !is_valid_case(*r)) return std::nullopt;
  return r;
} catch (const InputError&) {
  return std::nullopt;
}

// All questions about the bodies of the first query.
Case with_all_questions(const Case& c) {
  Case r = c;
  if (c.queries.empty() || c.queries[0].question >= Question::time_of_impact) return r;
  r.queries.clear();
  for (const Question q : {Question::overlap, Question::distance, Question::contact})
    r.queries.push_back({q, c.queries[0].a, c.queries[0].b});
  return r;
}

class Table {
 public:
  explicit Table(Responses& to) : to_(to) {}
  void add(std::string_view name, std::string_view change, const Answer& a) {
    to_.responses.push_back({std::string(name), std::string(change), a.response});
    to_.errors_in_l.push_back(a.error_in_l);
  }

 private:
  Responses& to_;
};

// The same question to an engine that has answered nothing yet, and again in memory with other contents.
void ask_afresh(const Case& c, const Symptom& s, const std::string& engine, EnginePool& pool, Table& table) {
  const EnginePtr fresh = pool.fresh(engine);
  table.add(fresh_process, "asked in a fresh process", answers_of({&c, 1}, fresh, s).at(0));
  Answer again;
  if (!needs_comparison(s))
    if (const auto observed = fresh->run_again({&c, 1}); !observed.empty())
      again = judged(c, fresh->card(), observed[0], s);
  table.add(other_memory, "asked in memory with other contents", again);
}

// Judged as an answer of the engine concerned: a sibling that claims more for the same wrong answer does not
// repair it.
Answer judged_as(const Case& c, const EngineCard& card, const CaseObservations& base,
                 CaseObservations observed, const Symptom& s) {
  for (std::size_t i = 0; i < observed.answers.size() && i < base.answers.size(); ++i)
    if (base.answers[i].outcome == Outcome::answered)
      observed.answers[i].claimed_tolerance = base.answers[i].claimed_tolerance;
  return judged(c, card, observed, s);
}

void ask_others(const Case& c, const Symptom& s, const EnginePtr& engine,
                const std::vector<OtherEngine>& others, EnginePool& pool, Table& table) {
  if (others.empty()) return;
  const CaseObservations base = engine->run({&c, 1}).at(0);
  for (const OtherEngine& other : others) {
    Answer answer;
    if (const EnginePtr& e = pool.named(other.engine))
      answer = needs_comparison(s) ? answers_of({&c, 1}, e, s).at(0)
                                   : judged_as(c, engine->card(), base, e->run({&c, 1}).at(0), s);
    table.add(other.name, other.change, answer);
  }
}

// What else is wrong when every question is put about the same bodies.
std::set<Symptom> all_symptoms(const Case& c, const EnginePtr& e) {
  const Case all = with_all_questions(c);
  std::set<Symptom> found;
  judged(all, e->card(), e->run({&all, 1}).at(0), {}, {}, &found);
  return found;
}

}  // namespace

FoundBy found_by(const Symptom& symptom) {
  return symptom.stage == FaultStage::contradiction ? FoundBy::relations : FoundBy::referee;
}

bool needs_comparison(const Symptom& s) {
  return s.stage == FaultStage::state || s.stage == FaultStage::contradiction;
}

Responses respond(const Case& c, const Symptom& symptom, const std::string& engine,
                  const std::vector<OtherEngine>& others, EnginePool& pool) {
  const EnginePtr& e = pool.named(engine);
  std::vector<Case> asked{c};
  std::vector<Bodies> bodies(1);
  std::vector<std::optional<std::size_t>> place;
  for (const Intervention& i : interventions) {
    auto form = changed(i, c);
    place.push_back(form ? std::optional(asked.size()) : std::nullopt);
    if (!form) continue;
    asked.push_back(std::move(*form));
    bodies.push_back({i.added_first, i.added_first + static_cast<int>(c.scene.bodies.size())});
  }
  const std::vector<Answer> answers = answers_of(asked, e, symptom, bodies);
  Responses r;
  r.shown = answers[0].response == Response::stays;
  r.error_in_l = answers[0].error_in_l;
  r.faults = answers[0].faults;
  r.also = all_symptoms(c, e);
  Table table(r);
  for (std::size_t i = 0; i < interventions.size(); ++i)
    table.add(interventions[i].name, interventions[i].change, place[i] ? answers[*place[i]] : Answer{});
  ask_afresh(c, symptom, engine, pool, table);
  ask_others(c, symptom, e, others, pool, table);
  return r;
}

std::string meaning_of(const std::string& intervention, const std::vector<OtherEngine>& others) {
  for (const Intervention& i : interventions)
    if (i.name == intervention) return std::string(i.if_gone);
  for (const OtherEngine& other : others)
    if (other.name == intervention) return other.if_gone;
  if (intervention == fresh_process) return "needs earlier questions: vanishes in a fresh process";
  if (intervention == other_memory) return "depends on memory that was never written";
  return "";
}

}  // namespace touchstone::fuzz
