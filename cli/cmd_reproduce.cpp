// touchstone reproduce CASE: writes a finding as one C++ file against the engine's own API, or, for a command
// behind a pipe, as the lines that it gets.
#include <fmt/format.h>

#include "cli/case_argument.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/program_for.h"
#include "scenarios/codec/json_file.h"

namespace touchstone::cli {
namespace {

struct ReproduceOptions {
  FindingArgument finding;
  std::string out;
  WorkerLimits limits;
};

int run(const ReproduceOptions& o) {
  prepare_output(o.out);
  const AskedFinding asked = ask_for_finding(o.finding, o.limits);
  if (asked.key.empty()) return not_found(asked, o.finding);
  const std::string text = program_for(asked.findings.at(asked.key), asked.engine->card(), asked.engine_name);
  if (o.out.empty())
    fmt::print("{}", text);
  else
    write_file(o.out, text);
  return exit_clean;
}

}  // namespace

Run declare_reproduce(CLI::App& app) {
  auto o = std::make_shared<ReproduceOptions>();
  add_finding_argument(app, o->finding);
  app.add_option("-o,--out", o->out, "file for the program (default: stdout)");
  add_case_seconds(app, o->limits);
  return [o] { return run(*o); };
}

}  // namespace touchstone::cli
