// How soon does a campaign find each lying engine?
//
//   mutants_score [--seeds 3] [--seconds 60] [--jobs 2] [--only NAME] [--plugin]
//
// For each mutant and seed: the cases of the default mix, as `touchstone fuzz --seed S --engines MUTANT`
// generates, asks and judges them, until the first finding. It gets no hint, neither the family nor the
// fault. One thread per mutant, `jobs` at a time. The table shows the fault by which each was found, and the
// cases and seconds that it took; exit code 1 when a mutant survives the time limit.
//
// The control is the core itself, without a lie, over as many cases as the slowest mutant of each seed
// needed. A finding about it would mean that mutants are found for other reasons than their lies, and gives
// exit code 1.
//
// --plugin runs each mutant in a worker process through the C ABI, like a user's shared object.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>

#include "fuzz/campaign/campaign.h"
#include "oracles/client/remote_engine.h"
#include "oracles/core/core_engine.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"

using namespace touchstone;

namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::uint64_t seeds = 3;
  double seconds = 60;
  int jobs = 2;
  std::string only;
  bool plugin = false;
};

struct Kill {
  std::string fault;  // empty: survived
  std::uint64_t cases = 0;
  double seconds = 0;
};

constexpr std::uint64_t chunk = 32;

// The earliest case of all findings, and its fault.
std::optional<fuzz::Finding> first_finding(const fuzz::CampaignResult& r) {
  std::optional<fuzz::Finding> first;
  for (const auto& [key, f] : r.findings)
    if (!first || f.first_index < first->first_index) first = f;
  return first;
}

// Runs until the first finding, `most` cases, or the time limit.
Kill hunt(EnginePtr engine, std::uint64_t seed, double seconds, std::uint64_t most) {
  std::vector<EnginePtr> engines;
  engines.push_back(std::move(engine));
  const auto start = Clock::now();
  Kill k;
  for (std::uint64_t first = 0; first < most; first += chunk) {
    std::vector<Case> cases;
    for (std::uint64_t i = first; i < first + chunk; ++i) cases.push_back(fuzz::make_case(seed, i));
    fuzz::CampaignResult r;
    fuzz::ask_and_judge(r, cases, first, engines);
    k.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    k.cases = first + chunk;
    if (const auto f = first_finding(r)) {
      k.fault = f->question + " " + f->fault;
      k.cases = f->first_index + 1;
      return k;
    }
    if (k.seconds > seconds) return k;
  }
  return k;
}

EnginePtr make(const mutants::Mutant& m, bool plugin) {
  if (!plugin) return mutants::make_lying_engine(m);
  const std::filesystem::path build = TS_BINARY_DIR;
  return std::make_unique<RemoteEngine>(RemoteSpec{
      build / "bin/touchstone-host", build / "lib/libtouchstone_mutants.so", std::string(m.name), {}});
}

// results[mutant][seed]
std::vector<std::vector<Kill>> hunt_all(const Options& o, const std::vector<mutants::Mutant>& all) {
  std::vector<std::vector<Kill>> results(all.size(), std::vector<Kill>(o.seeds));
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < all.size() * o.seeds; k = next++) {
      const std::size_t m = k / o.seeds, s = k % o.seeds;
      results[m][s] = hunt(make(all[m], o.plugin), s + 1, o.seconds, ~std::uint64_t{0} - chunk);
      fmt::print(stderr, "{:<26} seed {}: {} after {} cases\n", all[m].name, s + 1,
                 results[m][s].fault.empty() ? "SURVIVES" : results[m][s].fault, results[m][s].cases);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < o.jobs; ++i) threads.emplace_back(work);
  for (std::thread& t : threads) t.join();
  return results;
}

template <class T>
T median(std::vector<T> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? T{} : v[v.size() / 2];
}

struct Total {
  std::size_t survived = 0, runs = 0;
  std::vector<double> seconds;
  std::vector<std::uint64_t> cases;
  void add(const Kill& k) {
    ++runs;
    survived += k.fault.empty();
    seconds.push_back(k.seconds);
    cases.push_back(k.cases);
  }
};

void print_table(const std::vector<mutants::Mutant>& all, const std::vector<std::vector<Kill>>& results,
                 Total& total) {
  fmt::print("{:<27}", "mutant");
  for (std::size_t s = 0; s < results[0].size(); ++s)
    fmt::print("{:<31}  cases      s   ", fmt::format("seed {}", s + 1));
  fmt::print("\n");
  for (std::size_t m = 0; m < all.size(); ++m) {
    fmt::print("{:<27}", all[m].name);
    for (const Kill& k : results[m]) {
      fmt::print("{:<31}{:>7} {:>6.2f}   ", k.fault.empty() ? "SURVIVES" : k.fault, k.cases, k.seconds);
      total.add(k);
    }
    fmt::print("\n");
  }
}

// The core over as many cases as the slowest mutant of the seed needed; true when nothing is found.
bool control_is_clean(const Options& o, const std::vector<std::vector<Kill>>& results) {
  bool clean = true;
  for (std::size_t s = 0; s < o.seeds; ++s) {
    std::uint64_t most = chunk;
    for (const auto& of_mutant : results) most = std::max(most, of_mutant[s].cases);
    const Kill k = hunt(make_core_engine(), s + 1, o.seconds, most);
    fmt::print("control: the core, seed {}: {} in {} cases\n", s + 1,
               k.fault.empty() ? "no finding" : k.fault, k.cases);
    clean &= k.fault.empty();
  }
  return clean;
}

int run(const Options& o) {
  std::vector<mutants::Mutant> all;
  for (const mutants::Mutant& m : mutants::mutants())
    if (o.only.empty() || m.name.starts_with(o.only)) all.push_back(m);
  if (all.empty()) {
    fmt::print(stderr, "no mutant is called {}\n", o.only);
    return 2;
  }
  const auto results = hunt_all(o, all);
  Total total;
  print_table(all, results, total);
  fmt::print("\n{} mutants, {} seeds, {} jobs{}: {} of {} runs found nothing\n", all.size(), o.seeds, o.jobs,
             o.plugin ? ", each in a worker" : "", total.survived, total.runs);
  fmt::print("to kill: median {} cases, {:.2f} s; worst {} cases, {:.2f} s\n", median(total.cases),
             median(total.seconds), *std::max_element(total.cases.begin(), total.cases.end()),
             *std::max_element(total.seconds.begin(), total.seconds.end()));
  return control_is_clean(o, results) && total.survived == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"How soon a campaign finds each lying engine"};
  app.add_option("--seeds", o.seeds, "seeds 1 to this")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--seconds", o.seconds, "longest hunt for one mutant")->capture_default_str();
  app.add_option("--jobs", o.jobs, "mutants hunted side by side")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--only", o.only, "mutants whose names begin so");
  app.add_flag("--plugin", o.plugin, "ask through the C ABI, in worker processes");
  CLI11_PARSE(app, argc, argv);
  return run(o);
}
