// Programs against an engine's own API (fuzz/reproduce), for the engines of this build and for the user's own
// builds of their libraries.
#pragma once

#include <string>

#include "reports/record/result.h"
#include "scenarios/value/engine_card.h"

namespace touchstone::cli {

/// `name` as on the engine's card.
bool has_program(const std::string& name);

/// As fuzz::reproducer. The line that compiles it names the prefix of the user's own build.
std::string engine_program(const fuzz::Finding& finding, const EngineCard& card);

}  // namespace touchstone::cli
