// What `shrink` and `reproduce` take: a case and the finding in it that is meant.
#pragma once

#include <map>
#include <string>

#include "cli/engine_catalog.h"
#include "reports/record/result.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::cli {

struct FindingArgument {
  std::string path, engine, key;
};
void add_finding_argument(CLI::App& app, FindingArgument& to);

struct AskedFinding {
  StoredCase stored;
  std::string engine_name;
  EnginePtr engine;
  std::string key;  // empty: the engine is right, or not wrong in the way asked for
  std::map<std::string, fuzz::Finding> findings;  // by key, with evidence
};
/// Asks the engine. Throws InputError: no such case or engine, several findings and no key.
AskedFinding ask_for_finding(FindingArgument o, const WorkerLimits& limits);

/// For an empty key: says so on stderr; the exit code.
int not_found(const AskedFinding& asked, const FindingArgument& o);

}  // namespace touchstone::cli
