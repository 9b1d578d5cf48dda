// Divides work among threads, in parts that depend only on the amount of work and the number of threads,
// never on timing. Threads live for one call. Starting and joining one costs about 20 µs, so small work stays
// on the caller's thread (Options::min_work_per_part). Nothing runs between queries.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace touchstone::broad {

/// Calls run(part) for each part of [0, parts): the first on the caller's thread, the others on their own
/// threads, or on the caller's when the system cannot start more. After all parts have ended, rethrows the
/// exception of the first part that failed.
template <class Run>
void run_parts(std::size_t parts, const Run& run) {
  if (parts <= 1) {
    run(std::size_t{0});
    return;
  }
  std::vector<std::exception_ptr> failed(parts);
  const auto guarded = [&](std::size_t p) {
    try {
      run(p);
    } catch (...) {
      failed[p] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    others.reserve(parts - 1);
    for (std::size_t p = 1; p < parts; ++p) try {
        others.emplace_back(guarded, p);
      } catch (const std::system_error&) {
        guarded(p);
      }
    guarded(0);
  }
  for (const std::exception_ptr& e : failed)
    if (e) std::rethrow_exception(e);
}

/// Where part p of [0, n), divided equally, begins; n for p = parts.
inline std::size_t part_begin(std::size_t n, std::size_t parts, std::size_t p) {
  return n / parts * p + std::min(p, n % parts);
}

/// Calls run(begin, end) for the chunks of [0, n) that part p gets when chunks are dealt in turn, so that
/// unevenly distributed work is shared evenly.
template <class Run>
void deal_chunks(std::size_t n, std::size_t chunk, std::size_t parts, std::size_t p, const Run& run) {
  if (parts <= 1)
    run(std::size_t{0}, n);
  else
    for (std::size_t begin = p * chunk; begin < n; begin += parts * chunk)
      run(begin, std::min(n, begin + chunk));
}

}  // namespace touchstone::broad
