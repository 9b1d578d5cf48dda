/* The smallest useful engine: spheres against spheres, in plain C. Copy it, rename it, and call your own
 * detector from `ask`. Anything that it does not support is left unchanged, i.e. TS_UNSUPPORTED. Build:
 *   cc -O2 -shared -fPIC -I <touchstone> example_engine.c -o libmine.so -lm
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracles/abi/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene; /* valid until unload */
};

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"example\",\"library\":\"example\",\"version\":\"1\",\"settings\":\"spheres only\","
         "\"unit_roundoff\":1.1102230246251565e-16,\"tau_factor\":64,\"source\":\"arithmetic only\","
         "\"shapes\":[\"sphere\"]}";
}

static ts_engine* create(uint32_t i) {
  (void)i;
  return calloc(1, sizeof(ts_engine));
}

static void destroy(ts_engine* e) { free(e); }

static int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  (void)received; /* the scene is used without conversion, so there is nothing to report */
  (void)detail;
  e->scene = scene;
  return TS_ANSWERED;
}

static void unload(ts_engine* e) { e->scene = NULL; }

static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* out, const ts_sink* sink) {
  if (question > TS_CONTACT) return;
  const ts_body *pa = &e->scene->bodies[a], *pb = &e->scene->bodies[b];
  const ts_shape *sa = &e->scene->shapes[pa->shape], *sb = &e->scene->shapes[pb->shape];
  if (sa->kind != TS_SPHERE || sb->kind != TS_SPHERE) return;
  double n[3], length = 0;
  for (int i = 0; i < 3; ++i) n[i] = pb->pose.translation[i] - pa->pose.translation[i];
  length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int i = 0; i < 3; ++i)
    n[i] = length > 0 ? n[i] / length : (i == 2); /* concentric: all directions are equally good */
  const double gap = length - sa->size[0] - sb->size[0];
  out->outcome = TS_ANSWERED;
  out->has = TS_HAS_OVERLAP;
  out->overlap = gap <= 0; /* touching counts as overlap */
  if (question == TS_DISTANCE) {
    out->has |= TS_HAS_DISTANCE | TS_HAS_POINTS;
    out->distance = gap;
    for (int i = 0; i < 3; ++i) {
      out->point_a[i] = pa->pose.translation[i] + sa->size[0] * n[i];
      out->point_b[i] = pb->pose.translation[i] - sb->size[0] * n[i];
    }
  }
  if (question == TS_CONTACT && out->overlap) {
    double middle[3];
    out->has |= TS_HAS_NORMAL | TS_HAS_DEPTH;
    out->depth = -gap;
    memcpy(out->normal, n, sizeof n);
    for (int i = 0; i < 3; ++i) middle[i] = pa->pose.translation[i] + (sa->size[0] + gap / 2) * n[i];
    sink->point(sink->ctx, middle, -gap);
  }
}

const ts_plugin* touchstone_plugin_v1(void) {
  static const ts_plugin plugin = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask, NULL, {NULL}};
  return &plugin;
}
