// Runs a function on every index, on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace touchstone::cli {

/// Calls f(0) to f(n - 1), each once, in any order. After an exception no further call begins; the first one
/// is rethrown.
template <class F>
void in_parallel(std::size_t n, int jobs, const F& f) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) try {
        f(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = n;
      }
  };
  std::vector<std::thread> threads;
  const std::size_t most = std::min(n, static_cast<std::size_t>(std::max(1, jobs)));
  for (std::size_t i = 1; i < most; ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace touchstone::cli
