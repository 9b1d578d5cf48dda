/* What the plug-ins in plain C share: an engine that holds a scene, its life cycle, and the plug-in's table.
   The including file defines `card` and `ask`. */
#pragma once

#include <stdlib.h>

#include "oracles/abi/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene;
};

static const char* card(uint32_t i);
static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* answer, const ts_sink* sink);

static ts_engine* create(uint32_t i) {
  (void)i;
  return (ts_engine*)calloc(1, sizeof(ts_engine));
}

static void destroy(ts_engine* e) { free(e); }

static int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  (void)received;
  (void)detail;
  e->scene = scene;
  return TS_ANSWERED;
}

static void unload(ts_engine* e) { e->scene = NULL; }

const ts_plugin* touchstone_plugin_v1(void) {
  static const ts_plugin plugin = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask, NULL, {NULL}};
  return &plugin;
}
