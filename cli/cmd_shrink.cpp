// touchstone shrink CASE: finds the smallest case that shows the same finding.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/output.h"
#include "fuzz/shrink/keeps_finding.h"
#include "reports/text/text.h"

namespace touchstone::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ShrinkOptions {
  FindingArgument finding;
  std::string out;
  std::size_t tries = 20000;
  bool json = false;
  WorkerLimits limits;
};

std::string describe(const CaseSize& m) {
  return fmt::format("{}, {}, {}", reports::counted(m.bodies, "body", "bodies"),
                     reports::counted(m.steps, "step", "steps"), reports::counted(m.bits, "bit", "bits"));
}

Json to_json(const CaseSize& m) { return {{"bodies", m.bodies}, {"steps", m.steps}, {"bits", m.bits}}; }

void print(const ShrinkOptions& o, const std::string& key, const fuzz::Shrunk& r, const StoredCase& result) {
  if (o.json) {
    const Json j = {{"key", key},
                    {"exit", to_string(r.exit)},
                    {"tried", r.tried},
                    {"before", to_json(r.before)},
                    {"after", to_json(r.after)},
                    {"case", stored_case_to_json(result)}};
    fmt::print("{}\n", j.dump(1));
    return;
  }
  fmt::print(stderr, "{}\nbefore: {}\nafter:  {} ({}, {} cases tried)\n", key, describe(r.before),
             describe(r.after), to_string(r.exit), r.tried);
  if (o.out.empty())
    fmt::print("{}", to_text(result));
  else
    fmt::print("{}\n", o.out);
}

int run(const ShrinkOptions& o) {
  require_writable(o.out);
  const AskedFinding asked = ask_for_finding(o.finding, o.limits);
  const auto& [stored, engine_name, engine, key, findings] = asked;
  if (key.empty()) return not_found(asked, o.finding);
  const auto shrunk = fuzz::shrink(stored.c, fuzz::keeps_finding(engine, key), o.tries);
  StoredCase result;
  result.c = shrunk.smallest;
  result.description = "shows " + key;
  result.source = "shrunk from " + (stored.source.empty() ? stored.c.id : stored.source);
  if (!o.out.empty()) save_case(result, o.out);
  print(o, key, shrunk, result);
  if (shrunk.exit == fuzz::ShrinkExit::not_shown) {
    fmt::print(stderr, "the finding showed once but not again: the engine's answers are not reproducible\n");
    return exit_failed;
  }
  return exit_clean;
}

}  // namespace

Run declare_shrink(CLI::App& app) {
  auto o = std::make_shared<ShrinkOptions>();
  add_finding_argument(app, o->finding);
  app.add_option("-o,--out", o->out, "file for the shrunk case (default: stdout)");
  app.add_option("--tries", o->tries, "maximum number of cases to try")
      ->check(a_count())
      ->capture_default_str();
  add_case_seconds(app, o->limits);
  app.add_flag("--json", o->json, "one JSON document on stdout");
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
