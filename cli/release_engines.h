// The releases of one engine that a command compares: chosen, installed and started.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/npm_engines.h"
#include "oracles/abi/engine.h"
#include "oracles/client/worker_limits.h"

namespace touchstone::cli {

/// --only and --installed.
struct ReleaseChoice {
  std::string only;        // releases separated by commas; empty: those that npm has
  bool installed = false;  // npm is not asked: only releases that are there
};
void add_release_choice(CLI::App& app, ReleaseChoice& to);

/// Ascending. Throws InputError when there is none, a release does not exist, or npm cannot be asked.
std::vector<std::string> chosen_releases(const NpmRow& row, const ReleaseChoice& choice);

/// Engines of one package in several releases, installed and started on first use.
class ReleaseEngines {
 public:
  explicit ReleaseEngines(const WorkerLimits& limits) : limits_(limits) {}
  /// Null if it cannot be started, for the reason `why_not`. Throws InputError when npm cannot install it.
  const EnginePtr& of(const NpmEngine& engine);
  const std::string& why_not(const NpmEngine& engine) const { return why_not_.at(engine.name()); }

 private:
  WorkerLimits limits_;
  std::map<std::string, EnginePtr> engines_;
  std::map<std::string, std::string> why_not_;
};

/// The row of NAME, without a release. Throws InputError for any other name.
const NpmRow& npm_row_named(const std::string& name);

}  // namespace touchstone::cli
