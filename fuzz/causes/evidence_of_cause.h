// What proves a cause: the certificate and the program of the case that is shown.
#pragma once

#include "fuzz/causes/causes.h"

namespace touchstone::fuzz {

/// Asks the engine about both cases of the representative and fills in shown, smallest, certificate and
/// program. Leaves out what the engine no longer shows.
void add_evidence(Cause& cause, const Representative& r, const CausesConfig& config, EnginePool& pool);

}  // namespace touchstone::fuzz
