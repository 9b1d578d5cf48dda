// touchstone fingerprint ENGINE, touchstone fingerprint --compare A B: whether two builds or releases of an
// engine give the same answers.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cli/command.h"
#include "cli/engine_catalog.h"
#include "cli/installed.h"
#include "cli/output.h"
#include "core/base/input_error.h"
#include "fuzz/fingerprint/fingerprint.h"
#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

struct FingerprintOptions {
  std::string engine, out, of_build;
  std::vector<std::string> compared;
  std::uint64_t cases = fuzz::fingerprint_cases;
  int jobs = 1;
  bool json = false;
  WorkerLimits limits;
};

EnginePtr make(const FingerprintOptions& o, const std::string& name) {
  return o.of_build.empty() ? make_engine(name, o.limits) : make_engine_of_build(name, o.of_build, o.limits);
}

fuzz::Fingerprint ask(const FingerprintOptions& o, const std::string& text) {
  const std::string name = engine_name(text);
  fuzz::FingerprintConfig config;
  config.make = [&] { return make(o, name); };
  config.cases = o.cases;
  config.jobs = o.jobs;
  config.stop = &interrupted;
  return fuzz::fingerprint_of(config);
}

std::string stored_text(const fuzz::Fingerprint& f) { return json_text(to_json(f), 1) + "\n"; }

// One side of a comparison: a file, or an engine that is asked now.
struct Side {
  fuzz::Fingerprint fingerprint;
  std::string engine;  // empty: a file
};

Side side_of(const FingerprintOptions& o, const std::string& text) {
  if (!text.ends_with(".json")) return {ask(o, text), engine_name(text)};
  const auto j = load_json(text);
  return {fuzz::fingerprint_from_json(JsonReader(j, text)), ""};
}

const fuzz::FingerprintDifference::Group& first_group(const fuzz::FingerprintDifference& d) {
  return *std::find_if(d.groups.begin(), d.groups.end(), [](const auto& g) { return !g.same(); });
}

struct FirstCase {
  std::uint64_t index = 0;
  std::size_t query = 0;
  Case c;
};

// The first case in the set about the group's question and shapes whose answers are not the same. Empty if a
// file says so about a group that the set does not have.
std::optional<FirstCase> first_case(const fuzz::FingerprintDifference::Group& g, std::uint64_t cases) {
  const auto place =
      fuzz::place_in_set(g.question, g.shapes, g.first, std::min(cases, fuzz::fingerprint_cases));
  if (!place) return std::nullopt;
  return FirstCase{place->case_index, place->query, fuzz::fingerprint_case(place->case_index)};
}

void print_answer(const FingerprintOptions& o, char letter, const Side& side, const FirstCase& first) {
  if (side.engine.empty()) return;
  const auto observed = make(o, side.engine)->run({&first.c, 1}).front();
  const fuzz::Json answer = fuzz::to_json(observed.answers[first.query]);
  fmt::print("  {}: {}\n", letter, printable(json_text(answer)));
}

int compare(const FingerprintOptions& o) {
  prepare_output(o.out);
  const Side a = side_of(o, o.compared[0]), b = side_of(o, o.compared[1]);
  const auto d = fuzz::difference_of(a.fingerprint, b.fingerprint);
  if (o.json)
    fmt::print("{}\n", json_text(to_json(d), 1));
  else
    fmt::print("{}", reports::difference_text(a.fingerprint, b.fingerprint, d));
  if (d.same()) return exit_clean;
  const auto& g = first_group(d);
  const auto first = first_case(g, a.fingerprint.cases);
  if (!first) return exit_wrong;
  if (!o.json) {
    fmt::print("\nfirst: case {} ({}), {} of {}\n", first->index, first->c.id, g.question, g.shapes);
    print_answer(o, 'A', a, *first);
    print_answer(o, 'B', b, *first);
  }
  if (!o.out.empty()) {
    StoredCase stored;
    stored.c = first->c;
    stored.c.queries = {stored.c.queries[first->query]};
    stored.source = fmt::format("case {} of set {} of fingerprints", first->index, fuzz::fingerprint_set);
    save_case(stored, o.out);
  }
  return exit_wrong;
}

void find_runner(std::vector<std::string>& words) {
  std::erase(words, "");
  if (words.empty() || words.front().find('/') != std::string::npos) return;
  const std::string file = program_on_path(words.front());
  if (file.empty()) throw InputError("--run-with " + words.front(), "there is no such program");
  words.front() = file;
}

int run(FingerprintOptions& o) {
  find_runner(o.limits.run_with);
  catch_stop_signals();
  o.limits.stop = &interrupted;
  if (!o.compared.empty()) return compare(o);
  if (o.engine.empty()) throw InputError("fingerprint", "needs an engine, or --compare A B");
  prepare_output(o.out);
  const fuzz::Fingerprint f = ask(o, o.engine);
  if (!o.out.empty()) write_file(o.out, stored_text(f));
  fmt::print("{}", o.json ? stored_text(f) : reports::fingerprint_text(f));
  const bool answered = std::ranges::any_of(f.groups, [](const auto& g) { return g.answered() > 0; });
  return answered ? exit_clean : exit_failed;
}

}  // namespace

Run declare_fingerprint(CLI::App& app) {
  auto o = std::make_shared<FingerprintOptions>();
  app.add_option("engine", o->engine, "a name, ./libmine.so or pipe:COMMAND");
  app.add_option(
         "--compare", o->compared,
         "two of them, each an engine or a fingerprint's file (NAME.json): which answers differ; exit code 1 "
         "if any does")
      ->expected(2);
  app.add_option("--cases", o->cases, "only the first of the fixed set of cases")
      ->check(CLI::Range(std::uint64_t{1}, fuzz::fingerprint_cases))
      ->capture_default_str();
  app.add_option(
      "--of-build", o->of_build,
      "the engine of another build of this program, in that build's directory: made by another compiler, "
      "with other flags, or for another machine");
  app.add_option(
         "--run-with", o->limits.run_with,
         "program and arguments that run the workers, such as `qemu-aarch64 -L /usr/aarch64-linux-gnu`; "
         "without a sandbox")
      ->delimiter(' ')
      ->allow_extra_args(false);
  add_jobs(app, o->jobs);
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  app.add_option("-o,--out", o->out,
                 "also write the fingerprint, or the first case whose answers differ, to this file");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
