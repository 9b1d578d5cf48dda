// What reports/web/src/case draws.
#pragma once

#include <string>

#include "cli/engine_catalog.h"
#include "reports/record/observation_json.h"
#include "scenarios/codec/case_codec.h"

namespace touchstone::cli {

/// The case, the answers of `engines` as `replay --json` has them, the faces of hulls, and of who is wrong
/// about a pair: the stages it passes through (as `bisect stage` finds them) and the program against its own
/// API (as `reproduce` writes it), if there is one that is not too long. `named`: what the user called the
/// case.
fuzz::Json case_page(const std::string& named, const StoredCase& stored, const std::string& engines,
                     const WorkerLimits& limits);

}  // namespace touchstone::cli
