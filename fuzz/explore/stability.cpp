#include "fuzz/explore/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/input_error.h"
#include "fuzz/explore/ladders.h"
#include "fuzz/judge/judge.h"

namespace touchstone::fuzz {
namespace {

// Each coordinate of B to the next double, up or down.
Scene nudged(Scene s, Rng& rng) {
  for (double& x : s.bodies[1].pose.translation)
    x = std::nextafter(x, rng.chance(0.5) ? HUGE_VAL : -HUGE_VAL);
  return s;
}

struct Trio {
  Case asked, near, exchanged;
};

Trio trio(const LadderRow& l, std::uint64_t seed, std::size_t rung, int i) {
  Rng rng = Rng::stream(seed, (rung << 32) + static_cast<std::uint64_t>(i));
  Trio t;
  t.asked.id = fmt::format("{}/{}/{}", l.name, rung, i), t.asked.family = l.name;
  t.asked.scene = l.make(rng, l.values[rung]);
  for (Question q : l.questions)
    t.asked.queries.push_back(is_pair_question(q) ? Query{q, 0, 1} : Query{q, -1, -1});
  t.near = t.exchanged = t.asked;
  t.near.scene = nudged(t.asked.scene, rng);
  for (Query& q : t.exchanged.queries) std::swap(q.a, q.b);
  return t;
}

// The number that an answer is about; NaN when it states none.
double number_of(const Query& q, const Observation& o) {
  const double nan = std::nan("");
  if (o.outcome != Outcome::answered) return nan;
  switch (q.question) {
    case Question::distance:
      return o.distance.value_or(nan);
    case Question::contact:
      return o.overlap && *o.overlap ? o.depth.value_or(nan) : nan;
    case Question::time_of_impact:
      return o.toi.value_or(nan);
    default:
      return nan;
  }
}

void raise(double& most, double x) {
  if (std::isfinite(x)) most = std::max(most, x);
}

void count(Rung& r, const Judgement& j) {
  if (j.outcome == Outcome::unsupported) return;
  ++r.asked;
  if (j.outcome != Outcome::answered) {
    ++r.failed;
    return;
  }
  ++r.answers, r.wrong += !j.faults.empty();
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

// One engine at one rung; results[q] is the ladder's q-th question.
void add_rung(std::span<LadderResult> results, double value, const std::vector<Trio>& trios, Engine& engine,
              std::vector<Truth>& truths) {
  for (LadderResult& r : results) r.rungs.emplace_back().value = value;
  std::vector<Case> cases;
  for (const Trio& t : trios) cases.insert(cases.end(), {t.asked, t.near, t.exchanged});
  const auto answers = engine.run(cases);
  for (std::size_t i = 0; i < trios.size(); ++i) {
    const auto judgements = judge(trios[i].asked, engine.card(), answers[3 * i], truths[i]);
    for (std::size_t q = 0; q < judgements.size(); ++q) {
      Rung& r = results[q].rungs.back();
      count(r, judgements[q]);
      const Query& query = trios[i].asked.queries[q];
      if (!is_pair_question(query.question)) continue;
      const double l = query.question == Question::time_of_impact ? 1 : truths[i].scale(0, 1);
      const double x = number_of(query, answers[3 * i].answers[q]);
      raise(r.jitter, std::fabs(x - number_of(query, answers[3 * i + 1].answers[q])) / l);
      raise(r.order, std::fabs(x - number_of(query, answers[3 * i + 2].answers[q])) / l);
    }
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
    std::vector<Trio> trios;
    for (int i = 0; i < s.per_rung; ++i) trios.push_back(trio(l, s.seed, rung, i));
    std::vector<Truth> truths;
    for (const Trio& t : trios) truths.emplace_back(t.asked.scene);
    for (std::size_t e = 0; e < engines.size(); ++e)
      add_rung(results[e], l.values[rung], trios, *engines[e], truths);
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
  s.seed = seed, s.per_rung = per_rung;
  for (const LadderRow& l : ladders()) {
    if (!ladder.empty() && ladder != l.name) continue;
    s.ladders.push_back({l.name, l.line, l.unit});
    climb_one(s, l, engines, progress);
  }
  if (s.ladders.empty()) {
    std::string names;
    for (const LadderRow& l : ladders()) names += (names.empty() ? "" : ", ") + std::string(l.name);
    throw InputError("--ladder " + ladder, "no such ladder; there are " + names);
  }
  return s;
}

}  // namespace touchstone::fuzz
