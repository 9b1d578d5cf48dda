#include "cli/logged_command.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "cli/installed.h"
#include "core/base/input_error.h"
#include "scenarios/text/printable.h"

namespace touchstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_reasons = 12;

}  // namespace

std::string shell_command(const Words& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

bool run_logged(const Words& words, const fs::path& log) {
  const std::string command = shell_command(words);
  std::ofstream(log, std::ios::app) << "$ " << command << "\n";
  const int status =
      std::system(fmt::format("{} >>{} 2>&1 </dev/null", command, shell_word(log.string())).c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Captured run_captured(const Words& words, const fs::path& log) {
  const std::string command = shell_command(words);
  std::ofstream(log, std::ios::app) << "$ " << command << "\n";
  std::FILE* const pipe =
      popen(fmt::format("{} 2>>{} </dev/null", command, shell_word(log.string())).c_str(), "r");
  if (!pipe) throw CommandFailed("cannot run " + command);
  Captured result;
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) result.out.append(buffer, n);
  result.succeeded = pclose(pipe) == 0;
  while (result.out.ends_with('\n')) result.out.pop_back();
  return result;
}

std::string output_of(const Words& words, const fs::path& log) {
  Captured result = run_captured(words, log);
  if (!result.succeeded)
    throw CommandFailed(fmt::format("{} failed:\n{}full log: {}", shell_command(words),
                                    reasons_in(log, "fatal: "), log.string()));
  return std::move(result.out);
}

std::string reasons_in(const fs::path& log, const std::string& mark) {
  std::ifstream in(log);
  std::vector<std::string> marked, errors, all;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(mark)) marked.push_back(line.substr(mark.size()));
    if (line.find("error") != std::string::npos || line.find("Error") != std::string::npos)
      errors.push_back(line);
    all.push_back(std::move(line));
  }
  std::string text;
  const auto first = [&](const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < std::min(lines.size(), most_reasons); ++i) text += lines[i] + "\n";
  };
  if (!marked.empty())
    first(marked);
  else if (!errors.empty())
    first(errors);
  else
    first({all.end() - static_cast<std::ptrdiff_t>(std::min(all.size(), most_reasons)), all.end()});
  return text;
}

void require_program(const std::string& name, const std::string& why) {
  if (!program_on_path(name).empty()) return;
  throw InputError(name, "is not installed; it is needed " + why);
}

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be created: " + error.message());
}

}  // namespace touchstone::cli
