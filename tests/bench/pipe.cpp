// bench_pipe [ENGINE]: questions per second that a worker gets answered by an engine behind a pipe, or by a
// plug-in, with batches and without, and per second of CPU time of all processes (harness, worker, command),
// which a loaded machine does not change much. By default the example on NumPy arrays. No assertions.
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <string>

#include "core/math/rng.h"
#include "oracles/client/process_usage.h"
#include "oracles/client/remote_engine.h"

using namespace touchstone;

namespace {

constexpr std::uint64_t seed = 1;
constexpr double least_seconds = 2;

// Spheres near each other; all pairs of the same two, or each pair of its own.
std::vector<Case> pairs(std::size_t n, bool one_pair_of_shapes, const std::vector<Question>& questions) {
  std::vector<Case> cases(n);
  for (std::size_t i = 0; i < n; ++i) {
    Rng rng = Rng::stream(seed, i);
    Case& c = cases[i];
    c.scene.shapes = {Sphere{1}, Sphere{0.5}};
    if (!one_pair_of_shapes) c.scene.shapes = {Sphere{rng.uniform(0.3, 1)}, Sphere{rng.uniform(0.3, 1)}};
    c.scene.bodies.resize(2);
    c.scene.bodies[1].shape = 1;
    c.scene.bodies[1].pose.translation = rng.unit_vector() * rng.uniform(0, 3);
    c.scene.bodies[1].pose.rotation = rng.rotation();
    for (const Question q : questions) c.queries.push_back({q, 0, 1});
  }
  return cases;
}

double cpu_seconds(const RemoteEngine& engine) {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC +
         usage_of_tree(engine.worker_pid(), /*with_root=*/true).cpu_seconds;
}

// Runs the cases in portions of `portion` until enough time has passed.
void measure(RemoteEngine& engine, const char* what, const std::vector<Case>& cases, std::size_t portion) {
  using Clock = std::chrono::steady_clock;
  const std::span<const Case> all(cases);
  std::size_t answered = 0, pairs = 0;
  engine.run(all.first(portion));  // starts the worker and its libraries
  const double cpu_before = cpu_seconds(engine);
  const auto start = Clock::now();
  double seconds = 0;
  for (std::size_t at = 0; seconds < least_seconds; at = (at + portion) % (cases.size() - portion + 1)) {
    for (const CaseObservations& o : engine.run(all.subspan(at, portion))) {
      ++pairs;
      for (const Observation& a : o.answers) answered += a.outcome == Outcome::answered;
    }
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
  }
  const double cpu = cpu_seconds(engine) - cpu_before;
  fmt::print("{:<55}{:>9.0f} pairs/s{:>9.0f} answers/s{:>9.0f} pairs{:>9.0f} answers per CPU second\n", what,
             static_cast<double>(pairs) / seconds, static_cast<double>(answered) / seconds,
             static_cast<double>(pairs) / cpu, static_cast<double>(answered) / cpu);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string engine = argc > 1 ? argv[1] : "pipe:python3 " TS_SOURCE_DIR "/oracles/example/arrays.py";
  RemoteEngine e({std::filesystem::path(TS_BINARY_DIR) / "bin/touchstone-host", engine, "", {}});
  const std::vector<Question> one{Question::overlap};
  const std::vector<Question> three{Question::overlap, Question::distance, Question::contact};
  fmt::print("{} ({})\n", engine, e.card().settings);
  measure(e, "one pair of shapes, overlap, 20,000 poses at once", pairs(20000, true, one), 20000);
  measure(e, "one pair of shapes, distance, 20,000 poses at once", pairs(20000, true, {Question::distance}),
          20000);
  measure(e, "any spheres, overlap, 20,000 pairs at once", pairs(20000, false, one), 20000);
  measure(e, "as in a campaign: 32 cases of three questions at once", pairs(3200, false, three), 32);
  measure(e, "one case of three questions at a time", pairs(320, false, three), 1);
}
