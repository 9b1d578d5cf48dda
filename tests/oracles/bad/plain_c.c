/* A plug-in in C11: spheres, overlap only. Shows that the header is C. */
#include <math.h>

#include "tests/oracles/bad/plain_scene.h"

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"plain-c\",\"library\":\"C\",\"version\":\"11\",\"settings\":\"none\",\"unit_roundoff\":"
         "1.2e-16,"
         "\"tau_factor\":64,\"source\":\"\"}";
}

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
