// How big a case is, and every number in it. The shrinker only takes what is smaller by this measure, so that
// it ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fuzz/generate/numbers.h"
#include "oracles/api/observation.h"

namespace touchstone::fuzz {

/// Compared in this order.
struct Measure {
  std::size_t bodies = 0;
  std::size_t steps = 0;   // of the script; 0: insert all, query
  std::uint64_t bits = 0;  // to write the rest down: significant bits and exponents of all numbers, a bit for
                           // each vertex, triangle, shape, query, motion, flag and name
  auto operator<=>(const Measure&) const = default;
};
Measure measure(const Case& c);

/// Significant bits of the mantissa and bits of the exponent: 0 costs 0, 1 costs 1, 0.1 costs 56.
int bits_of(double v);

/// v rounded to `significant` bits, to nearest.
double rounded_to(double v, int significant);

}  // namespace touchstone::fuzz
