// Timing of answers that are too short for one reading of the clock (20 to 30 ns on today's machines):
// whoever wants that sets TOUCHSTONE_MEASURE_NS before engines are made; workers inherit it. Each answered
// question about a pair is then asked again for about so long, warm, and elapsed_ns is the least mean of a
// batch of equal questions, rounded to whole nanoseconds. Protocol, plug-in interface and answers are as
// without it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>

namespace touchstone {

inline constexpr const char* measure_variable = "TOUCHSTONE_MEASURE_NS";

/// 0: each question is asked once.
inline std::int64_t measure_ns() {
  const char* text = std::getenv(measure_variable);
  return text ? std::clamp<std::int64_t>(std::atoll(text), 0, 1'000'000'000) : 0;
}

/// `first`: what one asking took. Batches grow until one takes an eighth of the budget.
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

}  // namespace touchstone
