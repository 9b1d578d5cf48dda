// Engines that answer correctly, except for the pair (0, 2) of a scene whose body 0 lies at x = 666.
#undef NDEBUG  // one of them dies of a failed assertion
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "oracles/abi/touchstone_engine.h"

namespace {

using namespace std::chrono_literals;
constexpr double trigger_x = 666;

volatile std::uint64_t sink_value = 0;

void loop_for_ever() {
  for (;;) sink_value = sink_value + 1;
}

void eat_memory() {
  std::vector<char*> blocks;
  for (;;) {
    char* const block = static_cast<char*>(std::malloc(1 << 20));
    if (!block) continue;
    std::memset(block, 1, 1 << 20);
    blocks.push_back(block);
  }
}

int overflow_the_stack(int depth) {
  volatile char frame[4096];
  frame[depth % 4096] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow_the_stack(depth + 1) + frame[depth % 4096];
}

/// Writes to every pipe that this process can write to, including the protocol's.
void spray(const std::string& bytes) {
  for (int fd = 3; fd < 1024; ++fd) {
    struct stat s;
    if (fstat(fd, &s) == 0 && S_ISFIFO(s.st_mode) && (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY)
      if (write(fd, bytes.data(), bytes.size()) < 0) return;
  }
}

/// A frame header that is valid except for the length that it announces.
std::string huge_frame() {
  std::string h("TSP1\x01\x00\x04\x00\xff\xff\xff\x3f\x00\x00\x00\x00", 16);
  return h;
}

void flood_streams() {
  const std::string line(1000, 'x');
  for (int i = 0; i < 2000; ++i) {
    std::puts(line.c_str());
    std::fputs(line.c_str(), stderr);
  }
  std::fflush(stdout);
}

void close_everything() {
  for (int fd = 0; fd < 1024; ++fd) close(fd);
  std::this_thread::sleep_for(3600s);
}

// A double that was never written, opaque to the compiler so that it cannot choose the value.
double unwritten_on_the_stack() {
  volatile double numbers[64];
  asm volatile("" : "=m"(numbers));
  return numbers[32];
}
double unwritten_on_the_heap() {
  double* numbers = static_cast<double*>(std::malloc(64 * sizeof(double)));
  asm volatile("" : "+r"(numbers) : : "memory");
  const double x = numbers[32];
  std::free(numbers);
  return x;
}

/// Uses half a second of CPU time on any machine.
void ponder() {
  for (const std::clock_t start = std::clock(); std::clock() - start < CLOCKS_PER_SEC / 2;)
    sink_value = sink_value + 1;
}

void answer_nan(ts_answer* out) {
  out->has = TS_HAS_OVERLAP | TS_HAS_DISTANCE | TS_HAS_NORMAL | TS_HAS_DEPTH;
  out->overlap = 1;
  out->distance = out->depth = std::numeric_limits<double>::quiet_NaN();
  out->normal[0] = std::numeric_limits<double>::infinity();
}

// Functions that a call stack can name.
extern "C" {
[[gnu::noinline]] TS_EXPORT void bad_writes_nowhere() {
  *reinterpret_cast<volatile int*>(sink_value & 1) = 1;
  sink_value = sink_value + 2;
}
[[gnu::noinline]] TS_EXPORT void bad_calls_nothing() {
  void (*volatile nothing)() = nullptr;
  nothing();
  sink_value = sink_value + 2;
}
[[gnu::noinline]] TS_EXPORT void bad_asserts(const ts_answer* out) {
  assert(out == nullptr && "an answer is not wanted");
  sink_value = sink_value + 2;
}
}

struct Behaviour {
  const char* name;
  void (*act)(ts_answer*, const ts_sink*);
};

const std::array behaviours{
    Behaviour{"good", [](ts_answer*, const ts_sink*) {}},
    Behaviour{"loops", [](ts_answer*, const ts_sink*) { loop_for_ever(); }},
    Behaviour{"sleeps", [](ts_answer*, const ts_sink*) { std::this_thread::sleep_for(3600s); }},
    Behaviour{"aborts",
              [](ts_answer*, const ts_sink*) {
                std::fputs("bad: assertion failed\n", stderr);
                std::abort();
              }},
    Behaviour{"segfaults", [](ts_answer*, const ts_sink*) { raise(SIGSEGV); }},
    Behaviour{"overflows",
              [](ts_answer*, const ts_sink*) { sink_value = static_cast<unsigned>(overflow_the_stack(1)); }},
    Behaviour{"throws", [](ts_answer*, const ts_sink*) { throw std::runtime_error("no such luck"); }},
    Behaviour{
        "throws_at",
        [](ts_answer*, const ts_sink*) { throw std::runtime_error("./fcl/gjk-inl.h:(1270): no such luck"); }},
    Behaviour{"throws_int", [](ts_answer*, const ts_sink*) { throw 7; }},
    Behaviour{"eats_memory", [](ts_answer*, const ts_sink*) { eat_memory(); }},
    Behaviour{"exits", [](ts_answer*, const ts_sink*) { _exit(0); }},
    Behaviour{"exits_3", [](ts_answer*, const ts_sink*) { std::exit(3); }},
    Behaviour{"prints", [](ts_answer*, const ts_sink*) { flood_streams(); }},
    Behaviour{"sprays", [](ts_answer*, const ts_sink*) { spray("this is no answer"); }},
    Behaviour{"announces",
              [](ts_answer*, const ts_sink*) {
                spray(huge_frame());
                std::this_thread::sleep_for(3600s);
              }},
    Behaviour{"closes", [](ts_answer*, const ts_sink*) { close_everything(); }},
    Behaviour{"answers_nan", [](ts_answer* out, const ts_sink*) { answer_nan(out); }},
    Behaviour{"bad_outcome", [](ts_answer* out, const ts_sink*) { out->outcome = 77; }},
    Behaviour{"bad_pair",
              [](ts_answer*, const ts_sink* s) {
                const double up[3] = {0, 0, 1};
                s->contact(s->ctx, 0, 99, up, 1);
              }},
    Behaviour{"long_detail",
              [](ts_answer* out, const ts_sink*) { std::memset(out->detail, 'd', sizeof out->detail); }},
    Behaviour{"writes_nowhere", [](ts_answer*, const ts_sink*) { bad_writes_nowhere(); }},
    Behaviour{"calls_nothing", [](ts_answer*, const ts_sink*) { bad_calls_nothing(); }},
    Behaviour{"asserts", [](ts_answer* out, const ts_sink*) { bad_asserts(out); }},
    Behaviour{"reads_the_stack",
              [](ts_answer* out, const ts_sink*) { out->distance = unwritten_on_the_stack(); }},
    Behaviour{"reads_the_heap",
              [](ts_answer* out, const ts_sink*) { out->distance = unwritten_on_the_heap(); }},
    Behaviour{"ponders", [](ts_answer*, const ts_sink*) { ponder(); }},
    // These misbehave on other occasions.
    Behaviour{"holds_others", [](ts_answer*, const ts_sink*) {}},
    Behaviour{"aborts_in_load", [](ts_answer*, const ts_sink*) {}},
    Behaviour{"loops_in_load", [](ts_answer*, const ts_sink*) {}},
    Behaviour{"refuses_load", [](ts_answer*, const ts_sink*) {}},
    Behaviour{"reports_strangers", [](ts_answer*, const ts_sink*) {}},
    Behaviour{"slow", [](ts_answer*, const ts_sink*) {}},
};

bool is(unsigned engine, const char* name) { return std::strcmp(behaviours[engine].name, name) == 0; }

struct Bad {
  unsigned kind;
  const ts_scene* scene = nullptr;
  bool triggered() const {
    return scene->body_count > 0 && scene->bodies[0].pose.translation[0] == trigger_x;
  }
};

Bad& self(ts_engine* e) { return *reinterpret_cast<Bad*>(e); }

const char* card(uint32_t i) {
  static std::array<std::string, behaviours.size()> texts;
  texts[i] =
      std::string("{\"name\":\"") + behaviours[i].name +
      "\",\"library\":\"bad\",\"version\":\"1\",\"settings\":\"\",\"unit_roundoff\":1e-16,\"tau_factor\":64,"
      "\"source\":\"\"}";
  return texts[i].c_str();
}

ts_engine* create(uint32_t i) { return reinterpret_cast<ts_engine*>(new Bad{i}); }
void destroy(ts_engine* e) { delete &self(e); }
void unload(ts_engine* e) { self(e).scene = nullptr; }

/// A tetrahedron in place of the sphere.
void hold_another(const ts_received& received) {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  ts_shape held{};
  held.kind = TS_HULL;
  held.vertices = corners;
  held.vertex_count = 4;
  received.other_shape(received.ctx, 0, &held);
}

int32_t load(ts_engine* e, const ts_scene* scene, const ts_received* received, char* detail) {
  Bad& bad = self(e);
  bad.scene = scene;
  const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (size_t i = 0; i < scene->body_count; ++i)
    received->body(received->ctx, static_cast<int32_t>(i), identity, scene->bodies[i].pose.translation);
  if (!bad.triggered()) return TS_ANSWERED;
  if (is(bad.kind, "aborts_in_load")) std::abort();
  if (is(bad.kind, "loops_in_load")) loop_for_ever();
  if (is(bad.kind, "holds_others")) hold_another(*received);
  if (is(bad.kind, "reports_strangers")) received->body(received->ctx, 1000, identity, identity);
  if (!is(bad.kind, "refuses_load")) return TS_ANSWERED;
  std::strcpy(detail, "not this scene");
  return TS_INVALID_INPUT;
}

void ask(ts_engine* e, int32_t, int32_t a, int32_t b, ts_answer* out, const ts_sink* sink) {
  Bad& bad = self(e);
  if (is(bad.kind, "slow")) std::this_thread::sleep_for(5ms);
  out->outcome = TS_ANSWERED;
  out->has = TS_HAS_OVERLAP | TS_HAS_DISTANCE;
  out->overlap = (a + b) % 2;
  out->distance = a + 10 * b + bad.scene->bodies[1].pose.translation[1];
  if (bad.triggered() && a == 0 && b == 2) behaviours[bad.kind].act(out, sink);
}

}  // namespace

extern "C" const ts_plugin* touchstone_plugin_v1(void) {
  static const ts_plugin plugin{
      TS_ABI_VERSION, behaviours.size(), card, create, destroy, load, unload, ask, nullptr, {}};
  return &plugin;
}
