// Other tolerances of engines of the catalog: asked by name, and by `chart`, which draws a method as a curve.
#pragma once

#include "fuzz/cli/engine_catalog.h"

namespace touchstone::cli {

std::span<const EngineRow> sweep_catalog();

}  // namespace touchstone::cli
