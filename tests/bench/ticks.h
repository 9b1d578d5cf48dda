// The processor's cycle counter as a clock for single queries, with the cost of an empty measurement
// subtracted, and quantiles of the measurements.
#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace touchstone::bench {

inline double clock_ns(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

inline std::uint64_t tick() {
#if defined(__x86_64__)
  return __rdtsc();
#else
  return static_cast<std::uint64_t>(clock_ns(CLOCK_MONOTONIC));
#endif
}

class Ticks {
 public:
  Ticks() {
    const double start = clock_ns(CLOCK_MONOTONIC);
    const std::uint64_t from = tick();
    std::uint64_t least = ~std::uint64_t{0};
    while (clock_ns(CLOCK_MONOTONIC) - start < 5e7) {
      const std::uint64_t t = tick();
      least = std::min(least, tick() - t);
    }
    ns_ = (clock_ns(CLOCK_MONOTONIC) - start) / static_cast<double>(tick() - from);
    overhead_ = least;
  }
  double ns(std::uint64_t ticks) const {
    return ticks > overhead_ ? static_cast<double>(ticks - overhead_) * ns_ : 0;
  }

 private:
  std::uint64_t overhead_ = 0;
  double ns_ = 1;
};

/// NaN without measurements.
inline double quantile(std::vector<double> v, double q) {
  if (v.empty()) return std::nan("");
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1) + 0.5)];
}

}  // namespace touchstone::bench
