// Optional engines from npm, with JavaScript adapters (oracles/npm) over the pipe protocol. Their packages
// are installed in a folder beside the program, only on request; several releases of one can be there at
// once.
#pragma once

#include <filesystem>
#include <optional>
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
  bool is_broad_phase = false;
};
std::span<const NpmRow> npm_catalog();

/// An engine in one release of its package: `jolt` in the one that the adapter was written against, or
/// `jolt@0.29.0`. An adapter finds out what another release cannot be asked (oracles/npm/release.mjs).
struct NpmEngine {
  const NpmRow* row = nullptr;
  std::string release;  // empty: row->version
  std::string name() const { return std::string(row->name) + (release.empty() ? "" : "@" + release); }
  std::string version() const { return release.empty() ? std::string(row->version) : release; }
};
/// True for the name of an engine or library of npm_catalog(), with or without a release, whole or begun:
/// `physx`, `jolt@0.29`.
bool is_of_npm(const std::string& name);
/// Empty for a name that is neither a row's nor a row's with an exact release.
std::optional<NpmEngine> find_npm_engine(const std::string& name);
/// Those named NAME@RELEASE that are installed, by row and ascending release.
std::vector<NpmEngine> installed_releases();

/// $TOUCHSTONE_NPM, or `npm` beside the program's own folder.
std::filesystem::path npm_folder();
bool is_installed(const NpmEngine& engine);

/// The command that runs it: "pipe:node SCRIPT FOLDER".
std::string pipe_of(const NpmEngine& engine);
/// The files that make up the engine, for the hash of a certificate: the scripts of its folder, the kit and
/// its package's files.
std::vector<std::filesystem::path> files_of(const NpmEngine& engine);

/// Installs these engines' packages in the folder unless they are there. A failure of npm is described on
/// stderr. Returns the exit code. Throws InputError when node or npm is missing.
int fetch_npm_engines(const std::vector<NpmEngine>& engines);

/// `engines --install`: names as above, or with the beginning of a release (`jolt@0.29`: the newest that
/// begins so). A library stands for all of its engines. Reports what it does. Throws InputError for an
/// unknown name, or when node or npm is missing.
int install_npm_engines(const std::vector<std::string>& names);

}  // namespace touchstone::cli
