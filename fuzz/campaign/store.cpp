#include "fuzz/campaign/store.h"

#include <system_error>

#include "core/base/input_error.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::fuzz {
namespace {

// The settings that determine which cases are generated and which questions are put. The number of jobs and
// the time limit may change between sessions.
Json settings(const CampaignConfig& c) {
  Json j = {{"touchstone_campaign", 1}, {"subject", c.subject},
            {"engines", c.engines},     {"family", c.family},
            {"seed", c.seed},           {"shard", c.shard},
            {"shards", c.shards},       {"relations_every", c.relations_every},
            {"guided", c.guided}};
  j["cases"] = c.cases ? Json(*c.cases) : Json(nullptr);
  for (const ShapeKind k : c.kinds) j["kinds"].push_back(type_name(k));
  if (!c.error.empty()) j["error"] = c.error;
  if (c.keep_answers) j["keep_answers"] = true;
  if (c.certificates) j["certificates"] = true;
  return j;
}

Json pool_json(const Pool& p) {
  Json cases = Json::array();
  for (const Case& c : p.cases) cases.push_back(case_to_json(c));
  return {{"published", p.published}, {"features", p.features}, {"cases", std::move(cases)}};
}

Pool pool_from_json(const JsonReader& j) {
  Pool p;
  p.published = count_of(j["published"]);
  for (const JsonReader& feature : j["features"].items()) p.features.insert(count_of(feature));
  for (const JsonReader& c : j["cases"].items()) p.cases.push_back(campaign_case(c.json(), c.place()));
  return p;
}

}  // namespace

std::optional<StoredState> load_state(const CampaignConfig& config) {
  const auto file = config.out / "state.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  const Json json = load_json(file, campaign_limits);
  const JsonReader j(json, file.string());
  if (j["settings"].json() != settings(config))
    throw InputError(config.out.string(),
                     "holds a campaign with different settings (" + json_text(j["settings"].json()) +
                         "); give another --out or the same settings, or --fresh, which moves it aside");
  StoredState s;
  s.finished = j["finished"].boolean();
  s.next_chunk = count_of(j["next_chunk"]);
  if (s.finished)
    throw InputError(config.out.string(),
                     "holds a finished campaign; give another --out, or --fresh, which moves it aside");
  s.result = result_with_evidence(j["result"]);
  if (j.has("pool")) s.pool = pool_from_json(j["pool"]);
  if (j.has("answers_bytes")) s.answers_bytes = count_of(j["answers_bytes"]);
  return s;
}

void save_state(const CampaignConfig& config, const StoredState& s) {
  if (!config.out.empty()) save_state(config.out, settings(config), s);
}

void save_state(const std::filesystem::path& out, const Json& settings, const StoredState& s) {
  Json j = {{"settings", settings},
            {"finished", s.finished},
            {"next_chunk", s.next_chunk},
            {"result", to_json(s.result, true)}};
  if (s.answers_bytes > 0) j["answers_bytes"] = s.answers_bytes;
  // Only needed to resume.
  if (!s.finished && s.pool.size() > 0) j["pool"] = pool_json(s.pool);
  write_file(out / "state.json", j.dump());
}

void require_campaign(const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory / "state.json"))
    throw InputError(directory.string(), "does not hold a campaign; touchstone fuzz --out DIR creates one");
}

Json load_state_json(const std::filesystem::path& directory) {
  require_campaign(directory);
  return load_json(directory / "state.json", campaign_limits);
}

CampaignResult load_result(const std::filesystem::path& directory) {
  const Json json = load_state_json(directory);
  return result_with_evidence(JsonReader(json, (directory / "state.json").string())["result"]);
}

Json load_settings(const std::filesystem::path& directory) {
  const Json json = load_state_json(directory);
  const JsonReader settings = JsonReader(json, (directory / "state.json").string())["settings"];
  settings.require_object();
  count_of(settings["seed"]);
  settings["family"].string();
  for (const JsonReader& engine : settings["engines"].items()) engine.string();
  return settings.json();
}

bool move_aside(const std::filesystem::path& out) {
  namespace fs = std::filesystem;
  if (!fs::exists(out / "state.json")) return false;
  fs::path from = fs::absolute(out).lexically_normal();
  if (!from.has_filename()) from = from.parent_path();
  for (int n = 1;; ++n) {
    const fs::path to = from.string() + "." + std::to_string(n);
    if (fs::exists(fs::symlink_status(to))) continue;
    std::error_code ec;
    fs::rename(from, to, ec);
    if (ec) throw InputError(out.string(), "cannot be moved aside to " + to.string() + ": " + ec.message());
    return true;
  }
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code ec;
  std::filesystem::create_directories(directory, ec);
  if (ec) throw InputError(directory.string(), "cannot be created: " + ec.message());
}

void save_findings(const std::filesystem::path& out, const CampaignResult& result) {
  for (const auto& [key, f] : result.findings) {
    const auto dir = out / "findings" / key;
    make_directory(dir);
    const Json& evidence = f.evidence_json;
    write_file(dir / "case.json", evidence.at("case").dump(1) + "\n");
    Json j = {{"key", key}};
    j.update(to_json(f));
    for (const char* part : {"observation", "certificate", "received"}) j[part] = evidence.at(part);
    for (const Example& e : f.examples) j["examples"].push_back(to_json(e));
    write_file(dir / "finding.json", j.dump(1) + "\n");
  }
  Json summary = to_json(result, true);
  for (auto& [key, f] : summary["findings"].items()) {
    f.erase("evidence");
    f.erase("examples");
  }
  summary.erase("documents");
  summary["digest"] = digest(result);
  write_file(out / "summary.json", summary.dump(1) + "\n");
}

}  // namespace touchstone::fuzz
