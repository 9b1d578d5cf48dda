/* A plug-in whose card is no card. */
#include <math.h>
#include <stdlib.h>

#include "oracles/abi/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene;
};

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"bad-card\"";
}
static ts_engine* create(uint32_t i) {
  (void)i;
  return (ts_engine*)calloc(1, sizeof(ts_engine));
}
static void destroy(ts_engine* e) { free(e); }
static int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  (void)received, (void)detail;
  e->scene = scene;
  return TS_ANSWERED;
}
static void unload(ts_engine* e) { e->scene = NULL; }
static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* answer,
                const ts_sink* sink) {
  const ts_body *x = &e->scene->bodies[a], *y = &e->scene->bodies[b];
  const ts_shape *s = &e->scene->shapes[x->shape], *t = &e->scene->shapes[y->shape];
  double sq = 0;
  int i;
  (void)sink;
  if (question != TS_OVERLAP || s->kind != TS_SPHERE || t->kind != TS_SPHERE) return;
  for (i = 0; i < 3; ++i) sq += pow(x->pose.translation[i] - y->pose.translation[i], 2);
  answer->outcome = TS_ANSWERED;
  answer->has = TS_HAS_OVERLAP;
  answer->overlap = sqrt(sq) <= s->size[0] + t->size[0];
}

const ts_plugin* touchstone_plugin_v1(void) {
  static const ts_plugin plugin = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask};
  return &plugin;
}
