/* A plug-in whose card is not valid JSON. The host refuses it, so it answers nothing. */
#include "tests/oracles/bad/plain_scene.h"

static const char* card(uint32_t i) {
  (void)i;
  return "{\"name\":\"bad-card\"";
}

static void ask(ts_engine* e, int32_t question, int32_t a, int32_t b, ts_answer* answer,
                const ts_sink* sink) {
  (void)e;
  (void)question;
  (void)a;
  (void)b;
  (void)answer;
  (void)sink;
}
