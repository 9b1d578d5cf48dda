#include <fmt/format.h>

#include "core/base/input_error.h"
#include "core/scene/codec.h"
#include "core/scene/json_file.h"
#include "fuzz/cli/command.h"
#include "fuzz/cli/output_file.h"
#include "fuzz/cli/pages.h"
#include "fuzz/record/result.h"
#include "reports/findings_columns.h"
#include "reports/text.h"

namespace touchstone::cli {
namespace {

struct ReportOptions {
  std::string directory, out;
};

// By way of the sorted kind: the ordered one looks for a key among all before it, and 1e5 findings take half
// a minute.
fuzz::Json read_json(const std::filesystem::path& file) {
  try {
    return load_json(file, campaign_limits);
  } catch (const fuzz::Json::exception& e) {
    throw InputError(file.string(), std::string("is no JSON: ") + e.what());
  }
}

// What reports/web/src/report draws: the summary without histograms, and findings as columns.
fuzz::Json report_page(const std::filesystem::path& directory, fuzz::Json summary) {
  fuzz::Json findings = reports::findings_columns(summary.at("findings"));
  summary.erase("findings");
  for (auto& [engine, questions] : summary.at("engines").items())
    for (auto& [question, tally] : questions.items()) tally.erase("ns_histogram");
  fuzz::Json settings;
  if (std::filesystem::exists(directory / "state.json"))
    settings = read_json(directory / "state.json").value("settings", fuzz::Json());
  return {{"page", "report"},
          {"version", 2},
          {"title", "campaign " + directory.string()},
          {"directory", directory.string()},
          {"settings", std::move(settings)},
          {"summary", std::move(summary)},
          {"findings", std::move(findings)}};
}

int run(const ReportOptions& o) {
  std::filesystem::path directory = o.directory;
  if (!directory.has_filename()) directory = directory.parent_path();
  const auto file = directory / "summary.json";
  if (!std::filesystem::exists(file))
    throw InputError(o.directory,
                     "holds no summary.json: not the directory of a campaign, or it is not finished");
  require_writable(o.out);
  const fuzz::Json summary = read_json(file);
  try {
    const fuzz::CampaignResult result = fuzz::result_from_json(summary);
    fmt::print("{}\n{}{}", reports::campaign_table(result), reports::findings_summary(result, 3),
               reports::campaign_footer(result));
    if (o.out.empty()) return exit_clean;
    if (!write_page("report", report_page(directory, summary).dump(), o.out)) return exit_failed;
  } catch (const fuzz::Json::exception& e) {
    throw InputError(file.string(), std::string("is not a campaign's summary: ") + e.what());
  }
  fmt::print("{}: open it in a browser\n", o.out);
  return exit_clean;
}

}  // namespace

Run declare_report(CLI::App& app) {
  auto o = std::make_shared<ReportOptions>();
  app.add_option("directory", o->directory, "what `fuzz --out` wrote")->required();
  app.add_option("-o,--out", o->out, "the page to write (HTML, loads nothing)");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
