/* A broad phase as a plug-in, in C: a box around each body, all pairs. Put your own behind `run`.
 *   cc -shared -fPIC -I PREFIX/include broad_phase.c -o libmine.so -lm */
#include <math.h>
#include <stdlib.h>
#include "oracles/api/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene; /* valid until unload */
};

typedef struct Box {
  double lo[3], hi[3];
  int present;
} Box;

/* No point is further from the body's origin than this: |x| + |y| + |z| is never less than the length. */
static double reach(const ts_shape* s) {
  double r = 0;
  if (s->kind == TS_HALF_SPACE) return INFINITY;
  for (int k = 0; k < 4; ++k) r += fabs(s->size[k]);
  for (size_t i = 0; i < s->vertex_count; ++i) {
    const double* v = s->vertices + 3 * i;
    r = fmax(r, fabs(v[0]) + fabs(v[1]) + fabs(v[2]));
  }
  return r * (1 + 0x1p-48);
}

/* Rounded outward: one place too small, and a pair is lost. */
static void place(const ts_scene* scene, const ts_step* step, Box* b) {
  const double r = reach(&scene->shapes[scene->bodies[step->body].shape]);
  for (int k = 0; k < 3; ++k) {
    b->lo[k] = nextafter(step->pose.translation[k] - r, -INFINITY);
    b->hi[k] = nextafter(step->pose.translation[k] + r, INFINITY);
  }
  b->present = 1;
}

static int overlap(const Box* a, const Box* b) {
  if (!a->present || !b->present) return 0;
  for (int k = 0; k < 3; ++k)
    if (!(a->lo[k] <= b->hi[k] && b->lo[k] <= a->hi[k])) return 0;
  return 1; /* touching is overlap */
}

static void run(const ts_scene* scene, const ts_sink* sink) {
  Box* boxes = calloc(scene->body_count + 1, sizeof(Box));
  int32_t query = 0, n = (int32_t)scene->body_count;
  for (size_t i = 0; i < scene->step_count; ++i) {
    const ts_step* step = &scene->steps[i];
    if (step->op == TS_REMOVE) boxes[step->body].present = 0;
    if (step->op == TS_INSERT || step->op == TS_MOVE) place(scene, step, &boxes[step->body]);
    if (step->op != TS_QUERY) continue;
    for (int32_t a = 0; a < n; ++a)
      for (int32_t b = a + 1; b < n; ++b)
        if (overlap(&boxes[a], &boxes[b])) sink->pair(sink->ctx, query, a, b);
    ++query;
  }
  free(boxes);
}

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"mine\",\"library\":\"mine\",\"version\":\"1\",\"settings\":\"all pairs of boxes\","
         "\"unit_roundoff\":1.1102230246251565e-16,\"tau_factor\":64,\"source\":\"arithmetic only\"}";
}
static ts_engine* create(uint32_t i) { return (void)i, calloc(1, sizeof(ts_engine)); }
static void destroy(ts_engine* e) { free(e); }
static int32_t load(ts_engine* e, const ts_scene* s, const ts_received* r, char* detail) {
  return (void)r, (void)detail, e->scene = s, TS_ANSWERED;
}
static void unload(ts_engine* e) { e->scene = NULL; }
static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* out, const ts_sink* sink) {
  (void)a, (void)b;
  if (question != TS_CANDIDATES) return; /* stays TS_UNSUPPORTED */
  run(e->scene, sink);
  out->outcome = TS_ANSWERED;
}

static const ts_plugin table = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask};
const ts_plugin* touchstone_plugin_v1(void) { return &table; }
