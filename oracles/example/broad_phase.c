/* A broad phase as a plug-in, in C: a cube around each body, all pairs tested. Replace `run` with your own.
 *   cc -shared -fPIC -I PREFIX/include broad_phase.c -o libmine.so -lm */
#include <math.h>
#include <stdlib.h>
#include "oracles/abi/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene; /* valid until unload */
};

/* Covers the roundings of the sums in reach, relative to them. */
static const double rounding_factor = 1 + 0x1p-48;

/* An upper bound on the distance of a point from the body's origin: |x| + |y| + |z| is at least the length. */
static double reach(const ts_shape* s) {
  double r = 0;
  if (s->kind == TS_HALF_SPACE) return INFINITY;
  for (int k = 0; k < 4; ++k) r += fabs(s->size[k]);
  for (const double* v = s->vertices; v != s->vertices + 3 * s->vertex_count; v += 3)
    r = fmax(r, fabs(v[0]) + fabs(v[1]) + fabs(v[2]));
  return r * rounding_factor;
}

typedef struct Cube {
  const double* centre; /* NULL: not present */
  double half;
} Cube;

/* Touching counts as overlap. Each side is rounded once, which preserves their order: no pair is lost. */
static int overlap(const Cube* a, const Cube* b) {
  for (int k = 0; k < 3; ++k)
    if (!(fabs(a->centre[k] - b->centre[k]) <= a->half + b->half)) return 0;
  return 1;
}

static void run(const ts_scene* scene, const ts_sink* sink) {
  int32_t query = 0, n = (int32_t)scene->body_count;
  Cube* cubes = calloc(scene->body_count + 1, sizeof(Cube));
  for (const ts_step* step = scene->steps; step != scene->steps + scene->step_count; ++step) {
    if (step->op != TS_QUERY) {
      Cube* c = &cubes[step->body];
      c->centre = step->op == TS_REMOVE ? NULL : step->pose.translation;
      c->half = reach(&scene->shapes[scene->bodies[step->body].shape]);
      continue;
    }
    for (int32_t a = 0; a < n; ++a)
      for (int32_t b = a + 1; b < n; ++b)
        if (cubes[a].centre && cubes[b].centre && overlap(&cubes[a], &cubes[b])) sink->pair(sink->ctx, query, a, b);
    ++query;
  }
  free(cubes);
}

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"mine\",\"library\":\"mine\",\"version\":\"1\",\"settings\":\"all pairs of cubes\","
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

static const ts_plugin table = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask};
const ts_plugin* touchstone_plugin_v1(void) { return &table; }
