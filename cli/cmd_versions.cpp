// touchstone versions ENGINE: which releases of an engine from npm have which causes.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cli/causes_of_campaign.h"
#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/engines_by_card.h"
#include "cli/npm_releases.h"
#include "cli/output.h"
#include "cli/release_engines.h"
#include "core/base/input_error.h"
#include "fuzz/bisect/releases.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/causes/causes.h"
#include "fuzz/certify/conformance.h"
#include "reports/text/record_text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/name_list.h"

namespace touchstone::cli {
namespace {

using fuzz::VersionTable;

struct VersionsOptions {
  std::string engines, causes, out;
  ReleaseChoice choice;
  std::size_t releases = 6;
  std::uint64_t seed = 1, cases = 400;
  int jobs = 1;
  bool json = false, markdown = false;
  WorkerLimits limits;
};

// Small enough that the causes of a campaign of six releases are found in minutes.
constexpr std::size_t representatives = 1, tries = 150;

// An engine of the package, by the name on a card: without its release.
const NpmRow* row_of(const std::string& engine, std::string_view package) {
  const auto found = find_npm_engine(engine.substr(0, engine.find('@')));
  return found && found->row->package == package ? found->row : nullptr;
}

VersionTable::Release examine(const NpmEngine& e, ReleaseEngines& engines) {
  VersionTable::Release r{e.release, 0, 0, ""};
  const EnginePtr& engine = engines.of(e);
  if (!engine) {
    r.cannot = engines.why_not(e);
    return r;
  }
  for (const fuzz::Remark& remark : fuzz::conformance(*engine)) {
    r.answered += remark.verdict != "unsupported";
    r.wrong += remark.verdict == "wrong";
    if (r.cannot.empty()) r.cannot = remark.words;
  }
  if (r.answered > 0) r.cannot.clear();
  return r;
}

// The causes of a short campaign of these releases themselves.
fuzz::Causes own_causes(const VersionsOptions& o, const VersionTable& t) {
  fuzz::CampaignConfig config;
  for (const VersionTable::Release& r : t.releases)
    if (r.cannot.empty()) config.engines.push_back(fmt::format("{}@{}", t.engine, r.number));
  if (config.engines.empty()) return {};
  config.subject = config.engines.back();
  config.seed = o.seed;
  config.cases = o.cases;
  config.jobs = o.jobs;
  const auto make_all = [&] {
    std::vector<EnginePtr> all;
    for (const std::string& name : config.engines) all.push_back(make_engine(name, o.limits));
    return all;
  };
  const auto result = fuzz::run_campaign(
      config, make_all, [](const fuzz::Progress&) {}, interrupted);
  const Foreign none;
  fuzz::CausesConfig search;
  search.knowledge = catalogued_knowledge();
  search.make = [&](const std::string& name) { return make_by_card(name, none, o.limits, ""); };
  search.jobs = o.jobs;
  search.representatives = representatives;
  search.tries = tries;
  search.stop = &interrupted;
  fmt::print(stderr, "{}: finding the causes of {} kinds of findings\n", t.engine, result.findings.size());
  return fuzz::causes_of(result, search);
}

void add_rows(VersionTable& t, const fuzz::Causes& causes, ReleaseEngines& engines) {
  for (const fuzz::Cause& cause : causes.causes) {
    const fuzz::CauseCase& shown = cause.shown();
    const NpmRow* row = row_of(shown.engine, t.package);
    if (!row || shown.c.is_null()) continue;
    const fuzz::FaultSought sought = fuzz::fault_in(shown.key, shown.engine);
    const Case c = case_from_json(shown.c, "cause " + cause.id);
    VersionTable::Row r{
        cause.id, cause.title, std::string(row->name), sought.question, sought.fault, cause.severity,
        shown.c,  {}};
    for (const VersionTable::Release& release : t.releases) {
      const NpmEngine e{row, release.number};
      const EnginePtr& engine = engines.of(e);
      r.says.push_back(engine ? fuzz::ask_release(c, sought, engine)
                              : fuzz::ReleaseSays{fuzz::Showing::lacks, engines.why_not(e)});
    }
    t.rows.push_back(std::move(r));
  }
}

VersionTable table_of(const VersionsOptions& o, const std::string& name,
                      const std::optional<fuzz::Causes>& given) {
  const NpmRow& row = npm_row_named(name);
  std::vector<std::string> releases = chosen_releases(row, o.choice);
  if (o.choice.only.empty()) releases = spread_releases(releases, o.releases);
  ReleaseEngines engines(o.limits);
  VersionTable t{name, std::string(row.package), {}, {}};
  for (const std::string& release : releases) t.releases.push_back(examine({&row, release}, engines));
  add_rows(t, given ? *given : own_causes(o, t), engines);
  return t;
}

std::string text_of(const VersionsOptions& o, const std::vector<VersionTable>& tables) {
  if (o.json) {
    fuzz::Json j = fuzz::Json::array();
    for (const VersionTable& t : tables) j.push_back(to_json(t));
    return json_text(tables.size() == 1 ? j[0] : j, 1) + "\n";
  }
  std::string text;
  for (const VersionTable& t : tables) {
    if (!text.empty()) text += "\n";
    text += o.markdown ? reports::versions_markdown(t) : reports::versions_text(t);
  }
  return text;
}

int run(VersionsOptions& o) {
  prepare_output(o.out);
  catch_stop_signals();
  o.limits.stop = &interrupted;
  std::optional<fuzz::Causes> given;
  if (!o.causes.empty()) {
    const auto j = load_json(o.causes, campaign_limits);
    given = fuzz::causes_from_json(JsonReader(j, o.causes));
  }
  std::vector<VersionTable> tables;
  for_each_in_list(o.engines, [&](std::string_view name) { npm_row_named(std::string(name)); });
  for_each_in_list(o.engines,
                   [&](std::string_view name) { tables.push_back(table_of(o, std::string(name), given)); });
  if (interrupted) return exit_failed;
  if (o.out.empty())
    fmt::print("{}", text_of(o, tables));
  else
    write_file(o.out, text_of(o, tables));
  const bool asked = std::ranges::any_of(tables, [](const VersionTable& t) {
    return std::ranges::any_of(t.releases, [](const auto& r) { return r.cannot.empty(); });
  });
  return asked ? exit_clean : exit_failed;
}

}  // namespace

Run declare_versions(CLI::App& app) {
  auto o = std::make_shared<VersionsOptions>();
  app.add_option("engines", o->engines, "engines from npm, separated by commas: jolt,rapier")->required();
  app.add_option("--releases", o->releases,
                 "number of releases, spread from the oldest to the newest: the newest patch of each minor "
                 "release, or any if there are fewer")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_release_choice(app, o->choice);
  app.add_option("--causes", o->causes,
                 "causes.json of a campaign (default: a short campaign of these releases finds causes)");
  app.add_option("--cases", o->cases, "cases of the short campaign")->check(a_count())->capture_default_str();
  app.add_option("--seed", o->seed, "seed of the short campaign")->capture_default_str();
  add_jobs(app, o->jobs);
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout")
      ->excludes(app.add_flag("--markdown", o->markdown, "the table as Markdown on stdout"));
  app.add_option("-o,--out", o->out, "write to this file instead of stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
