#include "fuzz/ask/unstable.h"

#include <string>

#include "reports/record/observation_json.h"

namespace touchstone::fuzz {
namespace {

/// Names of the fields in which two observations differ. `detail` is ignored: it is only for people.
std::vector<std::string> differences(const Observation& one, const Observation& two) {
  Json x = to_json(one), y = to_json(two);
  for (Json* j : {&x, &y}) j->erase("detail");
  std::vector<std::string> names;
  for (const auto& [name, value] : x.items())
    if (!y.contains(name) || y[name] != value) names.push_back(name);
  for (const auto& [name, value] : y.items())
    if (!x.contains(name)) names.push_back(name);
  return names;
}

void erase(Observation& o, const std::string& name) {
  if (name == "overlap") o.overlap.reset();
  if (name == "distance") o.distance.reset();
  if (name == "witness") o.witness.reset();
  if (name == "normal") o.normal.reset();
  if (name == "moment") o.moment.reset();
  if (name == "unique_gradient") o.unique_gradient.reset();
  if (name == "depth") o.depth.reset();
  if (name == "manifold") o.manifold.clear();
  if (name == "toi") o.toi.reset();
  if (name == "lower_bound") o.lower_bound.reset();
  if (name == "upper_bound") o.upper_bound.reset();
  if (name == "candidate_pairs") o.candidate_pairs.clear();
  if (name == "contacts") o.contacts.clear();
  if (name == "claimed_tolerance") o.claimed_tolerance = 0;
  if (name == "site") o.site.clear();
}

Judgement unstable(const Query& q, const Judgement& was, const std::vector<std::string>& names) {
  Judgement j;
  j.outcome = was.outcome;
  j.blame = Blame::algorithm;
  FaultReport f;
  f.fault = Fault::unstable;
  f.a = q.a;
  f.b = q.b;
  f.words = "asked again, it answers differently:";
  for (const std::string& name : names) f.words += " " + name;
  j.faults = j.received_faults = {f};
  return j;
}

bool took_too_long(const Observation& o) { return depends_on_time(o.outcome); }

struct Again {
  std::vector<std::size_t> of;  // indices into the case's queries
  std::vector<Observation> answers;
};

/// Repeats the case without the questions that took too long.
Again ask_again(const Case& c, Engine& engine, const CaseObservations& observed) {
  Again again;
  Case shorter = c;
  shorter.queries.clear();
  for (std::size_t i = 0; i < c.queries.size() && i < observed.answers.size(); ++i) {
    if (took_too_long(observed.answers[i])) continue;
    shorter.queries.push_back(c.queries[i]);
    again.of.push_back(i);
  }
  if (shorter.queries.empty()) return {};
  auto answers = engine.run_again({&shorter, 1});
  if (answers.empty()) return {};
  again.answers = std::move(answers[0].answers);
  return again;
}

}  // namespace

void remove_unstable(const Case& c, Engine& engine, CaseObservations& observed,
                     std::vector<Judgement>& judgements) {
  bool any = false;
  for (std::size_t i = 0; i < judgements.size() && i < observed.answers.size(); ++i)
    any |= !judgements[i].faults.empty() && !took_too_long(observed.answers[i]);
  if (!any) return;
  const Again again = ask_again(c, engine, observed);
  for (std::size_t k = 0; k < again.answers.size(); ++k) {
    const std::size_t i = again.of[k];
    if (judgements[i].faults.empty() || took_too_long(again.answers[k])) continue;
    const auto names = differences(observed.answers[i], again.answers[k]);
    if (names.empty()) continue;
    judgements[i] = unstable(c.queries[i], judgements[i], names);
    for (const std::string& name : names) erase(observed.answers[i], name);
  }
}

bool repeats(const Case& c, Engine& engine, const CaseObservations& observed) {
  const Again again = ask_again(c, engine, observed);
  for (std::size_t k = 0; k < again.answers.size(); ++k)
    if (!took_too_long(again.answers[k]) &&
        !differences(observed.answers[again.of[k]], again.answers[k]).empty())
      return false;
  return true;
}

}  // namespace touchstone::fuzz
