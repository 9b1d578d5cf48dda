// The referee's time for one discrete pair, shape pair by shape pair, over the fuzz generator's default mix.
// An iteration of a row judges each of the row's cases once; a case's time is the least of the row's
// iterations, and the columns are quantiles over the cases. `level0` to `level2`: share of the cases whose
// verdict that level decided; `wide`: cases whose bracket is wider than 1e-14·L. To interleave rows:
//   bench_referee --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true
//   bench_referee --benchmark_filter=box-box    TOUCHSTONE_BENCH_CASES=200000 for more cases,
//   TOUCHSTONE_BENCH_SEED
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"

namespace {

using namespace touchstone;

constexpr int passes = 3;

struct Row {
  std::vector<Case> cases;
  std::vector<double> scale;
};

bool is_rounded_or_polytope(ShapeKind k) {
  return k == ShapeKind::sphere || k == ShapeKind::box || k == ShapeKind::capsule || k == ShapeKind::hull;
}

bool is_discrete_pair(const Case& c) {
  return !c.queries.empty() && c.queries[0].question == Question::overlap && c.scene.bodies.size() == 2;
}

std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::map<std::string, Row> rows() {
  std::map<std::string, Row> r;
  const auto add = [&](const std::string& name, const Case& c) {
    r[name].scale.push_back(scale_of_pair(c.scene, 0, 1));
    r[name].cases.push_back(c);
  };
  const std::uint64_t n = number_from_environment("TOUCHSTONE_BENCH_CASES", 20000);
  const std::uint64_t seed = number_from_environment("TOUCHSTONE_BENCH_SEED", 1);
  for (std::uint64_t i = 0; i < n; ++i) {
    const Case c = fuzz::make_case(seed, i);
    if (!is_discrete_pair(c)) continue;
    ShapeKind a = kind_of(c.scene.shape_of(0)), b = kind_of(c.scene.shape_of(1));
    if (b < a) std::swap(a, b);
    add(std::string(type_name(a)) + "-" + std::string(type_name(b)), c);
    add("all", c);
    if (is_rounded_or_polytope(a) && is_rounded_or_polytope(b)) add("polytope-or-rounded", c);
  }
  return r;
}

referee::PairTruth judge(const Scene& s) {
  return referee::judge_pair({&s.shape_of(0), s.bodies[0].pose}, {&s.shape_of(1), s.bodies[1].pose});
}

double quantile(std::vector<double> x, double q) {
  const auto k = static_cast<std::size_t>(q * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(k), x.end());
  return x[k];
}

void count_answers(benchmark::State& state, const Row& row) {
  std::map<std::string, double> count{
      {"level0", 0}, {"level1", 0}, {"level2", 0}, {"undecided", 0}, {"wide", 0}};
  for (std::size_t i = 0; i < row.cases.size(); ++i) {
    const referee::PairTruth t = judge(row.cases[i].scene);
    ++count["level" + std::to_string(t.level)];
    count["undecided"] += t.verdict == referee::Verdict::undecided;
    count["wide"] += std::isfinite(t.gap.lo) && t.gap.hi - t.gap.lo > 1e-14 * row.scale[i];
  }
  const auto n = static_cast<double>(row.cases.size());
  for (const char* k : {"level0", "level1", "level2"}) state.counters[k] = count[k] / n;
  for (const char* k : {"undecided", "wide"}) state.counters[k] = count[k];
  state.counters["cases"] = n;
}

void run(benchmark::State& state, const Row& row) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> least(row.cases.size(), 1e300);
  for ([[maybe_unused]] auto _ : state) {
    double total = 0;
    for (std::size_t i = 0; i < row.cases.size(); ++i) {
      const auto from = Clock::now();
      auto truth = judge(row.cases[i].scene);
      benchmark::DoNotOptimize(truth);
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - from).count();
      least[i] = std::min(least[i], ns);
      total += ns;
    }
    state.SetIterationTime(total * 1e-9);
  }
  state.counters["median_ns"] = quantile(least, 0.5);
  state.counters["p99_ns"] = quantile(least, 0.99);
  state.counters["p999_ns"] = quantile(least, 0.999);
  state.counters["max_ns"] = quantile(least, 1);
  count_answers(state, row);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::map<std::string, Row> all = rows();
  for (const auto& [name, row] : all)
    benchmark::RegisterBenchmark(("judge/" + name).c_str(),
                                 [&row = row](benchmark::State& state) { run(state, row); })
        ->UseManualTime()
        ->Iterations(passes)
        ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
}
