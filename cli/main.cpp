#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command.h"
#include "core/base/input_error.h"
#include "oracles/client/worker_limits.h"
#include "scenarios/text/did_you_mean.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

constexpr Command table[] = {
    {"fuzz", "random differential campaign: every engine, every answer refereed", declare_fuzz},
    {"replay", "every engine's answer to stored cases, beside the referee's", declare_replay},
    {"shrink", "the smallest case that shows the same finding", declare_shrink},
    {"reproduce", "a finding as one C++ file against the engine's own API", declare_reproduce},
    {"bisect", "what a finding depends on: bodies, step, stage, a value, a commit", declare_bisect},
    {"triage", "the findings of a campaign against the ledger of known ones: new, known, gone",
     declare_triage},
    {"plan", "the least model that a scene needs, with the evidence", declare_plan},
    {"merge", "shards of a campaign into one, or ledgers into one", declare_merge},
    {"report", "the run and the findings of a campaign by key: text, and a page", declare_report},
    {"view", "a page of one case: bodies, answers, certificate; or of its broad phase", declare_view},
    {"certify", "is a broad phase conservative? a certificate, or the smallest script that loses a pair",
     declare_certify},
    {"check", "is a stored certificate a proof? in exact arithmetic, from the scene alone", declare_check},
    {"chart", "speed against accuracy: every engine and method, by family", declare_chart},
    {"stability", "ladders: the rung of a degeneracy at which each engine begins to fail", declare_stability},
    {"primitives", "the core's times of impact of deforming primitives, against the exact ones",
     declare_primitives},
    {"engines", "the engines present, their versions, settings and tolerances", declare_engines},
    {"families", "the families of random cases, a line each", declare_families},
    {"scenarios", "the hand-built scenarios: list them, or write one as a case file", declare_scenarios},
};

// CLI11 only says that a subcommand is missing.
void refuse_unknown_command(const std::string& word) {
  if (word.empty() || word[0] == '-') return;
  std::vector<std::string> known;
  for (const Command& c : commands()) known.emplace_back(c.name);
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  const std::string near = did_you_mean(word, known);
  throw InputError(word, "unknown command" + (near.empty() ? "; --help lists them" : near));
}

int run(int argc, char** argv) {
  if (argc > 1) refuse_unknown_command(argv[1]);
  CLI::App app{"Touchstone: says which collision engine is wrong, with a certificate"};
  app.set_version_flag("--version", "touchstone " TOUCHSTONE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 clean, 1 subject found wrong, 2 bad usage or input, 3 run failed or proved nothing,\n"
      "125 cannot tell (bisect commit).");
  std::vector<std::pair<CLI::App*, Run>> runs;
  for (const Command& c : commands()) {
    CLI::App* sub = app.add_subcommand(std::string(c.name), std::string(c.line));
    runs.emplace_back(sub, c.declare(*sub));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? exit_clean : exit_usage;
  }
  for (const auto& [sub, f] : runs)
    if (sub->parsed()) return f();
  return exit_usage;
}

}  // namespace

std::span<const Command> commands() { return table; }

}  // namespace touchstone::cli

int main(int argc, char** argv) {
  using namespace touchstone;
  std::signal(SIGPIPE, SIG_IGN);
  // The launcher's own name stands for the program that it runs.
  const char* launcher = std::getenv("TOUCHSTONE_LAUNCHER");
  cli::set_program_name(launcher ? launcher : argc > 0 ? argv[0] : "touchstone");
  try {
    const int code = cli::run(argc, argv);
    // A result that nobody got is no result. A reader that has seen enough (EPIPE) has what it wanted.
    if ((std::fflush(stdout) != 0 || std::ferror(stdout)) && errno != EPIPE)
      throw std::runtime_error(std::string("the output cannot be written: ") + std::strerror(errno));
    return code;
  } catch (const Stopped&) {
    fmt::print(stderr, "touchstone: interrupted\n");
    return cli::exit_failed;
  } catch (const InputError& e) {
    fmt::print(stderr, "touchstone: {}\n", printable(e.what(), "\n"));
    return cli::exit_usage;
  } catch (const std::system_error& e) {
    // Of `| head` nobody needs to be told.
    if (e.code() != std::errc::broken_pipe)
      fmt::print(stderr, "touchstone: failed: {}\n", printable(e.what(), "\n"));
    return cli::exit_failed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "touchstone: failed: {}\n", printable(e.what(), "\n"));
    return cli::exit_failed;
  }
}
