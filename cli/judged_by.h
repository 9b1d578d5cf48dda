// --error VALUE: engines judged by the user's own tolerance, in place of what their documentation claims.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"

namespace touchstone::cli {

/// "0.1mm", "2e-3 m", "1e-4": a length > 0. With a unit the scene's is the metre; without one it is the
/// scene's. Throws InputError.
double length_from_text(const std::string& text);

/// Declares the option.
void add_error(CLI::App& app, std::string& error);

/// The engine itself when `error` is empty. Else every answer but candidates, which are judged with no
/// tolerance at all, comes with `error` as its claim.
EnginePtr judged_by(EnginePtr engine, const std::string& error);
std::vector<EnginePtr> judged_by(std::vector<EnginePtr> engines, const std::string& error);

}  // namespace touchstone::cli
