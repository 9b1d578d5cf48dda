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
  Deviation deviation;           // of the fault with the largest error
};

// The part of a case to which others were added: only its faults count.
struct Part {
  Added before;
  std::size_t queries = std::numeric_limits<std::size_t>::max();
  int bodies = std::numeric_limits<int>::max(), query_steps = std::numeric_limits<int>::max();

  static Part of(const Case& c, const Added& added) {
    Part p;
    p.before = added;
    if (added.queries_doubled) p.before.queries = static_cast<int>(c.queries.size());
    p.queries = c.queries.size();
    p.bodies = static_cast<int>(c.scene.bodies.size());
    p.query_steps =
        std::max(1, static_cast<int>(std::ranges::count(c.scene.script, Step::Op::query, &Step::op)));
    return p;
  }
  bool has_query(std::size_t i) const {
    const auto first = static_cast<std::size_t>(before.queries);
    return i >= first && i - first < queries;
  }
  bool has_body(int i) const {
    const int n = i - before.bodies;
    if (n <= 0) return n == 0;
    return n > before.bodies_amid && n - before.bodies_amid < bodies;
  }
  bool has(const FaultReport& f) const {
    if (f.step >= 0 && (f.step < before.query_steps || f.step - before.query_steps >= query_steps))
      return false;
    return (f.a < 0 && f.b < 0) || (has_body(f.a) && has_body(f.b));
  }
};

bool is_verdict(const Judgement& j) {
  return j.ruling() == Ruling::right || j.ruling() == Ruling::wrong || j.ruling() == Ruling::failed;
}

// Judges the answers to one case, which settles every symptom that one answer can show.
Answer judged(const Case& c, const EngineCard& card, const CaseObservations& observed, const Symptom& s,
              const Part& part = {}, std::set<Symptom>* found = nullptr) {
  Truth truth(c.scene);
  const auto judgements = judge(c, card, observed, truth);
  Answer answer;
  bool all_decided = true, any_wrong = false;
  for (std::size_t i = 0; i < c.queries.size(); ++i) {
    if (!part.has_query(i)) continue;
    const Question q = c.queries[i].question;
    for (const FaultReport& f : judgements[i].faults) {
      any_wrong |= folded(q) == s.question && part.has(f);
      if (found) found->insert({folded(q), stage_of(f.fault), ""});
      if (!shows(s, q, f, judgements[i], observed.answers[i]) || !part.has(f)) continue;
      if (answer.response != Response::stays || f.error_in_l > answer.error_in_l) {
        answer.error_in_l = f.error_in_l;
        answer.deviation = deviation_of(c, c.queries[i], observed.answers[i], f, truth);
      }
      answer.response = Response::stays;
      answer.faults.emplace(to_string(f.fault));
    }
    if (folded(q) != s.question) continue;
    all_decided &= is_verdict(judgements[i]);
  }
  if (answer.response == Response::stays) return answer;
  answer.response = any_wrong ? Response::differs : all_decided ? Response::gone : Response::open;
  return answer;
}

Answer compared(const std::map<std::string, Finding>& found, const Symptom& s) {
  Answer answer;
  answer.response = Response::gone;
  for (const auto& [key, f] : found) {
    const Symptom other = symptom_of(f);
    if (other == s) return {Response::stays, f.worst_in_l, {f.fault}, {}};
    if (other.question == s.question) answer.response = Response::differs;
  }
  return answer;
}

std::vector<Answer> compared(std::span<const Case> cases, const EnginePtr& e, const Symptom& s) {
  std::vector<Answer> all;
  for (const auto& found : findings_of(cases, e, found_by(s))) all.push_back(compared(found, s));
  return all;
}

// The engine's answers to all cases, for one symptom.
std::vector<Answer> answers_of(std::span<const Case> cases, const EnginePtr& e, const Symptom& s) {
  if (needs_comparison(s)) return compared(cases, e, s);
  std::vector<Answer> all;
  const auto observed = e->run(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) all.push_back(judged(cases[i], e->card(), observed[i], s));
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
    to_.deviations.push_back(a.deviation);
  }

 private:
  Responses& to_;
};

// The same question to an engine that has answered nothing yet, and again in memory with other contents.
void ask_afresh(const Case& c, const Symptom& s, const std::string& engine, EnginePool& pool, Table& table) {
  const EnginePtr fresh = pool.fresh(engine);
  table.add(fresh_process.name, fresh_process.change, answers_of({&c, 1}, fresh, s).at(0));
  Answer again;
  if (!needs_comparison(s))
    if (const auto observed = fresh->run_again({&c, 1}); !observed.empty())
      again = judged(c, fresh->card(), observed[0], s);
  table.add(other_memory.name, other_memory.change, again);
}

// Replaces each answer's claimed tolerance by claim(its own, that of the engine's answer to the unchanged
// case).
template <class F>
CaseObservations with_claims(CaseObservations observed, const CaseObservations& base, F claim) {
  for (std::size_t i = 0; i < observed.answers.size() && i < base.answers.size(); ++i)
    if (base.answers[i].outcome == Outcome::answered)
      observed.answers[i].claimed_tolerance =
          claim(observed.answers[i].claimed_tolerance, base.answers[i].claimed_tolerance);
  return observed;
}

