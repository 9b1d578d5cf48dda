// --error VALUE: judges engines by the user's own tolerance instead of the claims in their documentation.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"

namespace touchstone::cli {

/// Parses a length > 0: "0.1mm", "2e-3 m", "1e-4". With a unit, the scene is taken to be in metres; without
/// one, the length is in the scene's unit. Throws InputError.
double length_from_text(const std::string& text);

/// Declares the option.
void add_error(CLI::App& app, std::string& error);

/// Returns the engine itself if `error` is empty. Otherwise every answer claims `error` as its tolerance,
/// except candidates, which are judged without tolerance.
EnginePtr judged_by(EnginePtr engine, const std::string& error);
std::vector<EnginePtr> judged_by(std::vector<EnginePtr> engines, const std::string& error);

}  // namespace touchstone::cli
