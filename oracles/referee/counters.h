// How often each level of the filter was needed, per thread. For measurement only; no answer depends on it.
#pragma once

#include <cstdint>

namespace touchstone::referee {

struct Counters {
  std::uint64_t convex_pairs = 0;      // pairs of convex parts judged
  std::uint64_t expansions = 0;        // of them: GJK alone did not close the bracket
  std::uint64_t exact_expansions = 0;  // of them: rounded signs did not close it either
  std::uint64_t refinements = 0;       // of them: the doubles' inner polytope was not good enough for a proof
  std::uint64_t exact_distances = 0;   // of them: the bracket was also closed in exact arithmetic
  std::uint64_t doubles = 0;           // verdict settled by doubles and their error bounds (level 0)
  std::uint64_t extended = 0;          // verdict settled in extended precision (level 1)
  std::uint64_t exact = 0;             // verdict settled in exact arithmetic (level 2)
  std::uint64_t undecided = 0;         // of them: left undecided
};

inline Counters& counters() {
  thread_local Counters c;
  return c;
}

}  // namespace touchstone::referee
