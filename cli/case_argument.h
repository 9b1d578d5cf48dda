// Arguments that name a case, and one finding that a case shows.
#pragma once

#include <map>
#include <string>

#include "cli/engine_catalog.h"
#include "reports/record/result.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/import/import_context.h"

namespace touchstone::cli {

/// A case or scene file, a file that is imported, the directory of a finding, or the name of a scenario or of
/// a case of the corpus. Throws InputError when it is none of them.
StoredCase case_argument(const std::string& text, const ImportOptions& import = {});

/// The directory of a recorded scene (scene.txt, frames.npy).
bool is_recording(const std::string& text);

// The argument of `shrink`, `bisect` and `reproduce`: a case and one finding that it shows.

struct FindingArgument {
  std::string path, engine, key;
};
void add_finding_argument(CLI::App& app, FindingArgument& to);

struct AskedFinding {
  StoredCase stored;
  std::string engine_name;
  EnginePtr engine;
  std::string key;  // empty: the engine is right, or not wrong in the requested way
  std::map<std::string, fuzz::Finding> findings;  // by key, with evidence
};
/// The key in finding.json beside the case; empty if there is none.
std::string stored_key(const std::string& path);

/// Queries the engine. Throws InputError if the case or engine does not exist, or several findings show and
/// no key is given.
AskedFinding ask_for_finding(FindingArgument o, const WorkerLimits& limits);

/// Reports an empty key on stderr. Returns the exit code.
int not_found(const AskedFinding& asked, const FindingArgument& o);

}  // namespace touchstone::cli
