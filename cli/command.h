// A subcommand: one file cmd_<name>.cpp, and its declaration and row here. The file declares its options on
// the app it is given and returns the function that runs it. Exit codes: 0 clean, 1 the subject was found
// wrong, 2 bad usage or input, 3 the run failed or proved nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include "scenarios/text/printable.h"

namespace touchstone::cli {

using Run = std::function<int()>;

/// `group`: the heading above it in --help; empty: that of the command before it.
struct Command {
  std::string_view name, line;
  Run (*declare)(CLI::App& app);
  std::string_view group = {};
};

/// The program's name as it was called, quoted for the shell: for printed commands. main() sets it.
void set_program_name(std::string name);
const std::string& program_name();

/// How many jobs run side by side unless --jobs says otherwise; at least 1.
int processor_count();

/// --jobs, described as `what`. Sets `jobs` to its default, the number of processors.
void add_jobs(CLI::App& app, int& jobs, const std::string& what = "number of parallel jobs");

/// Option validators with readable messages (CLI11's own print the largest double in full).
CLI::Validator a_count();
CLI::Validator a_positive_number();

inline constexpr int exit_clean = 0, exit_wrong = 1, exit_usage = 2, exit_failed = 3;

Run declare_answer(CLI::App& app);
Run declare_causes(CLI::App& app);
Run declare_certify(CLI::App& app);
Run declare_cover(CLI::App& app);
Run declare_chart(CLI::App& app);
Run declare_check(CLI::App& app);
Run declare_completion(CLI::App& app);
Run declare_corpus(CLI::App& app);
Run declare_doctor(CLI::App& app);
Run declare_man(CLI::App& app);
Run declare_engines(CLI::App& app);
Run declare_families(CLI::App& app);
Run declare_fingerprint(CLI::App& app);
Run declare_scenarios(CLI::App& app);
Run declare_fuzz(CLI::App& app);
Run declare_import(CLI::App& app);
Run declare_judge(CLI::App& app);
Run declare_open(CLI::App& app);
Run declare_plan(CLI::App& app);
Run declare_primitives(CLI::App& app);
Run declare_replay(CLI::App& app);
Run declare_report(CLI::App& app);
Run declare_shrink(CLI::App& app);
Run declare_stability(CLI::App& app);
Run declare_reproduce(CLI::App& app);
Run declare_assess(CLI::App& app);
Run declare_bisect(CLI::App& app);
Run declare_merge(CLI::App& app);
Run declare_triage(CLI::App& app);
Run declare_versions(CLI::App& app);
Run declare_view(CLI::App& app);

/// In the order of --help.
inline constexpr auto commands = std::to_array<Command>({
    {"fuzz", "run a campaign of random, refereed cases", declare_fuzz, "Find what is wrong"},
    {"causes", "find the distinct causes behind a campaign's findings", declare_causes},
    {"answer", "tell what is true of two shapes, and judge answers", declare_answer},
    {"replay", "show every engine's answer to stored cases", declare_replay},
    {"check", "verify a stored certificate in exact arithmetic", declare_check},
    {"corpus", "score engines on a corpus of hard cases; make or check it", declare_corpus},
    {"certify", "test whether a broad phase ever loses a pair", declare_certify},
    {"primitives", "check the core on deforming primitives", declare_primitives},
    {"shrink", "find the smallest case that shows the same finding", declare_shrink,
     "From a finding to its fix"},
    {"bisect", "find what a finding depends on", declare_bisect},
    {"reproduce", "write a finding as a program against the engine", declare_reproduce},
    {"view", "write a page that shows a case or its broad phase", declare_view},
    {"report", "summarise a campaign as text and as a page", declare_report},
    {"open", "write a page that lists all results in a directory", declare_open},
    {"triage", "compare causes with the ledger of known ones", declare_triage,
     "Every night, on many machines"},
    {"judge", "judge a stored campaign again, without engines", declare_judge},
    {"merge", "merge the shards of a campaign, or ledgers", declare_merge},
    {"chart", "measure the speed and accuracy of every engine", declare_chart,
     "Choose an engine and its settings"},
    {"stability", "find where degeneracy makes each engine fail", declare_stability},
    {"plan", "choose the cheapest model a scene can be run with", declare_plan},
    {"versions", "find which releases of an engine have which causes", declare_versions,
     "Compare builds and releases"},
    {"fingerprint", "hash an engine's answers, to compare builds of it", declare_fingerprint},
    {"import", "read a robot, a world or a mesh as a scene", declare_import, "Your robot or world"},
    {"assess", "find which engine can be trusted on a robot", declare_assess},
    {"cover", "test whether convex pieces contain a mesh", declare_cover},
    {"engines", "list, install or build engines", declare_engines, "What there is"},
    {"families", "list the families of random cases", declare_families},
    {"scenarios", "list the hand-built scenarios, or write one", declare_scenarios},
    {"doctor", "say what is installed, what is missing and what for", declare_doctor},
    {"completion", "write a script that completes commands in a shell", declare_completion},
    {"man", "write the manual page", declare_man},
});

/// Set by SIGINT, SIGTERM and SIGHUP.
extern std::atomic<bool> interrupted;

/// Installs the handlers. SIGHUP stays ignored if it already is (nohup).
void catch_stop_signals();

}  // namespace touchstone::cli
