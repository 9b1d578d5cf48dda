// Timing of answers that are too short for one reading of the clock (20 to 30 ns on today's machines).
// Enabled by setting TOUCHSTONE_MEASURE_NS before engines are created; workers inherit it. Each answered pair
// question is then repeated, warm, for about that long, and elapsed_ns is the smallest mean over a batch of
// repetitions, rounded to whole nanoseconds. The protocol, the plug-in interface and the answers do not
// change.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace touchstone {

inline constexpr const char* measure_variable = "TOUCHSTONE_MEASURE_NS";

/// 0: each question is asked only once.
inline std::int64_t measure_ns() {
  const char* text = std::getenv(measure_variable);
  return text ? std::clamp<std::int64_t>(std::atoll(text), 0, 1'000'000'000) : 0;
}

/// `first`: the time of the first call. Batches grow until one takes an eighth of the budget.
template <class Ask>
std::int64_t least_mean_ns(std::int64_t first, std::int64_t budget, Ask&& ask) {
  using Clock = std::chrono::steady_clock;
  std::int64_t least = first, n = 1;
  for (std::int64_t spent = first; spent < budget;) {
    const auto start = Clock::now();
    for (std::int64_t i = 0; i < n; ++i) ask();
    const std::int64_t took =
        std::max<std::int64_t>(1, std::chrono::nanoseconds(Clock::now() - start).count());
    least = std::min(least, (took + n / 2) / n);
    spent += took;
    if (took < budget / 8) n *= 2;
  }
  return least;
}

// CPU time of the calling thread. POSIX.

/// In nanoseconds.
inline std::int64_t thread_cpu_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return std::int64_t{1'000'000'000} * t.tv_sec + t.tv_nsec;
}

}  // namespace touchstone
