#include "fuzz/causes/causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "fuzz/causes/assembly.h"
#include "fuzz/causes/classes.h"

namespace touchstone::fuzz {
namespace {

void count_all(Causes& out, const CampaignResult& result) {
  out.digest = digest(result);
  out.cases = result.cases;
  out.keys = result.findings.size();
  std::uint64_t once = 0;
  for (const auto& [key, f] : result.findings) out.answers += f.count;
  for (const Cause& c : out.causes) once += c.wrong == 1;
  if (out.answers > 0) out.unseen = static_cast<double>(once) / static_cast<double>(out.answers);
}

Causes assembled(const CampaignResult& result, const Parts& p, const EngineKnowledge& knowledge,
                 const std::function<void(Cause&, const Representative&)>& add) {
  const Assembly assembly(result, p, knowledge);
  std::vector<Cause> causes;
  std::vector<const Representative*> leaders;
  const std::vector<Group> groups = assembly.identified(p.groups);
  for (const Group& g : groups) {
    causes.push_back(assembly.cause_of(g));
    add(causes.back(), assembly.leader(g));
    leaders.push_back(&assembly.leader(g));
  }
  Causes out;
  for (const std::size_t i : reading_order(causes, [&](std::size_t x, std::size_t y) {
         return difference(*leaders[x], *leaders[y]) + (causes[x].path != causes[y].path) +
                (causes[x].route != causes[y].route);
       }))
    out.causes.push_back(std::move(causes[i]));
  count_all(out, result);
  return out;
}

// Symptoms of the engine in every example of the finding, as far as they are stored.
std::set<Symptom> common_symptoms(const Finding& f, const CampaignResult& result,
                                  const std::map<std::uint64_t, std::vector<std::string>>& keys) {
  std::optional<std::set<Symptom>> common;
  for (const Example& e : f.examples) {
    const auto at = keys.find(e.index);
    if (at == keys.end()) continue;
    std::set<Symptom> here;
    for (const std::string& key : at->second) {
      const Finding& other = result.findings.at(key);
      if (other.engine == f.engine && other.shapes == f.shapes) here.insert(symptom_of(other));
    }
    if (!common) {
      common = std::move(here);
      continue;
    }
    std::erase_if(*common, [&](const Symptom& s) { return !here.contains(s); });
  }
  return common.value_or(std::set<Symptom>());
}

void add_not_asked(Causes& out, const Parts& p, EnginePool& pool) {
  std::set<std::string> missing, in_part;
  for (const Representative& r : p.all)
    if (!r.asked) (pool.named(r.finding->engine) ? in_part : missing).insert(r.finding->engine);
  if (!in_part.empty())
    out.notes.push_back(fmt::format(
        "the time was up (--budget) before all findings were asked again of {}; the rest is grouped by what "
        "is stored",
        fmt::join(in_part, ", ")));
  if (!missing.empty())
    out.notes.push_back(
        fmt::format("missing here, so that nothing was asked again of {}", fmt::join(missing, ", ")));
}

}  // namespace

Causes causes_at_once(const CampaignResult& result, const EngineKnowledge& knowledge) {
  Parts p;
  p.classes = classes_of(result, knowledge);
  const auto keys = keys_by_case(result);
  for (std::size_t i = 0; i < p.classes.size(); ++i) {
    p.all.push_back(std::move(representatives_of(p.classes[i], i, 1).at(0)));
    p.all.back().first.responses.also = common_symptoms(*p.all.back().finding, result, keys);
  }
  const std::vector<double> rates = rates_of(p.classes, result);
  p.groups = grouped({p.classes, p.all, rates, knowledge, p.noise});
  return assembled(result, p, knowledge, [](Cause&, const Representative&) {});
}

Causes causes_of(const CampaignResult& result, const CausesConfig& config) {
  Parts p;
  p.classes = classes_of(result, config.knowledge, Contradictions::apart);
  p.all = examined(p.classes, config);
  const std::vector<double> rates = rates_of(p.classes, result);
  p.noise = noise_of(p.classes, p.all);
  const GroupInput in{p.classes, p.all, rates, config.knowledge, p.noise};
  p.groups = grouped(in);
  if (config.before_cross_asking)
    config.before_cross_asking(assembled(result, p, config.knowledge, [](Cause&, const Representative&) {}));
  EnginePool pool(config.make);
  p.groups = told_apart(std::move(p.groups), in, pool);
  Causes out = assembled(result, p, config.knowledge, [&](Cause& cause, const Representative& r) {
    if (r.asked) add_evidence(cause, r, config, pool);
  });
  add_not_asked(out, p, pool);
  return out;
}

}  // namespace touchstone::fuzz
