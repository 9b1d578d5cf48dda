#include <fmt/format.h>

#include "cli/campaign_end.h"
#include "cli/causes_of_campaign.h"
#include "cli/command.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/store.h"
#include "reports/record/stored.h"
#include "reports/text/causes_text.h"
#include "reports/text/web_page.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

struct ReportOptions {
  std::string directory, out;
  bool verbose = false;
};

fuzz::Json settings_in(const std::filesystem::path& file) {
  const fuzz::Json j = load_json(file, campaign_limits);
  return JsonReader(j, file.string())["settings"].json();
}

// The data that reports/web/src/report draws: the causes, the summary without histograms, and findings as
// columns.
fuzz::Json report_page(const std::filesystem::path& directory, fuzz::Json summary,
                       const fuzz::Causes& causes) {
  fuzz::Json findings = reports::findings_columns(summary.at("findings"));
  summary.erase("findings");
  for (auto& [engine, questions] : summary.at("engines").items())
    for (auto& [question, tally] : questions.items()) tally.erase("ns_histogram");
  fuzz::Json settings;
  if (std::filesystem::exists(directory / "state.json")) settings = settings_in(directory / "state.json");
  return {{"page", "report"},
          {"version", 3},
          {"title", "campaign " + directory.string()},
          {"directory", directory.string()},
          {"settings", std::move(settings)},
          {"causes", reports::cause_rows(causes, directory.string())},
          {"summary", std::move(summary)},
          {"findings", std::move(findings)}};
}

int run(const ReportOptions& o) {
  std::filesystem::path directory = o.directory;
  if (!directory.has_filename()) directory = directory.parent_path();
  const auto file = directory / "summary.json";
  if (!std::filesystem::exists(file))
    throw InputError(
        o.directory,
        "holds no summary.json: it is not a campaign's directory, or the campaign is unfinished");
  prepare_output(o.out);
  const fuzz::Json summary = load_json(file, campaign_limits);
  // The summary has counts only; the state also has the cases that causes are told apart by.
  const fuzz::CampaignResult result = std::filesystem::exists(directory / "state.json")
                                          ? fuzz::load_result(directory)
                                          : fuzz::result_from_json(JsonReader(summary, file.string()));
  const fuzz::Causes causes = known_causes(directory.string(), result);
  fmt::print("{}", results_text(result, {.verbose = o.verbose, .causes = &causes}));
  if (o.out.empty()) return exit_clean;
  if (!write_page("report", json_text(report_page(directory, summary, causes)), o.out)) return exit_failed;
  fmt::print("{}: open it in a browser\n", o.out);
  return exit_clean;
}

}  // namespace

Run declare_report(CLI::App& app) {
  auto o = std::make_shared<ReportOptions>();
  app.add_option("directory", o->directory, "directory of a campaign (`fuzz --out`)")->required();
  app.add_option("-o,--out", o->out, "file for the page (self-contained HTML)");
  add_verbose(app, o->verbose);
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
