// A broad phase as a plug-in, in C++: a cube around each body, all pairs tested. Replace `run` with your own.
//   c++ -std=c++17 -shared -fPIC -I PREFIX/include broad_phase.cpp -o libmine.so
#include <cmath>
#include <map>
#include "oracles/abi/touchstone_engine.h"

struct ts_engine {
  const ts_scene* scene = nullptr;  // valid until unload
};

namespace {

// Covers the roundings of the sums in reach, relative to them.
constexpr double rounding_factor = 1 + 0x1p-48;

// An upper bound on the distance of any point from the body's origin: |x| + |y| + |z| is at least the length.
double reach(const ts_shape& s) {
  double r = 0;
  if (s.kind == TS_HALF_SPACE) return INFINITY;
  for (double x : s.size) r += std::fabs(x);
  for (const double* v = s.vertices; v != s.vertices + 3 * s.vertex_count; v += 3)
    r = std::fmax(r, std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]));
  return r * rounding_factor;
}

struct Cube {
  const double* centre;
  double half;
};

// Touching counts as overlap. Each side is rounded once, which preserves their order: no pair is lost.
bool overlap(const Cube& a, const Cube& b) {
  for (int k = 0; k < 3; ++k)
    if (!(std::fabs(a.centre[k] - b.centre[k]) <= a.half + b.half)) return false;
  return true;
}

void run(const ts_scene& scene, const ts_sink& sink) {
  std::map<int, Cube> present;
  int query = 0;
  for (const ts_step* step = scene.steps; step != scene.steps + scene.step_count; ++step) {
    if (step->op == TS_REMOVE) present.erase(step->body);
    if (step->op == TS_INSERT || step->op == TS_MOVE)
      present[step->body] = {step->pose.translation, reach(scene.shapes[scene.bodies[step->body].shape])};
    if (step->op != TS_QUERY) continue;
    for (auto a = present.begin(); a != present.end(); ++a)
      for (auto b = std::next(a); b != present.end(); ++b)
        if (overlap(a->second, b->second)) sink.pair(sink.ctx, query, a->first, b->first);
    ++query;
  }
}

const char* card(uint32_t) {
  return R"({"name":"mine","library":"mine","version":"1","settings":"all pairs of cubes",)"
         R"("unit_roundoff":1.1102230246251565e-16,"tau_factor":64,"source":"arithmetic only"})";
}
ts_engine* create(uint32_t) { return new ts_engine; }
void destroy(ts_engine* e) { delete e; }
int32_t load(ts_engine* e, const ts_scene* s, const ts_received*, char*) {
  e->scene = s;
  return TS_ANSWERED;
}
void unload(ts_engine* e) { e->scene = nullptr; }
void ask(ts_engine* e, int32_t question, int32_t, int32_t, ts_answer* out, const ts_sink* sink) {
  if (question != TS_CANDIDATES) return;  // stays TS_UNSUPPORTED
  run(*e->scene, *sink);
  out->outcome = TS_ANSWERED;
}
const ts_plugin table = {TS_ABI_VERSION, 1, card, create, destroy, load, unload, ask};

}  // namespace

extern "C" const ts_plugin* touchstone_plugin_v1(void) { return &table; }
