// The command line and the timing that the benchmarks of pairs share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/ticks.h"

namespace touchstone::bench {

struct PairOptions {
  int cases = 200, rounds = 1;
  std::string filter;  // part of a pair's name
  std::string column;  // one task or course; empty: all
  std::string only;    // one variant of the core; empty: all
  bool truth = true;   // compare with the referee
};

/// `column`: the name of the option for `PairOptions::column`. False if an argument is unknown or incomplete.
inline bool parse(int argc, char** argv, std::string_view column, PairOptions& o) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view key = argv[i];
    if (key == "--no-truth") {
      o.truth = false;
      continue;
    }
    if (++i == argc) return false;
    if (key == "--cases")
      o.cases = std::max(1, std::atoi(argv[i]));
    else if (key == "--rounds")
      o.rounds = std::max(1, std::atoi(argv[i]));
    else if (key == "--filter")
      o.filter = argv[i];
    else if (key == "--only")
      o.only = argv[i];
    else if (key == column)
      o.column = argv[i];
    else
      return false;
  }
  return true;
}

/// The least times of one variant on the cases of a cell.
struct PairTimes {
  std::vector<std::uint64_t> least;  // by case, in ticks
  double mean_ns = HUGE_VAL;         // of a pass over all cases

  explicit PairTimes(std::size_t cases) : least(cases, ~std::uint64_t{0}) {}

  /// One round: `passes` passes over all cases, because reading the thread's clock is a system call of half a
  /// microsecond, then each case by itself.
  template <class Ask>
  void round(int passes, Ask&& ask) {
    const std::size_t n = least.size();
    const double start = clock_ns(CLOCK_THREAD_CPUTIME_ID);
    for (int k = 0; k < passes; ++k)
      for (std::size_t i = 0; i < n; ++i) ask(i);
    const double calls = static_cast<double>(n) * passes;
    mean_ns = std::min(mean_ns, (clock_ns(CLOCK_THREAD_CPUTIME_ID) - start) / calls);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint64_t t = tick();
      ask(i);
      least[i] = std::min(least[i], tick() - t);
    }
  }
  std::vector<double> each_ns(const Ticks& clock) const {
    std::vector<double> ns;
    for (const std::uint64_t t : least) ns.push_back(clock.ns(t));
    return ns;
  }
};

}  // namespace touchstone::bench
