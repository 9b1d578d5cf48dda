#include "oracles/abi/touchstone_engine.h"

const ts_plugin* touchstone_plugin_v1(void) {
  static const ts_plugin plugin = {TS_ABI_VERSION + 41, 1, 0, 0, 0, 0, 0, 0, 0, {0}};
  return &plugin;
}
