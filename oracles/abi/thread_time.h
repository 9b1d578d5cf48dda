// CPU time of the calling thread. POSIX.
#pragma once

#include <cstdint>
#include <ctime>

namespace touchstone {

/// In nanoseconds.
inline std::int64_t thread_cpu_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return std::int64_t{1'000'000'000} * t.tv_sec + t.tv_nsec;
}

}  // namespace touchstone
