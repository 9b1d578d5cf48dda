// The program's commands and options as data, read from the parser that declares them, and what is generated
// from it: shell completion, the manual page, the reference in docs/commands.md.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::cli {

struct OptionNode {
  std::vector<std::string> names;  // "-o", "--out"; empty for a positional
  std::string positional;          // its name
  std::string description, value;  // what stands for its value, with the default; empty: a flag
  bool is_positional() const { return names.empty(); }
};

struct CommandNode {
  std::string name, description, group, footer;
  std::vector<OptionNode> options;
  std::vector<CommandNode> commands;
};

/// Without what depends on the machine: paths are relative to the sources, and --jobs has no default.
CommandNode command_tree(const CLI::App& app);

/// `shell` is bash, zsh or fish. Throws InputError for another one.
std::string completion(const CommandNode& root, std::string_view shell);
/// In roff, for man(1).
std::string manual_page(const CommandNode& root, std::string_view version);
/// docs/commands.md.
std::string command_reference(const CommandNode& root);

}  // namespace touchstone::cli
