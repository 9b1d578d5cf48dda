// Optional engines from npm, with JavaScript adapters (oracles/npm) over the pipe protocol. Their packages
// are installed in a folder beside the program, only on request.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::cli {

struct NpmRow {
  std::string_view name;
  std::string_view package, version;
  std::string_view script;    // in share/touchstone/engines
  std::string_view argument;  // passed to the script after the packages' folder
  std::string_view line;      // description
};
std::span<const NpmRow> npm_catalog();
const NpmRow* find_npm_row(const std::string& name);

/// $TOUCHSTONE_NPM, or `npm` beside the program's own folder.
std::filesystem::path npm_folder();
bool is_installed(const NpmRow& row);

/// The command that runs it: "pipe:node SCRIPT FOLDER".
std::string pipe_of(const NpmRow& row);
/// The files that make up the engine, for the hash of a certificate: the scripts of its folder, the kit and
/// its package's files.
std::vector<std::filesystem::path> files_of(const NpmRow& row);

/// Installs the packages of these engines in the folder unless they are there, and reports what it does. A
/// library stands for all of its engines.
/// Throws InputError for an unknown name, or when node or npm is missing.
int install_npm_engines(const std::vector<std::string>& names);

}  // namespace touchstone::cli
