#include "cli/causes_of_campaign.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/engine_paths.h"
#include "cli/engines_by_card.h"
#include "cli/judged_by.h"
#include "cli/program_for.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/directory_lock.h"
#include "fuzz/campaign/store.h"
#include "fuzz/causes/causes.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

// An engine that hangs is asked often; less than half a second, after WorkerLimits::patience, tells as much
// as the four of a campaign.
constexpr double most_query_seconds = 0.1;

// What was done so far: one line on a terminal, otherwise a line every ten seconds.
class ExaminationProgress {
 public:
  void operator()(std::size_t done, std::size_t of) {
    const auto now = Clock::now();
    if (!live_ && done < of && now - last_ < std::chrono::seconds(10)) return;
    last_ = now;
    fmt::print(stderr, "{}{} of {} representative findings reduced and asked in other forms{}",
               live_ ? "\r\033[K" : "", done, of, live_ && done < of ? "" : "\n");
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const bool live_ = isatty(2) == 1;
  Clock::time_point last_ = Clock::now();
};

fuzz::Causes find_causes(const CausesSearch& search, const fuzz::CampaignResult& result) {
  const std::vector<std::string> given =
      search.engines.empty() ? std::vector<std::string>() : engine_names(search.engines);
  const Foreign foreign = foreign_engines(given, search.limits);
  ExaminationProgress progress;
  fuzz::CausesConfig config;
  config.knowledge = catalogued_knowledge();
  config.make = [&](const std::string& name) {
    return make_by_card(name, foreign, search.limits, search.error);
  };
  config.program = [&](const fuzz::Finding& f, const EngineCard& card) {
    const auto given_as = foreign.find(f.engine);
    return program_for(f, card, given_as == foreign.end() ? f.engine : given_as->second);
  };
  config.jobs = search.jobs;
  config.minutes = search.minutes;
  config.stop = &interrupted;
  config.progress = [&](std::size_t done, std::size_t of) { progress(done, of); };
  return fuzz::causes_of(result, config);
}

constexpr const char* file_name = "causes.json";

// Those stored beside the campaign, if they are of this result.
std::optional<fuzz::Causes> stored_causes(const std::filesystem::path& directory,
                                          const fuzz::CampaignResult& result) {
  const std::filesystem::path file = directory / file_name;
  if (!std::filesystem::exists(file)) return std::nullopt;
  const fuzz::Json j = load_json(file, campaign_limits);
  fuzz::Causes causes = fuzz::causes_from_json(JsonReader(j, file.string()));
  if (causes.digest != fuzz::digest(result)) return std::nullopt;
  return causes;
}

}  // namespace

fuzz::Causes known_causes(const std::string& directory, const fuzz::CampaignResult& result) {
  if (!directory.empty())
    if (auto stored = stored_causes(directory, result)) return *std::move(stored);
  return fuzz::causes_at_once(result, catalogued_knowledge());
}

fuzz::Causes causes_of_campaign(CausesSearch& search, bool again) {
  search.limits.query_cpu_seconds = std::min(search.limits.query_cpu_seconds, most_query_seconds);
  search.limits.stop = &interrupted;
  if (!search.error.empty()) length_from_text(search.error);  // refuses a bad length at once
  const std::filesystem::path directory = search.directory;
  const fuzz::DirectoryLock lock(directory, fuzz::DirectoryLock::For::reading);
  const fuzz::CampaignResult result = fuzz::load_result(directory);
  if (!again)
    if (auto stored = stored_causes(directory, result)) return *std::move(stored);
  const auto j = fuzz::load_settings(directory);
  fuzz::Causes causes = find_causes(search, result);
  causes.campaign = search.directory;
  causes.seed = j.at("seed").get<std::uint64_t>();
  if (!interrupted) write_file(directory / file_name, json_text(to_json(causes), 1) + "\n");
  return causes;
}

}  // namespace touchstone::cli
