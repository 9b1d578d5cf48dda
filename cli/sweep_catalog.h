// Engines of the catalogue with other tolerances. They are used by name, and by `chart`, which draws a method
// as a curve.
#pragma once

#include "cli/engine_catalog.h"

namespace touchstone::cli {

std::span<const EngineRow> sweep_catalog();

/// Engines whose overlap test `chart` runs at k samples of a motion (`name-steps@k`), beside those that
/// sweep.
std::span<const std::string_view> stepped_engines();
inline constexpr int step_counts[] = {1, 4, 16, 64, 256};

}  // namespace touchstone::cli
