// A subcommand: one row in commands() and one file cmd_<name>.cpp, which declares its options on the app it
// is given and returns the function that runs it. Exit codes: 0 clean, 1 the subject was found wrong, 2 bad
// usage or input, 3 the run failed or proved nothing.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace touchstone::cli {

using Run = std::function<int()>;

struct Command {
  std::string_view name, line;
  Run (*declare)(CLI::App& app);
};

std::span<const Command> commands();

/// The program's name as it was called, quoted for the shell: for printed commands. main() sets it.
void set_program_name(std::string name);
const std::string& program_name();
/// `text` as one word for the shell, quoted if necessary.
std::string shell_word(const std::string& text);

/// Option validators with readable messages (CLI11's own print the largest double in full).
CLI::Validator a_count();
CLI::Validator a_positive_number();

inline constexpr int exit_clean = 0, exit_wrong = 1, exit_usage = 2, exit_failed = 3;

Run declare_certify(CLI::App& app);
Run declare_chart(CLI::App& app);
Run declare_check(CLI::App& app);
Run declare_engines(CLI::App& app);
Run declare_families(CLI::App& app);
Run declare_scenarios(CLI::App& app);
Run declare_fuzz(CLI::App& app);
Run declare_judge(CLI::App& app);
Run declare_plan(CLI::App& app);
Run declare_primitives(CLI::App& app);
Run declare_replay(CLI::App& app);
Run declare_report(CLI::App& app);
Run declare_shrink(CLI::App& app);
Run declare_stability(CLI::App& app);
Run declare_reproduce(CLI::App& app);
Run declare_bisect(CLI::App& app);
Run declare_merge(CLI::App& app);
Run declare_triage(CLI::App& app);
Run declare_view(CLI::App& app);

}  // namespace touchstone::cli
