#include "fuzz/shrink/keeps_finding.h"

#include "fuzz/ask/ask.h"

namespace touchstone::fuzz {

std::vector<std::map<std::string, Finding>> findings_of(std::span<const Case> cases, const EnginePtr& engine,
                                                        FoundBy by) {
  const auto observations = engine->run(cases);
  std::vector<std::map<std::string, Finding>> out(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CampaignResult r;
    if (by != FoundBy::referee) relate_into(r, cases[i], i, engine, observations[i]);
    if (by != FoundBy::relations) judge_into(r, cases[i], i, {&engine, 1}, {&observations[i], 1});
    out[i] = std::move(r.findings);
  }
  return out;
}

FoundBy found_by(const std::string& key) {
  return key.find(".relation_") != std::string::npos ? FoundBy::relations : FoundBy::referee;
}

StillShows keeps_finding(const EnginePtr& engine, std::string key) {
  return [&engine, by = found_by(key), key = std::move(key)](std::span<const Case> cases) {
    std::vector<bool> shows;
    for (const auto& found : findings_of(cases, engine, by)) shows.push_back(found.contains(key));
    return shows;
  };
}

std::string key_of_fault(const std::map<std::string, Finding>& found, const std::string& key) {
  if (found.contains(key)) return key;
  const std::string prefix = key.substr(0, key.rfind('.') + 1);
  const auto at = found.lower_bound(prefix);
  return at != found.end() && at->first.starts_with(prefix) ? at->first : std::string();
}

StillShows keeps_fault(const EnginePtr& engine, const std::string& key) {
  return [&engine, by = found_by(key), key](std::span<const Case> cases) {
    std::vector<bool> shows;
    for (const auto& found : findings_of(cases, engine, by))
      shows.push_back(!key_of_fault(found, key).empty());
    return shows;
  };
}

}  // namespace touchstone::fuzz
