// Engines that npm brings, optional: adapters in JavaScript (oracles/npm/jolt, oracles/npm/rapier) over the
// pipe protocol. Their packages are put into a folder beside the program, by request alone.
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
  std::string_view argument;  // of the script, after the folder of the packages
  std::string_view line;      // for people
};
std::span<const NpmRow> npm_catalog();
const NpmRow* find_npm_row(const std::string& name);

/// $TOUCHSTONE_NPM, or `npm` beside the program's own folder.
std::filesystem::path npm_folder();
bool is_installed(const NpmRow& row);

/// What is run: "pipe:node SCRIPT FOLDER".
std::string pipe_of(const NpmRow& row);
/// What the engine is made of, for the hash of a certificate: its scripts and its package's programs.
std::vector<std::filesystem::path> files_of(const NpmRow& row);

/// Puts the packages of these engines into the folder, unless they are there; says what it does. Throws
/// InputError for a name that is unknown, and when node or npm is missing.
int install_npm_engines(const std::vector<std::string>& names);

}  // namespace touchstone::cli
