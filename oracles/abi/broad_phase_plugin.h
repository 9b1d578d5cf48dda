// A broad phase as a plug-in, from a class in C++17 that takes boxes. Needs touchstone_engine.h and nothing
// else.
//
//   struct Mine {
//     void insert(int body, const ts_aabb& box);
//     void move(int body, const ts_aabb& box);   // of a body that was inserted
//     void remove(int body);
//     template <class Report> void query(Report report);   // calls report(a, b) for each pair of boxes that
//     overlap
//   };
//   TS_BROAD_PHASE(Mine, R"({"name": "mine", ...})")      // the card: ts_plugin in touchstone_engine.h
//
// Each script runs on a new Mine. A box may be infinite, and is none (upper < lower, or NaN) if the body's
// numbers are none: such a body need not be paired with others, but must not make others lose pairs. Touching
// counts as overlap. A pair may be reported in either order and more than once; pairs that a user would
// filter (of static bodies, of one group, ignored ones) are dropped here. An exception is
// recorded as the answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <set>
#include <utility>

#include "oracles/abi/touchstone_engine.h"

namespace touchstone::broad_phase_plugin {

/// The scene that an engine holds between load and unload.
struct Held {
  const ts_scene* scene = nullptr;
  std::set<std::pair<std::int32_t, std::int32_t>> ignored;

  bool is_filtered(std::int32_t a, std::int32_t b) const {
    const ts_body &x = scene->bodies[a], &y = scene->bodies[b];
    if (x.is_static && y.is_static) return true;
    if (x.group >= 0 && x.group == y.group) return true;
    return ignored.count({std::min(a, b), std::max(a, b)}) > 0;
  }
};

inline Held& held(ts_engine* e) { return *reinterpret_cast<Held*>(e); }

inline ts_engine* create(std::uint32_t) { return reinterpret_cast<ts_engine*>(new Held); }
inline void destroy(ts_engine* e) { delete &held(e); }
inline std::int32_t load(ts_engine* e, const ts_scene* scene, const ts_received*, char*) {
  held(e).scene = scene;
  for (std::size_t i = 0; i < scene->ignored_count; ++i)
    held(e).ignored.insert({scene->ignored[2 * i], scene->ignored[2 * i + 1]});
  return TS_ANSWERED;
}
inline void unload(ts_engine* e) { held(e) = {}; }

/// Contains every point within `by` of the box, if it is one.
inline ts_aabb widened(ts_aabb box, double by) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    if (!(box.lower[k] <= box.upper[k])) return box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::nextafter(box.lower[k] - by, -infinity);
    box.upper[k] = std::nextafter(box.upper[k] + by, infinity);
  }
  return box;
}

/// `margin`: pairs of boxes that are no farther apart are to be reported, so each is widened by half of it.
template <class Mine>
void run(const Held& h, double margin, const ts_sink& sink) {
  Mine mine;
  std::int32_t queries = 0;
  for (std::size_t i = 0; i < h.scene->step_count; ++i) {
    const ts_step& step = h.scene->steps[i];
    const ts_aabb& own = h.scene->step_boxes[i];
    const ts_aabb box = margin > 0 ? widened(own, margin / 2) : own;
    if (step.op == TS_INSERT) mine.insert(step.body, box);
    if (step.op == TS_MOVE) mine.move(step.body, box);
    if (step.op == TS_REMOVE) mine.remove(step.body);
    if (step.op != TS_QUERY) continue;
    mine.query([&](std::int32_t a, std::int32_t b) {
      if (!h.is_filtered(a, b)) sink.pair(sink.ctx, queries, a, b);
    });
    ++queries;
  }
}

template <class Mine>
void ask(ts_engine* e, std::int32_t question, std::int32_t, std::int32_t, ts_answer* out,
         const ts_sink* sink) {
  if (question != TS_CANDIDATES && question != TS_CANDIDATES_WITHIN) return;  // stays TS_UNSUPPORTED
  try {
    run<Mine>(held(e), question == TS_CANDIDATES_WITHIN ? held(e).scene->margin : 0, *sink);
    out->outcome = TS_ANSWERED;
  } catch (const std::exception& why) {
    out->outcome = TS_THREW;
    std::snprintf(out->detail, sizeof out->detail, "%s", why.what());
  }
}

}  // namespace touchstone::broad_phase_plugin

#define TS_BROAD_PHASE(Mine, the_card)                                             \
  extern "C" const ts_plugin* touchstone_plugin_v1(void) {                         \
    namespace kit = touchstone::broad_phase_plugin;                                \
    static const ts_plugin table{TS_ABI_VERSION,                                   \
                                 1,                                                \
                                 [](uint32_t) -> const char* { return the_card; }, \
                                 kit::create,                                      \
                                 kit::destroy,                                     \
                                 kit::load,                                        \
                                 kit::unload,                                      \
                                 kit::ask<Mine>,                                   \
                                 nullptr,                                          \
                                 {}};                                              \
    return &table;                                                                 \
  }
