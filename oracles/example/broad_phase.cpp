// A broad phase as a plug-in, in C++: a box around each body, all pairs. Put your own behind `run`.
//   c++ -std=c++17 -shared -fPIC -I PREFIX/include broad_phase.cpp -o libmine.so
#include <cmath>
#include <map>
#include "oracles/api/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene = nullptr;  // valid until unload
};

namespace {

constexpr double inf = INFINITY;
struct Box {
  double lo[3], hi[3];
};

// No point is further from the body's origin than this: |x| + |y| + |z| is never less than the length.
double reach(const ts_shape& s) {
  double r = 0;
  if (s.kind == TS_HALF_SPACE) return inf;
  for (double x : s.size) r += std::fabs(x);
  for (size_t i = 0; i < s.vertex_count; ++i) {
    const double* v = s.vertices + 3 * i;
    r = std::fmax(r, std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]));
  }
  return r * (1 + 0x1p-48);
}

// Rounded outward: one place too small, and a pair is lost.
Box box_of(const ts_scene& scene, const ts_step& step) {
  const double r = reach(scene.shapes[scene.bodies[step.body].shape]);
  Box b;
  for (int k = 0; k < 3; ++k) {
    b.lo[k] = std::nextafter(step.pose.translation[k] - r, -inf);
    b.hi[k] = std::nextafter(step.pose.translation[k] + r, inf);
  }
  return b;
}

bool overlap(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k)
    if (!(a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k])) return false;
  return true;  // touching is overlap
}

void run(const ts_scene& scene, const ts_sink& sink) {
  std::map<int, Box> present;
  int query = 0;
  for (size_t i = 0; i < scene.step_count; ++i) {
    const ts_step& step = scene.steps[i];
    if (step.op == TS_REMOVE) present.erase(step.body);
    if (step.op == TS_INSERT || step.op == TS_MOVE) present[step.body] = box_of(scene, step);
    if (step.op != TS_QUERY) continue;
    for (auto a = present.begin(); a != present.end(); ++a)
      for (auto b = std::next(a); b != present.end(); ++b)
        if (overlap(a->second, b->second)) sink.pair(sink.ctx, query, a->first, b->first);
    ++query;
  }
}

const ts_plugin table = {
    TS_ABI_VERSION,
    1,
    [](uint32_t) {
      return R"({"name":"mine","library":"mine","version":"1","settings":"all pairs of boxes",)"
             R"("unit_roundoff":1.1102230246251565e-16,"tau_factor":64,"source":"arithmetic only"})";
    },
    [](uint32_t) { return new ts_engine; },
    [](ts_engine* e) { delete e; },
    [](ts_engine* e, const ts_scene* s, const ts_received*, char*) -> int32_t {
      return e->scene = s, TS_ANSWERED;
    },
    [](ts_engine* e) { e->scene = nullptr; },
    [](ts_engine* e, int32_t question, int32_t, int32_t, ts_answer* out, const ts_sink* sink) {
      if (question != TS_CANDIDATES) return;  // stays TS_UNSUPPORTED
      run(*e->scene, *sink);
      out->outcome = TS_ANSWERED;
    }};

}  // namespace

extern "C" const ts_plugin* touchstone_plugin_v1(void) { return &table; }
