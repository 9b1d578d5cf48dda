// A plug-in of many engines that misbehave, each in one way: when the pair (0, 2) of a scene whose body 0
// lies at x = 666 is queried, or on the occasion that its name begins with. $TOUCHSTONE_ZOO_LOADING chooses
// what happens while the file itself is loaded.
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/zoo/zoo.h"

namespace touchstone::zoo {
namespace {

// Misbehaviour that may happen on any occasion.
const std::vector<std::pair<std::string, void (*)()>> incidents{
    {"aborts", [] { std::abort(); }}, {"throws", [] { throw std::runtime_error("not today"); }},
    {"exits", [] { _exit(9); }},      {"loops", loop_for_ever},
    {"sleeps", sleep_for_ever},       {"stops", [] { raise(SIGSTOP); }},
    {"eats_memory", eat_memory},      {"leaves_a_daemon", leave_daemon}};
const std::vector<std::string> occasions{"create", "load", "unload"};

struct Kind {
  std::string name;
  Act act = nullptr;
  std::string occasion;
  void (*incident)() = nullptr;
};

std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i < answer_count; ++i)
    kinds.push_back({answers[i].name, answers[i].act, "", nullptr});
  for (std::size_t i = 0; i < death_count; ++i) kinds.push_back({deaths[i].name, deaths[i].act, "", nullptr});
  for (std::size_t i = 0; i < reach_count; ++i)
    kinds.push_back({reaches[i].name, reaches[i].act, "", nullptr});
  for (const std::string& o : occasions)
    for (const auto& [name, f] : incidents) kinds.push_back({o + "_" + name, nullptr, o, f});
  for (const char* name : {"creates_nothing", "receives_strangers", "receives_negative_shapes",
                           "receives_nan", "receives_a_million_times", "load_outcome_99",
                           "load_outcome_threw", "load_detail_in_latin1", "scribbles_on_the_scene"})
    kinds.push_back({name, nullptr, "", nullptr});
  return kinds;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = all_kinds();
  return all;
}

struct Beast {
  const Kind* kind;
  const ts_scene* scene = nullptr;
  bool is(const char* name) const { return kind->name == name; }
  bool triggered() const { return scene->body_count > 0 && scene->bodies[0].pose.translation[0] == 666; }
  void on(const char* occasion) const {
    if (kind->incident && kind->occasion == occasion) kind->incident();
  }
};

Beast& self(ts_engine* e) { return *reinterpret_cast<Beast*>(e); }

const char* card(uint32_t i) {
  static std::vector<std::string> texts(kinds().size());
  texts[i] =
      "{\"name\":\"" + kinds()[i].name +
      "\",\"library\":\"zoo\",\"version\":\"1\",\"settings\":\"\",\"unit_roundoff\":1e-16,\"tau_factor\":64,"
      "\"source\":\"\"}";
  return texts[i].c_str();
}

ts_engine* create(uint32_t i) {
  Beast* const b = new Beast{&kinds()[i]};
  b->on("create");
  return b->is("creates_nothing") ? nullptr : reinterpret_cast<ts_engine*>(b);
}
void destroy(ts_engine* e) { delete &self(e); }
void unload(ts_engine* e) {
  if (self(e).triggered()) self(e).on("unload");
}

void report(const Beast& b, const ts_received* r) {
  const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double nothing[9] = {0.0 / 0.0, 1.0 / 0.0};
  if (b.is("receives_strangers")) r->body(r->ctx, 1000, identity, identity);
  if (b.is("receives_negative_shapes")) r->shape(r->ctx, -1, identity, identity, 3);
  if (b.is("receives_nan")) r->body(r->ctx, 0, nothing, nothing);
  for (int i = 0; b.is("receives_a_million_times") && i < 1000000; ++i)
    r->body(r->ctx, 0, identity, identity);
}

int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  Beast& b = self(e);
  b.scene = scene;
  if (!b.triggered()) return TS_ANSWERED;
  b.on("load");
  report(b, received);
  if (b.is("scribbles_on_the_scene")) std::memset(const_cast<ts_body*>(scene->bodies), 0xff, sizeof(ts_body));
  if (b.is("load_detail_in_latin1"))
    std::strcpy(detail,
                "Gr\xf6\xdf"
                "e");
  if (b.is("load_outcome_99")) return 99;
  if (b.is("load_outcome_threw")) return TS_THREW;
  return b.is("load_detail_in_latin1") ? TS_INVALID_INPUT : TS_ANSWERED;
}

void ask(ts_engine* e, int32_t, int32_t a, int32_t b, ts_answer* out, const ts_sink* sink) {
  const Beast& beast = self(e);
  out->outcome = TS_ANSWERED;
  out->has = TS_HAS_OVERLAP | TS_HAS_DISTANCE;
  out->overlap = (a + b) % 2;
  out->distance = a + 10 * b + beast.scene->bodies[1].pose.translation[1];
  if (beast.kind->act && beast.triggered() && a == 0 && b == 2) beast.kind->act(out, sink);
}

struct Loading {
  Loading() {
    const char* what = std::getenv("TOUCHSTONE_ZOO_LOADING");
    for (const auto& [name, f] : incidents)
      if (what && name == what) f();
  }
} loading;

}  // namespace
}  // namespace touchstone::zoo

extern "C" const ts_plugin* touchstone_plugin_v1(void) {
  using namespace touchstone::zoo;
  static const ts_plugin plugin{TS_ABI_VERSION, static_cast<uint32_t>(kinds().size()),
                                card,           create,
                                destroy,        load,
                                unload,         ask,
                                nullptr,        {}};
  return &plugin;
}
