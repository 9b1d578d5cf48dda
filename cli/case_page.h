// The data that reports/web/src/case draws.
#pragma once

#include <string>

#include "cli/engine_catalog.h"
#include "reports/record/observation_json.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::cli {

/// The case, the answers of `engines` as in `replay --json`, and the faces of hulls. For each engine that is
/// wrong about a pair also its stages (as found by `bisect stage`) and the program against its own API (as
/// written by `reproduce`), unless that is too long. `named` is the user's name for the case.
fuzz::Json case_page(const std::string& named, const StoredCase& stored, const std::string& engines,
                     const WorkerLimits& limits);

}  // namespace touchstone::cli
