// Trajectories in MCAP recordings, which npm's reader reads.
#pragma once

#include "scenarios/import/import_context.h"

namespace touchstone::cli {

/// The options with the joint states of an MCAP file (scenarios/import/mcap.mjs) as the text of the
/// trajectory; unchanged if the trajectory is none. Node reads the file in a process of its own, within
/// limits of time and memory. Throws InputError with the file's fault, or with the command that installs what
/// is missing.
ImportOptions with_trajectory_text(ImportOptions options);

}  // namespace touchstone::cli
