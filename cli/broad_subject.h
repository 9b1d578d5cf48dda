// The subject of `certify`: a broad phase of the core or of an oracle, any engine in the catalogue, a
// plug-in, or a command behind a pipe.
#pragma once

#include "fuzz/certify/certify.h"
#include "oracles/client/remote_engine.h"

namespace touchstone::cli {

/// Multiplies the time allowed per question.
WorkerLimits scaled_limits(WorkerLimits limits, double times);

/// Throws InputError with place and reason when there is no such subject. `sweeps`: the user states that it
/// also answers swept_candidates, as the core does.
fuzz::Subject broad_subject(const std::string& name, const WorkerLimits& limits, bool sweeps);

}  // namespace touchstone::cli
