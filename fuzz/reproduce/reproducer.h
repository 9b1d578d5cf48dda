// Turns a finding into one file, C++ or (for engines from npm) JavaScript, that uses only the engine's own
// API and nothing of this project: for the engine's developers, and for anyone who doubts the adapter. The
// program prints the engine's answer and the certain result, and exits with 1 while the answer is wrong.
#pragma once

#include <string>
#include <string_view>

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// True for engines of FCL, Bullet, libccd, ODE and MuJoCo, and for physx-query, physx-gjk and havok.
bool has_reproducer(std::string_view engine);

/// Returns the program. `finding` must carry its evidence, as returned by findings_of; `card` is the
/// engine's. Throws InputError with the reason when the engine is not supported or its API lacks a shape.
std::string reproducer(const Finding& finding, const EngineCard& card);

}  // namespace touchstone::fuzz
