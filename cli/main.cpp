#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command.h"
#include "core/base/input_error.h"
#include "oracles/client/worker_limits.h"
#include "reports/text/text.h"
#include "scenarios/text/name_list.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

// Wraps descriptions at 80 columns, which CLI11 does not do.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    constexpr std::size_t columns = 80;
    return reports::wrapped(CLI::Formatter::make_option_desc(option), columns - get_column_width(), 0);
  }
};

// CLI11 itself would only report that a subcommand is missing.
void refuse_unknown_command(const std::string& word) {
  if (word.empty() || word[0] == '-') return;
  std::vector<std::string> known;
  for (const Command& c : commands) known.emplace_back(c.name);
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  const std::string near = did_you_mean(word, known);
  throw InputError(word, "unknown command" + (near.empty() ? "; --help lists the commands" : near));
}

int run(int argc, char** argv) {
  if (argc > 1) refuse_unknown_command(argv[1]);
  CLI::App app{"Touchstone: finds which collision engine is wrong, with a certificate"};
  app.name(program_name());
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", "touchstone " TOUCHSTONE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 clean, 1 subject found wrong, 2 bad usage or input,\n"
      "3 run failed or proved nothing, 125 cannot tell (bisect commit).");
  std::vector<std::pair<CLI::App*, Run>> runs;
  std::string_view group;
  for (const Command& c : commands) {
    if (!c.group.empty()) group = c.group;
    CLI::App* sub = app.add_subcommand(std::string(c.name), std::string(c.line));
    sub->group(std::string(group));
    runs.emplace_back(sub, c.declare(*sub));
  }
  if (argc == 1) {
    fmt::print(stderr, "{}", app.help());
    return exit_usage;
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

}  // namespace touchstone::cli

int main(int argc, char** argv) {
  using namespace touchstone;
  std::signal(SIGPIPE, SIG_IGN);
  // Printed commands name the launcher if it started this program.
  const char* launcher = std::getenv("TOUCHSTONE_LAUNCHER");
  cli::set_program_name(launcher ? launcher : argc > 0 ? argv[0] : "touchstone");
  try {
    const int code = cli::run(argc, argv);
    // Output that could not be written is a failure. EPIPE is not: the reader closed the pipe deliberately.
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
    // `| head` closes the pipe early; that is not worth a message.
    if (e.code() != std::errc::broken_pipe)
      fmt::print(stderr, "touchstone: failed: {}\n", printable(e.what(), "\n"));
    return cli::exit_failed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "touchstone: failed: {}\n", printable(e.what(), "\n"));
    return cli::exit_failed;
  }
}
