// Measures the cost of the pipe per query and of a restart, without assertions. Run by hand.
#include <chrono>
#include <cstdio>

#include "oracles/client/remote_engine.h"

using namespace touchstone;

namespace {

std::filesystem::path in_build(const char* name) { return std::filesystem::path(TS_BINARY_DIR) / name; }

double seconds_of(const auto& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Case> cases_of(int n, int queries, bool triggered) {
  std::vector<Case> cases;
  for (int i = 0; i < n; ++i) {
    Case c;
    c.scene.shapes = {Box{Vec3(1, 1, 1)}, Sphere{1}, Sphere{2}};
    for (int b = 0; b < 3; ++b) {
      Body body;
      body.shape = b;
      body.pose.translation = Vec3(triggered && b == 0 ? 666 : b, i, 0);
      c.scene.bodies.push_back(body);
    }
    for (int q = 0; q < queries; ++q) c.queries.push_back({Question::overlap, 0, triggered ? 2 : 1});
    cases.push_back(c);
  }
  return cases;
}

std::int64_t engine_ns(const std::vector<CaseObservations>& results) {
  std::int64_t sum = 0;
  for (const auto& r : results)
    for (const auto& o : r.answers) sum += o.elapsed_ns;
  return sum;
}

void measure(const char* plugin, const char* engine, int n, int queries) {
  RemoteEngine e({in_build("bin/touchstone-host"), in_build("lib") / plugin, engine, {}});
  const auto cases = cases_of(n, queries, false);
  e.run(cases);
  std::vector<CaseObservations> results;
  const double s = seconds_of([&] { results = e.run(cases); });
  const double asked = static_cast<double>(n) * queries;
  const double own = static_cast<double>(engine_ns(results)) / asked * 1e-3;
  std::printf("%-18s %5d cases x %4d queries: %7.2f us per query, engine %.2f us, overhead %.2f us\n", engine,
              n, queries, s / asked * 1e6, own, s / asked * 1e6 - own);
}

}  // namespace

int main() {
  for (const auto& [n, queries] : {std::pair{5000, 1}, {5000, 4}, {500, 40}, {50, 400}}) {
    measure("libts_bad_behaviours.so", "good", n, queries);
    measure("libtouchstone_bullet_f64.so", "bullet-f64-query", n, queries);
  }
  for (const auto& [plugin, engine] : {std::pair{"libtouchstone_fcl.so", "fcl-libccd"},
                                       {"libtouchstone_bullet_f32.so", "bullet-f32-sim"},
                                       {"libts_bad_behaviours.so", "good"}}) {
    const double s = seconds_of([&, &file = plugin, &name = engine] {
      RemoteEngine({in_build("bin/touchstone-host"), in_build("lib") / file, name, {}});
    });
    std::printf("start and end of a %s worker: %.2f ms\n", engine, s * 1e3);
  }
  RemoteEngine crashing(
      {in_build("bin/touchstone-host"), in_build("lib/libts_bad_behaviours.so"), "segfaults", {}});
  const auto cases = cases_of(100, 1, true);
  const double s = seconds_of([&] { crashing.run(cases); });
  std::printf("a crash and restart: %.2f ms\n", s * 10);
}
