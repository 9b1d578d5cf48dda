/* A plug-in of ABI version 1, built with the header of that version as it was last. What follows its table in
   memory is no function. */
#include <stdlib.h>
#include <string.h>

#include "tests/oracles/v1/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene;
};

static uint32_t host_minor;

static const char* card(uint32_t i) {
  (void)i;
  return host_minor >= 2 ? "{\"name\":\"version 1\",\"library\":\"test\",\"version\":\"1\",\"settings\":\"\","
                           "\"unit_roundoff\":1e-16,\"tau_factor\":64,\"source\":\"\","
                           "\"more_shapes\":[\"rounded_box\"]}"
                         : "{}";
}
static ts_engine* create(uint32_t i) {
  (void)i;
  return (ts_engine*)calloc(1, sizeof(ts_engine));
}
static void destroy(ts_engine* e) { free(e); }
static int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  const double size[4] = {2, 0, 0, 0};
  e->scene = scene;
  strcpy(detail, "");
  received->shape(received->ctx, 1, size, NULL, 0);
  return TS_ANSWERED;
}
static void unload(ts_engine* e) { e->scene = NULL; }
static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* answer, const ts_sink* sink) {
  (void)sink;
  if (question != TS_OVERLAP) return;
  answer->outcome = TS_ANSWERED;
  answer->has = TS_HAS_OVERLAP;
  answer->overlap = e->scene->bodies[a].shape != e->scene->bodies[b].shape;
  strcpy(answer->detail, "version 1");
}

const ts_plugin* touchstone_plugin_v1(void) {
  static struct {
    ts_plugin table;
    uintptr_t after[8];
  } memory = {{TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask}, {1, 1, 1, 1, 1, 1, 1, 1}};
  return &memory.table;
}

void touchstone_host_v1(uint32_t minor) { host_minor = minor; }
