// Compiled into every library of engines of this checkout (ts_add_plugin).
#include "oracles/abi/source_id.h"
#include "oracles/abi/touchstone_engine.h"

extern "C" TS_EXPORT const char* touchstone_source_id_v1() { return touchstone::source_id(); }
