// Programs started through the shell: quoting, and what to show of a log.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace touchstone::cli {

/// The path as one word of a shell command.
std::string shell_word(const std::filesystem::path& path);
/// At most the last `most` lines of a file, each with its line break; empty if it cannot be read.
std::string end_of_log(const std::filesystem::path& file, std::size_t most);
/// Whether the shell finds a program of this name.
bool has_program(const char* name);

}  // namespace touchstone::cli
