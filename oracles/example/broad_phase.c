/* A broad phase as a plug-in, in C: all pairs of the bodies' boxes tested. Replace `run` with your own.
 *   cc -O2 -shared -fPIC -I PREFIX/include broad_phase.c -o libmine.so */
#include <stdlib.h>
#include "oracles/abi/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene; /* valid until unload */
};

/* Touching counts as overlap. */
static int overlap(const ts_aabb* a, const ts_aabb* b) {
  for (int k = 0; k < 3; ++k)
    if (!(a->lower[k] <= b->upper[k] && b->lower[k] <= a->upper[k])) return 0;
  return 1;
}

static void run(const ts_scene* scene, const ts_sink* sink) {
  int32_t query = 0, n = (int32_t)scene->body_count;
  const ts_aabb** boxes = calloc(scene->body_count + 1, sizeof(ts_aabb*)); /* NULL: not present */
  for (size_t i = 0; i < scene->step_count; ++i) {
    const ts_step* step = &scene->steps[i];
    if (step->op != TS_QUERY) {
      boxes[step->body] = step->op == TS_REMOVE ? NULL : &scene->step_boxes[i];
      continue;
    }
    for (int32_t a = 0; a < n; ++a)
      for (int32_t b = a + 1; b < n; ++b)
        if (boxes[a] && boxes[b] && overlap(boxes[a], boxes[b])) sink->pair(sink->ctx, query, a, b);
    ++query;
  }
  free(boxes);
}

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"mine\",\"library\":\"mine\",\"version\":\"1\",\"settings\":\"all pairs of boxes\","
         "\"unit_roundoff\":1.1102230246251565e-16,\"tau_factor\":64,\"source\":\"arithmetic only\"}";
}
static ts_engine* create(uint32_t i) {
  (void)i;
  return calloc(1, sizeof(ts_engine));
}
static void destroy(ts_engine* e) { free(e); }
static int32_t load(ts_engine* e, const ts_scene* s, const ts_received* r, char* detail) {
  (void)r;
  (void)detail;
  e->scene = s;
  return TS_ANSWERED;
}
static void unload(ts_engine* e) { e->scene = NULL; }
static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* out, const ts_sink* sink) {
  (void)a;
  (void)b;
  if (question != TS_CANDIDATES) return; /* stays TS_UNSUPPORTED */
  run(e->scene, sink);
  out->outcome = TS_ANSWERED;
}

static const ts_plugin table = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask, NULL, {NULL}};
const ts_plugin* touchstone_plugin_v1(void) { return &table; }
