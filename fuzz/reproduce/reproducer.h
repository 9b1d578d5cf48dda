// A finding as one C++ file against the engine's own API, which needs nothing of this project: for the
// engine's developers, and for whoever doubts that the adapter asked correctly. The program prints what the
// engine says and what is certain, and exits with 1 while the answer is wrong.
#pragma once

#include <string>
#include <string_view>

#include "reports/record/result.h"

namespace touchstone::fuzz {

/// FCL, Bullet and libccd have writers; any other engine has none.
bool has_reproducer(std::string_view engine);

/// The program. `finding` must carry its evidence (as findings_of returns it); `card` is the engine's.
/// Throws InputError naming the reason: an engine without a writer, or a shape that its API does not have.
std::string reproducer(const Finding& finding, const EngineCard& card);

}  // namespace touchstone::fuzz
