// `bisect release`: the first release on npm that shows a finding.
#pragma once

#include "cli/command.h"

namespace touchstone::cli {

/// Declares its options; the result runs it.
Run declare_bisect_release(CLI::App& app);

}  // namespace touchstone::cli
