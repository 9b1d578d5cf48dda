// Broad phases on scripts, ours and others' in one run: for each scene and size each contestant in turn,
// several times (--benchmark_repetitions with --benchmark_enable_random_interleaving=true shuffles them
// further). Timed, as CPU time: the moves handed over, the update, the whole set of pairs. Before it is
// timed, each contestant's pairs are compared with those of our sort and sweep over the same frames; a
// difference is an error of the row.
//   bench_broad --benchmark_filter=uniform/10000
#include <benchmark/benchmark.h>

#include <algorithm>

#include "core/broad/catalog.h"
#include "tests/bench/broad_scenes.h"

namespace {

using namespace touchstone;
using namespace touchstone::bench;

class Ours final : public Contestant {
 public:
  explicit Ours(broad::BroadPhasePtr phase) : phase_(std::move(phase)) {}
  void start(const std::vector<Aabb>& boxes) override {
    for (std::size_t i = 0; i < boxes.size(); ++i) phase_->insert(static_cast<int>(i), boxes[i]);
  }
  void frame(const std::vector<broad::BoxUpdate>& moves, std::vector<broad::IdPair>& out) override {
    phase_->update(moves);
    phase_->pairs(out);
  }
  bool sorted() const override { return true; }
  std::string note() const override { return phase_->explain(); }
  std::size_t memory_bytes() const override { return phase_->memory_bytes(); }

 private:
  broad::BroadPhasePtr phase_;
};

struct Entrant {
  std::string name;
  std::unique_ptr<Contestant> (*make_peer)();
  const broad::CatalogRow* row;
  int most;  // boxes; beyond, a frame takes seconds
  std::unique_ptr<Contestant> make() const {
    return row != nullptr ? std::make_unique<Ours>(row->make()) : make_peer();
  }
};

// Frames in which two contestants must agree before one is timed.
constexpr int frames_compared = 3;

bool agrees(const Entrant& entrant, std::string_view scene_name, int n) {
  BoxScene scene(scene_name, n, 1);
  const auto subject = entrant.make();
  Ours reference(broad::make_broad_phase(n <= 1000 ? "brute_force" : "hierarchical_grid"));
  subject->start(scene.boxes()), reference.start(scene.boxes());
  std::vector<broad::IdPair> a, b;
  for (int f = 0; f < frames_compared; ++f) {
    const auto& moves = scene.step();
    subject->frame(moves, a), reference.frame(moves, b);
    if (!subject->sorted()) std::sort(a.begin(), a.end());
    if (a != b) return false;
  }
  return true;
}

void run(benchmark::State& state, const Entrant& entrant, std::string_view scene_name, int n) {
  if (!agrees(entrant, scene_name, n)) {
    state.SkipWithError("pairs differ");
    return;
  }
  BoxScene scene(scene_name, n, 2);
  const auto subject = entrant.make();
  subject->start(scene.boxes());
  std::vector<broad::IdPair> out;
  for (int f = 0; f < 2; ++f) subject->frame(scene.step(), out);
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    const auto& moves = scene.step();
    state.ResumeTiming();
    subject->frame(moves, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["pairs"] = static_cast<double>(out.size());
  if (subject->memory_bytes() > 0)
    state.counters["bytes/box"] = static_cast<double>(subject->memory_bytes()) / n;
  state.SetLabel(subject->note());
}

std::vector<Entrant> entrants() {
  std::vector<Entrant> all;
  for (const broad::CatalogRow& row : broad::catalog)
    all.push_back({"touchstone:" + std::string(row.name), nullptr, &row,
                   row.name == "brute_force"      ? 10000
                   : row.name == "sort_and_sweep" ? 100000
                                                  : 1000000});
  all.push_back({"plain_sweep", &make_plain_sweep, nullptr, 100000});
#ifdef TS_BENCH_FCL
  all.push_back({"fcl:dyntree_array", &make_fcl_tree, nullptr, 1000000});
#endif
#ifdef TS_BENCH_BULLET
  all.push_back({"bullet:dbvt", &make_bullet_dbvt, nullptr, 100000});
  all.push_back({"bullet:sweep32", &make_bullet_sweep, nullptr, 10000});
#endif
  return all;
}

// Trees and incremental sweeps fall to O(n²) here: a frame of FCL at 1e5 takes half a minute.
bool is_hopeless(const Entrant& e, std::string_view scene, int n) {
  return scene == "teleport" && e.row == nullptr && e.name != "plain_sweep" &&
         n > (e.name == "bullet:dbvt" ? 10000 : 1000);
}

}  // namespace

int main(int argc, char** argv) {
  const auto all = entrants();
  for (const int n : {1000, 10000, 100000, 1000000})
    for (const std::string_view scene : scene_names)
      for (const Entrant& e : all) {
        if (n > e.most || is_hopeless(e, scene, n)) continue;
        const std::string name = std::string(scene) + "/" + std::to_string(n) + "/" + e.name;
        benchmark::RegisterBenchmark(name.c_str(),
                                     [&e, scene, n](benchmark::State& state) { run(state, e, scene, n); })
            ->Unit(benchmark::kMillisecond)
            ->Iterations(n <= 1000     ? 300
                         : n <= 10000  ? 60
                         : n <= 100000 ? 12
                                       : 4);
      }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
