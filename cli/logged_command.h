// Commands that the program runs for the user (cmake, git), with their output in a log.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace touchstone::cli {

/// A program that the user asked to be run has failed. The command line reports it with exit code 3.
struct CommandFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Words = std::vector<std::string>;

/// The words as one command of the shell, quoted where necessary.
std::string shell_command(const Words& words);

/// Appends the command and its output to the log. Returns true if it succeeded.
bool run_logged(const Words& words, const std::filesystem::path& log);

struct Captured {
  bool succeeded = false;
  std::string out;  // standard output, without the last newlines
};
/// Appends the command and its errors to the log.
Captured run_captured(const Words& words, const std::filesystem::path& log);

/// The same; throws CommandFailed with the log's name when the command does not succeed.
std::string output_of(const Words& words, const std::filesystem::path& log);

/// The lines of a log that say why: those that start with `mark`, else those with "error", else the last
/// ones.
std::string reasons_in(const std::filesystem::path& log, const std::string& mark);

/// Throws InputError unless the program is found; `why` says what it is needed for.
void require_program(const std::string& name, const std::string& why);

/// Creates the folder and those above it. Throws InputError with the system's reason.
void create_folder(const std::filesystem::path& folder);

}  // namespace touchstone::cli
