// Asks about numbered pairs in a child process, so that a pair that never ends cannot stop a run.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace touchstone::second_referee {

/// Who is at work on a pair.
enum class Stage : std::uint8_t { preparing, referee, cgal };
const char* to_string(Stage s);

struct Count {
  std::uint64_t pairs = 0, overlaps = 0, contradictions = 0;
  std::uint64_t cgal_lost = 0;     // pairs on which CGAL reached a limit: not compared
  std::uint64_t referee_lost = 0;  // the same of the referee, or of the making of a pair
};

/// What the child has done. It lies in memory that parent and child share; the parent reads it when the child
/// has been stopped anywhere, hence atomic.
struct Progress {
  std::atomic<std::uint64_t> next = 0;
  std::atomic<Stage> stage = Stage::preparing;
  Count count;
};

/// Of one child: CPU seconds for one pair, and bytes of address space.
struct Limits {
  double cpu_seconds = 10;
  std::uint64_t bytes = 4ULL << 30;
};

/// Compares pair `number` and counts it in `progress`, where it also notes the stages.
using Compare = std::function<void(std::uint64_t number, Progress& progress)>;

/// What a run reports as it goes: pairs that are lost, with how they ended, and the counts after every
/// `every` pairs.
struct Told {
  std::function<void(std::uint64_t number, Stage stage, const std::string& how)> lost;
  std::function<void(const Progress& progress)> so_far;
  std::uint64_t every = 50'000;
};

/// Compares the pairs 0 … `pairs` − 1 in turn. A pair that reaches a limit or crashes ends its child, is
/// counted as lost and told; a new child goes on with the next pair. Throws std::system_error if there is no
/// memory or process to be had.
Count run_limited(std::uint64_t pairs, const Limits& limits, const Compare& compare, const Told& told);

}  // namespace touchstone::second_referee
