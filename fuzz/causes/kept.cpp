#include "fuzz/causes/kept.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fuzz/ask/evidence.h"
#include "fuzz/causes/parting.h"
#include "fuzz/causes/respond.h"
#include "fuzz/judge/judge.h"
#include "fuzz/shrink/keeps_finding.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {
namespace {

// A fault in one case, in the words of a finding.
struct Occurrence {
  std::string fault, shapes;
  bool moves = false;
};

bool moves(const Body& b) { return b.motion && !(b.motion->linear.isZero(0) && b.motion->angular.isZero(0)); }

// Of questions about a motion only: others ignore it.
bool moves(const Case& c, Question q, int a, int b) {
  if (!is_of_motion(q)) return false;
  const int n = static_cast<int>(c.scene.bodies.size());
  const auto at = [&](int i) { return moves(c.scene.bodies[static_cast<std::size_t>(i)]); };
  if (a >= 0 && b >= 0 && a < n && b < n) return at(a) || at(b);
  return std::any_of(c.scene.bodies.begin(), c.scene.bodies.end(), [](const Body& x) { return moves(x); });
}

std::vector<Occurrence> judged(const Case& c, const EngineCard& card, const CaseObservations& observed,
                               const Symptom& s) {
  Truth truth(c.scene);
  const auto judgements = judge(c, card, observed, truth);
  std::vector<Occurrence> all;
  for (std::size_t i = 0; i < c.queries.size(); ++i) {
    const Question q = c.queries[i].question;
    const Observation& o = observed.answers[i];
    for (const FaultReport& f : judgements[i].faults) {
      if (!shows(s, q, f, judgements[i], o)) continue;
      const std::string fault = f.fault == Fault::failed ? s.detail : std::string(to_string(f.fault));
      all.push_back(
          {fault, o.site.empty() ? shapes_of(c, f.a, f.b) : std::string(any_shapes), moves(c, q, f.a, f.b)});
    }
  }
  return all;
}

std::vector<Occurrence> compared(const Case& c, const std::map<std::string, Finding>& found,
                                 const Symptom& s) {
  std::vector<Occurrence> all;
  for (const auto& [key, f] : found)
    if (symptom_of(f) == s) all.push_back({f.fault, f.shapes, moves(c, s.question, -1, -1)});
  return all;
}

std::vector<std::vector<Occurrence>> occurrences(std::span<const Case> cases, const EnginePtr& e,
                                                 const Symptom& s) {
  std::vector<std::vector<Occurrence>> all;
  if (needs_comparison(s)) {
    const auto found = findings_of(cases, e, found_by(s));
    for (std::size_t i = 0; i < cases.size(); ++i) all.push_back(compared(cases[i], found[i], s));
    return all;
  }
  const auto observed = e->run(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) all.push_back(judged(cases[i], e->card(), observed[i], s));
  return all;
}

bool is_kept(const Occurrence& o, const Kept& k, const std::string& engine,
             const EngineKnowledge& knowledge) {
  return o.fault == k.fault && (!k.moves || o.moves == *k.moves) &&
         (!k.route || route_of(engine, o.shapes, k.symptom.question, knowledge) == *k.route);
}

// A documented fault must not become one that is not, nor the other way round.
bool is_documented_of_parting(const Finding& f, const Symptom& s, const EngineKnowledge& knowledge) {
  if (s.question != Question::time_of_impact || f.fault != to_string(Fault::missed)) return false;
  const std::string route = route_of(f.engine, f.shapes, s.question, knowledge);
  return knowledge.documented(f.engine, s, route, Fault::missed, true) !=
         knowledge.documented(f.engine, s, route, Fault::missed, false);
}

}  // namespace

Kept kept_of(const Case& c, const Finding& f, const EnginePtr& engine, const EngineKnowledge& knowledge) {
  Kept k{symptom_of(f), f.fault, std::nullopt, std::nullopt, std::nullopt};
  if (is_documented_of_parting(f, k.symptom, knowledge)) k.parts = parts_from_start(c);
  if (knowledge.knows_routes(f.engine)) k.route = route_of(f.engine, f.shapes, k.symptom.question, knowledge);
  bool any_moves = false, any_rests = false;
  const auto found = occurrences({&c, 1}, engine, k.symptom);
  for (const Occurrence& o : found.at(0))
    if (is_kept(o, k, f.engine, knowledge)) (o.moves ? any_moves : any_rests) = true;
  if (any_moves != any_rests) k.moves = any_moves;
  return k;
}

StillShows keeps(const EnginePtr& engine, Kept kept, const EngineKnowledge& knowledge) {
  return [&engine, &knowledge, kept = std::move(kept)](std::span<const Case> cases) {
    std::vector<bool> shows;
    for (const auto& found : occurrences(cases, engine, kept.symptom))
      shows.push_back(std::any_of(found.begin(), found.end(), [&](const Occurrence& o) {
        return is_kept(o, kept, engine->card().name, knowledge);
      }));
    if (kept.parts)
      for (std::size_t i = 0; i < cases.size(); ++i)
        shows[i] = shows[i] && parts_from_start(cases[i]) == *kept.parts;
    return shows;
  };
}

}  // namespace touchstone::fuzz
