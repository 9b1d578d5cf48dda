// The size of a case.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace touchstone {

/// Compared in this order.
struct CaseSize {
  std::size_t bodies = 0;
  std::size_t steps = 0;   // of the script; 0 for the default (insert all, query)
  std::uint64_t bits = 0;  // bits to write down the rest: significant bits and exponents of all numbers, one
                           // for each vertex, triangle, shape, query, motion, flag and name
  auto operator<=>(const CaseSize&) const = default;
};

}  // namespace touchstone