// Judged as an answer of the engine concerned: a sibling that claims more for the same wrong answer does not
// repair it.
Answer judged_as(const Case& c, const EngineCard& card, const CaseObservations& base,
                 const CaseObservations& observed, const Symptom& s) {
  return judged(c, card, with_claims(observed, base, [](double, double of_base) { return of_base; }), s);
}

// Judged with what the engine claims in proportion to the scene: a fault has not vanished because a claimed
// length allows it in a scene that is smaller than that.
Answer judged_shrunk(double to, const Case& c, EngineCard card, const CaseObservations& base,
                     const CaseObservations& observed, const Symptom& s) {
  card.contact_offset *= to;
  card.sweep_skin *= to;
  const auto shrunk = [to](double own, double of_base) { return std::min(own, to * of_base); };
  return judged(c, card, with_claims(observed, base, shrunk), s);
}

// `base`: the engine's own answer; null for a symptom that needs a comparison.
void ask_others(const Case& c, const Symptom& s, const EngineCard& card, const CaseObservations* base,
                const std::vector<OtherEngine>& others, EnginePool& pool, Table& table) {
  for (const OtherEngine& other : others) {
    Answer answer;
    const bool is_asked = std::ranges::find(other.other_calls, s.question) == other.other_calls.end();
    if (const EnginePtr& e = pool.named(other.engine); e && is_asked)
      answer = base ? judged_as(c, card, *base, e->run({&c, 1}).at(0), s) : answers_of({&c, 1}, e, s).at(0);
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

std::vector<Deviation> deviations_of(const Responses& r) {
  std::vector<Deviation> all{r.deviation};
  for (const Deviation& d : r.deviations)
    if (d.manner == r.deviation.manner) all.push_back(d);
  return all;
}

FoundBy found_by(const Symptom& symptom) {
  return symptom.stage == FaultStage::contradiction ? FoundBy::relations : FoundBy::referee;
}

bool needs_comparison(const Symptom& s) {
  return s.stage == FaultStage::state || s.stage == FaultStage::contradiction;
}

namespace {

// A case and its changed forms.
struct Forms {
  std::vector<Case> cases;
  std::vector<Part> parts;
  std::vector<double> shrunk_to;
  std::vector<std::optional<std::size_t>> of;  // each intervention's place in `cases`
};

Forms forms_of(const Case& c) {
  Forms f{{c}, {Part()}, {1}, {}};
  for (const Intervention& i : interventions) {
    auto form = changed(i, c);
    f.of.push_back(form ? std::optional(f.cases.size()) : std::nullopt);
    if (!form) continue;
    f.cases.push_back(std::move(*form));
    f.parts.push_back(Part::of(c, i.added));
    f.shrunk_to.push_back(i.shrinks_to);
  }
  return f;
}

}  // namespace

Responses respond(const Case& c, const Symptom& symptom, const std::string& engine,
                  const std::vector<OtherEngine>& others, EnginePool& pool) {
  const EnginePtr& e = pool.named(engine);
  const Forms forms = forms_of(c);
  std::vector<CaseObservations> observed;
  std::vector<Answer> answers;
  if (needs_comparison(symptom))
    answers = compared(forms.cases, e, symptom);
  else
    observed = e->run(forms.cases);
  for (std::size_t i = 0; i < observed.size(); ++i)
    answers.push_back(
        forms.shrunk_to[i] < 1
            ? judged_shrunk(forms.shrunk_to[i], forms.cases[i], e->card(), observed[0], observed[i], symptom)
            : judged(forms.cases[i], e->card(), observed[i], symptom, forms.parts[i]));
  Responses r;
  r.shown = answers[0].response == Response::stays;
  r.error_in_l = answers[0].error_in_l;
  r.faults = answers[0].faults;
  r.deviation = answers[0].deviation;
  r.also = all_symptoms(c, e);
  Table table(r);
  for (std::size_t i = 0; i < interventions.size(); ++i)
    table.add(interventions[i].name, interventions[i].change, forms.of[i] ? answers[*forms.of[i]] : Answer{});
  ask_afresh(c, symptom, engine, pool, table);
  r.laws = laws_of(deviations_of(r));
  ask_others(c, symptom, e->card(), observed.empty() ? nullptr : &observed[0], others, pool, table);
  return r;
}

std::optional<Deviation> shown_by(const std::string& engine, const Case& c, const Symptom& symptom,
                                  EnginePool& pool) {
  const EnginePtr& e = pool.named(engine);
  if (!e) return std::nullopt;
  const Answer answer = answers_of({&c, 1}, e, symptom).at(0);
  return answer.response == Response::stays ? std::optional(answer.deviation) : std::nullopt;
}

Meaning meaning_of(const std::string& intervention, const std::vector<OtherEngine>& others) {
  for (const Intervention& i : interventions)
    if (i.name == intervention) return {i.telling, std::string(i.if_gone)};
  for (const OtherEngine& other : others)
    if (other.name == intervention) return {other.telling, other.if_gone};
  for (const Restart& r : {fresh_process, other_memory})
    if (r.name == intervention) return {r.telling, std::string(r.if_gone)};
  return {};
}

}  // namespace touchstone::fuzz
