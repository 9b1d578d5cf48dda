#include "reports/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/pair_forms.h"

namespace touchstone::fuzz {
namespace {

// Pairs held in memory at a time, each in ten forms, which take a megabyte for hulls of a thousand vertices.
constexpr int at_once = 16;

static_assert(static_cast<std::size_t>(FormKind::unit) + 1 == form_count);  // in the order of form_columns

struct PairForms {
  Case c;
  std::vector<PairForm> forms;
};

PairForms make_pair_forms(const LadderRow& l, std::uint64_t seed, std::size_t rung, int i) {
  Rng rng = Rng::stream(seed, (rung << 32) + static_cast<std::uint64_t>(i));
  PairForms a;
  a.c.id = fmt::format("{}/{}/{}", l.name, rung, i);
  a.c.family = l.name;
  a.c.scene = l.make(rng, l.values[rung]);
  for (Question q : l.questions)
    a.c.queries.push_back(is_pair_question(q) ? Query{q, 0, 1} : Query{q, -1, -1});
  if (is_pair_question(l.questions[0])) a.forms = other_forms(a.c, rng);
  return a;
}

// The number in an answer (distance, depth or time); NaN when it has none.
double number_of(const Query& q, const Observation& o) {
  const double nan = std::nan("");
  if (o.outcome != Outcome::answered) return nan;
  switch (q.question) {
    case Question::distance:
    case Question::bounded_distance:
      return o.distance.value_or(nan);
    case Question::contact:
    case Question::contact_within:
      return o.overlap && *o.overlap ? o.depth.value_or(nan) : nan;
    case Question::time_of_impact:
      return o.toi.value_or(nan);
    default:
      return nan;
  }
}

void raise(double& largest, double x) {
  if (std::isfinite(x)) largest = std::max(largest, x);
}

void count(Rung& r, const Judgement& j) {
  if (was_not_attempted(j.outcome)) return;
  ++r.asked;
  if (j.outcome != Outcome::answered) {
    ++r.failed;
    return;
  }
  ++r.answers;
  r.wrong += !j.faults.empty();
  r.open += j.ruling() == Ruling::undecided || j.ruling() == Ruling::not_judged;
  for (const FaultReport& f : j.faults) switch (f.fault) {
      case Fault::missed:
        ++r.missed;
        break;
      case Fault::ghost:
      case Fault::stale:
        ++r.ghost;
        break;
      case Fault::not_minimal:
      case Fault::normal_not_unit:
        raise(r.normal_error, f.error_in_l);
        break;
      case Fault::late:
      case Fault::early:
        raise(r.impact_error, f.error_in_l);
        break;
      default:
        raise(r.depth_error, f.error_in_l);
    }
}

// Adds one engine's answers to one pair and its forms; observed[0] holds those to the pair itself.
void add_forms(std::span<LadderResult> results, const PairForms& asked,
               std::span<const CaseObservations> observed, std::span<const Judgement> judgements,
               const EngineCard& card, Truth& truth) {
  const FormAnswer base{asked.c, observed[0]};
  for (std::size_t q = 0; q < asked.c.queries.size(); ++q) {
    const Query& query = asked.c.queries[q];
    const Outcome outcome = judgements[q].outcome;
    if (was_not_attempted(outcome)) continue;
    const double l = query.question == Question::time_of_impact ? 1 : truth.scale(0, 1);
    const double x = number_of(query, observed[0].answers[q]);
    Rung& r = results[q].rungs.back();
    std::array<bool, form_count> broken{};
    for (std::size_t f = 0; f < asked.forms.size(); ++f) {
      const PairForm& form = asked.forms[f];
      const auto kind = static_cast<std::size_t>(form.kind);
      const CaseObservations& there = observed[f + 1];
      const double y = number_of(query, there.answers[q]);
      const double of_length = query.question == Question::time_of_impact ? 1 : form.scale;
      raise(r.spread[kind], std::fabs(x - y / of_length) / l);
      if (form.kind == FormKind::nudged || broken[kind]) continue;
      broken[kind] = contradicts(base, !judgements[q].faults.empty(), form, there, q, card, truth);
    }
    for (std::size_t kind = 0; kind < broken.size(); ++kind) r.broken[kind] += broken[kind];
  }
}

// Adds one engine's answers to the pairs of the last rung; results[q] is for the ladder's q-th question.
void add_pairs(std::span<LadderResult> results, const std::vector<PairForms>& all, Engine& engine,
               std::vector<Truth>& truths) {
  std::vector<Case> cases;
  for (const PairForms& a : all) {
    cases.push_back(a.c);
    for (const PairForm& f : a.forms) cases.push_back(f.c);
  }
  const auto answers = engine.run(cases);
  std::span<const CaseObservations> rest = answers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto judgements = judge(all[i].c, engine.card(), rest[0], truths[i]);
    for (std::size_t q = 0; q < judgements.size(); ++q) count(results[q].rungs.back(), judgements[q]);
    add_forms(results, all[i], rest, judgements, engine.card(), truths[i]);
    rest = rest.subspan(all[i].forms.size() + 1);
  }
}

void climb_one(Stability& s, const LadderRow& l, std::span<const EnginePtr> engines,
               const std::function<void(const std::string&)>& progress) {
  std::vector<std::vector<LadderResult>> results;  // by engine, by question
  for (const EnginePtr& e : engines) {
    auto& of_engine = results.emplace_back();
    for (Question q : l.questions)
      of_engine.push_back({l.name, e->card().name, std::string(to_string(q)), {}});
  }
  for (std::size_t rung = 0; rung < l.values.size(); ++rung) {
    if (progress) progress(fmt::format("{}: rung {} of {}", l.name, rung + 1, l.values.size()));
    for (auto& of_engine : results)
      for (LadderResult& r : of_engine) r.rungs.emplace_back().value = l.values[rung];
    for (int first = 0; first < s.per_rung; first += at_once) {
      std::vector<PairForms> all;
      for (int i = first; i < std::min(first + at_once, s.per_rung); ++i)
        all.push_back(make_pair_forms(l, s.seed, rung, i));
      std::vector<Truth> truths;
      for (const PairForms& a : all) truths.emplace_back(a.c.scene);
      for (std::size_t e = 0; e < engines.size(); ++e) add_pairs(results[e], all, *engines[e], truths);
    }
  }
  for (auto& of_engine : results)
    for (LadderResult& r : of_engine)
      if (std::any_of(r.rungs.begin(), r.rungs.end(), [](const Rung& x) { return x.asked > 0; }))
        s.results.push_back(std::move(r));
}

}  // namespace

Stability climb(const std::string& ladder, std::uint64_t seed, int per_rung,
                std::span<const EnginePtr> engines, const std::function<void(const std::string&)>& progress) {
  Stability s;
  s.seed = seed;
  s.per_rung = per_rung;
  for (const LadderRow& l : ladders()) {
    if (!ladder.empty() && ladder != l.name) continue;
    s.ladders.push_back({l.name, l.line, l.unit});
    climb_one(s, l, engines, progress);
  }
  if (s.ladders.empty()) {
    std::string names;
    for (const LadderRow& l : ladders()) names += (names.empty() ? "" : ", ") + std::string(l.name);
    throw InputError("--ladder " + ladder, "there is no such ladder, only " + names);
  }
  return s;
}

}  // namespace touchstone::fuzz
