/* A plug-in of another checkout: it says so before anything else. */
#include "oracles/abi/touchstone_engine.h"

const char* touchstone_source_id_v1(void);
const char* touchstone_source_id_v1(void) { return "0123456789abcdef"; }

const ts_plugin* touchstone_plugin_v1(void) {
  static const ts_plugin plugin = {TS_ABI_VERSION, 1, 0, 0, 0, 0, 0, 0, 0, {0}};
  return &plugin;
}
