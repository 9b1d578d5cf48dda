// The subject of `certify`: a broad phase of the core, one of an oracle, any engine of the catalog, a
// plug-in, a command behind a pipe.
#pragma once

#include "fuzz/certify/certify.h"
#include "oracles/client/remote_engine.h"

namespace touchstone::cli {

/// With that many times the time for each question.
WorkerLimits limits_times(WorkerLimits limits, double times);

/// Throws InputError, place and reason, when there is no such subject. `sweeps`: the user says that it
/// answers swept_candidates too; the core does.
fuzz::Subject broad_subject(const std::string& name, const WorkerLimits& limits, bool sweeps);

}  // namespace touchstone::cli
