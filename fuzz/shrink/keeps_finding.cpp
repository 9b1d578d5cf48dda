#include "fuzz/shrink/keeps_finding.h"

#include "fuzz/campaign/campaign.h"
#include "fuzz/record/degeneracy.h"
#include "fuzz/record/magnitude.h"

namespace touchstone::fuzz {

std::vector<std::map<std::string, double>> findings_of(std::span<const Case> cases, const EnginePtr& engine) {
  const auto observations = engine->run(cases);
  std::vector<std::map<std::string, double>> out(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CampaignResult r;
    judge_into(r, cases[i], i, {&engine, 1}, {&observations[i], 1});
    for (const auto& [key, f] : r.findings) out[i].emplace(key, f.worst_in_l);
  }
  return out;
}

StillShows keeps_finding(const EnginePtr& engine, const Case& c, std::string key, double error_in_l) {
  return [&engine, key = std::move(key), magnitude = magnitude_of(error_in_l),
          flat_allowed = has_flat_shape(c)](std::span<const Case> cases) {
    std::vector<Case> asked;
    std::vector<bool> shows(cases.size());
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (flat_allowed || !has_flat_shape(cases[i])) asked.push_back(cases[i]), index.push_back(i);
    const auto found = findings_of(asked, engine);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const auto it = found[i].find(key);
      shows[index[i]] = it != found[i].end() && magnitude_of(it->second) == magnitude;
    }
    return shows;
  };
}

}  // namespace touchstone::fuzz
