/* A broad phase that loses no pair but reads a block that it has freed. */
#include "tests/oracles/bad/plain_scene.h"

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"reads-freed\",\"library\":\"C\",\"version\":\"11\",\"settings\":\"none\",\"unit_"
         "roundoff\":"
         "1.2e-16,\"tau_factor\":64,\"source\":\"\"}";
}

/* volatile, because the compiler sees the free too. */
static void read_freed_block(size_t bytes) {
  volatile char* block = (volatile char*)malloc(bytes);
  char* gone = (char*)block;
  block[0] = 1;
  free(gone);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuse-after-free"
  (void)block[0];
#pragma GCC diagnostic pop
}

static void report_all(const ts_engine* e, const char* is_in, int32_t k, const ts_sink* sink) {
  int32_t a, b;
  for (a = 0; a < (int32_t)e->scene->body_count; ++a)
    for (b = a + 1; b < (int32_t)e->scene->body_count; ++b)
      if (is_in[a] && is_in[b]) sink->pair(sink->ctx, k, a, b);
}

static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* answer,
                const ts_sink* sink) {
  char* is_in = (char*)calloc(e->scene->body_count + 1, 1);
  int32_t k = 0;
  size_t i;
  (void)a;
  (void)b;
  if (question == TS_CANDIDATES) {
    answer->outcome = TS_ANSWERED;
    for (i = 0; i < e->scene->step_count; ++i) {
      const ts_step* s = &e->scene->steps[i];
      if (s->op == TS_QUERY)
        report_all(e, is_in, k++, sink);
      else if (s->op != TS_MOVE)
        is_in[s->body] = s->op == TS_INSERT;
    }
    if (k > 1) read_freed_block((size_t)k);
  }
  free(is_in);
}
