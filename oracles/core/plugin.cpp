// libtouchstone_core.so: the core's engines for a worker process.
#include "oracles/abi/touchstone_engine.h"
#include "oracles/core/core_engine.h"

/// See oracles/abi/native_engine.h.
extern "C" TS_EXPORT touchstone::NativeEngine* touchstone_native_engine(const char* name) {
  return touchstone::make_native_core(name).release();
}
