// touchstone corpus: makes the corpus of hard cases, checks its certificates, and scores engines on it.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/command.h"
#include "cli/corpus_run.h"
#include "cli/engine_catalog.h"
#include "cli/in_parallel.h"
#include "core/base/input_error.h"
#include "fuzz/corpus/corpus_case.h"
#include "fuzz/corpus/corpus_json.h"
#include "fuzz/corpus/truth.h"
#include "reports/text/text.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

namespace corpus = fuzz::corpus;
using reports::counted;

// The installed corpus, or the one in the source tree.
std::string stored_corpus() {
  const std::filesystem::path installed = plugin_directory().parent_path() / "share/touchstone/query-corpus";
  std::error_code error;
  return std::filesystem::is_directory(installed, error) ? installed.string() : TOUCHSTONE_SOURCE "/corpus";
}

struct CorpusMakeOptions {
  std::string directory, seeds = stored_corpus() + "/seeds", only;
  int jobs = processor_count();
};

using Made = std::variant<corpus::CorpusCase, std::string>;

std::vector<corpus::Part> wanted_parts(const CorpusMakeOptions& o) {
  std::vector<corpus::Part> parts = corpus::all_parts(o.seeds);
  for (corpus::Part& p : parts)
    std::erase_if(p.seeds, [&](const corpus::Seed& s) { return !s.id.starts_with(o.only); });
  std::erase_if(parts, [](const corpus::Part& p) { return p.seeds.empty(); });
  if (parts.empty()) throw InputError("--only", "no id begins with " + o.only);
  return parts;
}

std::vector<Made> made_of(const corpus::Part& part, int jobs) {
  std::vector<Made> made(part.seeds.size());
  in_parallel(part.seeds.size(), jobs, [&](std::size_t i) { made[i] = corpus::with_truth(part.seeds[i]); });
  return made;
}

int make_corpus(const CorpusMakeOptions& o) {
  const std::vector<corpus::Part> parts = wanted_parts(o);
  const std::filesystem::path folder = std::filesystem::path(o.directory) / "cases";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), error.message());
  std::size_t cases = 0;
  std::set<std::string> mechanisms;
  for (const corpus::Part& part : parts) {
    std::vector<corpus::CorpusCase> kept;
    const std::vector<Made> made = made_of(part, o.jobs);
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (const auto* c = std::get_if<corpus::CorpusCase>(&made[i])) {
        kept.push_back(*c);
        mechanisms.insert(c->seed.mechanism);
      } else {
        fmt::print("left out: {}: {}\n", part.seeds[i].id, std::get<std::string>(made[i]));
      }
    }
    const std::string text = corpus::file_text(kept);
    write_file(folder / (part.name + ".json"), text);
    cases += kept.size();
    fmt::print("{}: {}, {} kB\n", (folder / (part.name + ".json")).string(),
               counted(kept.size(), "case", "cases"), reports::grouped(text.size() / 1000));
  }
  fmt::print("{}, {}\n", counted(cases, "case", "cases"),
             counted(mechanisms.size(), "mechanism", "mechanisms"));
  return exit_clean;
}

struct CorpusCheckOptions {
  std::string directory = stored_corpus();
  int jobs = processor_count();
};

int check_corpus(const CorpusCheckOptions& o) {
  const auto cases = corpus::load_corpus(o.directory);
  std::vector<corpus::CheckedCase> checked(cases.size());
  in_parallel(cases.size(), o.jobs,
              [&](std::size_t i) { checked[i] = corpus::check_certificates(cases[i]); });
  std::uint64_t certificates = 0, complete = 0, refused = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    certificates += static_cast<std::uint64_t>(checked[i].certificates);
    complete += checked[i].complete;
    if (checked[i].refused.empty()) continue;
    ++refused;
    fmt::print("{}: {}\n", cases[i].id, checked[i].refused);
  }
  fmt::print("{} of {} hold; {} of {} are certified in full\n", reports::grouped(certificates),
             counted(certificates + refused, "certificate", "certificates"), reports::grouped(complete),
             counted(cases.size(), "case", "cases"));
  return refused > 0 ? exit_wrong : certificates > 0 ? exit_clean : exit_failed;
}

CLI::Option* add_corpus_jobs(CLI::App& app, int& jobs) {
  return app.add_option("--jobs", jobs, "threads (default: one for each processor)")->check(a_count());
}

}  // namespace

Run declare_corpus(CLI::App& app) {
  auto making = std::make_shared<CorpusMakeOptions>();
  CLI::App* make_app = app.add_subcommand("make", "make the cases: what is true of them, with certificates");
  make_app->add_option("directory", making->directory, "writes DIR/cases/*.json")->required();
  make_app->add_option("--seeds", making->seeds, "directory of reported failures and causes, as JSON")
      ->capture_default_str();
  make_app->add_option("--only", making->only, "only cases whose ids begin with this");
  add_corpus_jobs(*make_app, making->jobs);

  auto checking = std::make_shared<CorpusCheckOptions>();
  CLI::App* check_app = app.add_subcommand("check", "verify every certificate in exact arithmetic");
  check_app->add_option("directory", checking->directory, "the corpus")->capture_default_str();
  add_corpus_jobs(*check_app, checking->jobs);

  auto running = std::make_shared<CorpusRunOptions>();
  running->directory = stored_corpus();
  CLI::App* run_app = app.add_subcommand("run", "ask engines, and print what they get wrong by flag");
  declare_corpus_run(*run_app, *running);

  app.require_subcommand(1);
  return [=] {
    if (make_app->parsed()) return make_corpus(*making);
    if (check_app->parsed()) return check_corpus(*checking);
    return corpus_run(*running);
  };
}

}  // namespace touchstone::cli
