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
#include "cli/engines_by_card.h"
#include "cli/judged_by.h"
#include "cli/program_for.h"
#include "core/base/exact_text.h"
#include "core/base/hash.h"
#include "core/base/input_error.h"
#include "fuzz/campaign/directory_lock.h"
#include "fuzz/campaign/store.h"
#include "fuzz/causes/causes.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/triage/cause_files.h"
#include "oracles/abi/source_id.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

// An engine that hangs is asked often; less than half a second, after WorkerLimits::patience, tells as much
// as the four of a campaign.
constexpr double most_query_seconds = 0.1;

constexpr const char* examined_file = "causes.examined";

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

// What the answers to examined findings depend on: another list of changes or another limit asks differently.
fuzz::Json about(const CausesSearch& search, const fuzz::CampaignResult& result, bool again) {
  Hasher changes;
  for (const fuzz::Intervention& i : fuzz::interventions) changes.add(i.name);
  return {{"touchstone_examined", 1},
          {"digest", fuzz::digest(result)},
          {"again", again},
          {"changes", hex64(changes.value())},
          {"build", source_id()},
          {"error", search.error},
          {"query_seconds", search.limits.query_cpu_seconds}};
}

fuzz::Causes find_causes(const CausesSearch& search, const fuzz::CampaignResult& result,
                         fuzz::Examinations& examinations) {
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
  config.examinations = &examinations;
  config.progress = [&](std::size_t done, std::size_t of) { progress(done, of); };
  return fuzz::causes_of(result, config);
}

fuzz::CampaignResult result_in(const std::string& directory) {
  fuzz::require_campaign(directory);
  const fuzz::DirectoryLock lock(directory, fuzz::DirectoryLock::For::reading);
  return fuzz::load_result(directory);
}

// Those of the campaign's present state.
std::optional<fuzz::Causes> stored_causes_of(const std::filesystem::path& directory) {
  if (!fuzz::has_causes(directory)) return std::nullopt;
  const fuzz::DirectoryLock lock(directory, fuzz::DirectoryLock::For::reading);
  return fuzz::stored_causes(directory, fuzz::digest(fuzz::load_result(directory)));
}

// What was examined is of no use once its causes are stored.
void store(FoundCauses& found, const std::filesystem::path& directory, fuzz::Examinations& examinations) {
  try {
    fuzz::store_causes(directory, found.causes);
    examinations.remove();
  } catch (const InputError& e) {
    found.not_stored = e.what();
  }
}

}  // namespace

fuzz::Causes known_causes(const std::string& directory, const fuzz::CampaignResult& result) {
  if (!directory.empty())
    if (auto stored = fuzz::stored_causes(directory, fuzz::digest(result))) return *std::move(stored);
  return fuzz::causes_at_once(result, catalogued_knowledge());
}

fuzz::Causes causes_without_asking(const std::string& directory) {
  return known_causes(directory, result_in(directory));
}

fuzz::Causes causes_before_asking(const std::string& directory) {
  return fuzz::causes_at_once(result_in(directory), catalogued_knowledge());
}

FoundCauses causes_of_campaign(CausesSearch& search, bool again) {
  search.limits.query_cpu_seconds = std::min(search.limits.query_cpu_seconds, most_query_seconds);
  search.limits.stop = &interrupted;
  if (!search.error.empty()) length_from_text(search.error);  // refuses a bad length at once
  const std::filesystem::path directory = search.directory;
  fuzz::require_campaign(directory);
  FoundCauses found;
  if (!again)
    if (auto stored = stored_causes_of(directory)) {
      found.causes = *std::move(stored);
      return found;
    }
  const fuzz::DirectoryLock lock(directory, fuzz::DirectoryLock::For::writing);
  const fuzz::CampaignResult result = fuzz::load_result(directory);
  const auto j = fuzz::load_settings(directory);
  fuzz::Examinations examinations(directory / examined_file, about(search, result, again));
  try {
    found.causes = find_causes(search, result, examinations);
  } catch (const Stopped&) {  // after the examinations, before all causes had their evidence
    found.causes = fuzz::causes_at_once(result, catalogued_knowledge());
  }
  found.causes.campaign = search.directory;
  found.causes.seed = j.at("seed").get<std::uint64_t>();
  found.interrupted = interrupted;
  if (found.interrupted) {
    found.kept = examinations.size();
    found.not_kept = examinations.not_kept();
  } else {
    store(found, directory, examinations);
  }
  return found;
}

}  // namespace touchstone::cli
