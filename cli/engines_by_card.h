// Engines by the names that findings and causes give them: those on their cards. Only the command line
// decides what is run; in a file, a name is just a label.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"
#include "oracles/client/remote_engine.h"

namespace touchstone::cli {

/// Engines outside the catalogue, as the command line gives them, by the names on their cards.
using Foreign = std::map<std::string, std::string>;

/// Those among the given names. Throws InputError when two have the same name.
Foreign foreign_engines(const std::vector<std::string>& given, const WorkerLimits& limits);

/// Creates the engine of that name, judged by `error` as given to --error; null when it is not available.
EnginePtr make_by_card(const std::string& name, const Foreign& foreign, const WorkerLimits& limits,
                       const std::string& error);

/// Creates engines on first use. An engine that is not available is null.
class EnginesByCard {
 public:
  /// `error` as given to --error.
  EnginesByCard(const WorkerLimits& limits, const Foreign& foreign, std::string error)
      : limits_(limits), foreign_(foreign), error_(std::move(error)) {}
  const EnginePtr& named(const std::string& name);

 private:
  WorkerLimits limits_;
  const Foreign& foreign_;
  std::string error_;
  std::map<std::string, EnginePtr> made_;
};

}  // namespace touchstone::cli
