// The inner loops for sorting pairs and for filtering kept candidates, in SIMD, chosen at run time for the
// processor (Highway).
#pragma once

#include <cstdint>

#include "core/broad/box_store.h"

namespace touchstone::broad {

/// Entries that must be readable and writable beyond the ends of the arrays below.
inline constexpr std::size_t list_padding = 16;

/// Bucket s is [s > 0 ? end[s − 1] : 0, end[s]) of `second`. Sorts buckets [from, to) into the same positions
/// of `sorted`; nothing is written beyond them.
void sort_buckets(const std::uint32_t* end, std::size_t from, std::size_t to, const std::uint32_t* second,
                  std::uint32_t* sorted);

/// The same, but writes pairs (bucket, element).
void write_buckets(const std::uint32_t* end, std::size_t from, std::size_t to, const std::uint32_t* second,
                   IdPair* out);

/// Among the candidates (s, t) for s in [from, to), t in second[end[s − 1] … end[s]), writes those whose
/// boxes overlap and returns their number. Compares keys, or doubles where the keys leave doubt
/// (float_key.h). `out` must have room for all candidates.
std::size_t filter_candidates(const KeyBox* keys, const Aabb* boxes, const std::uint32_t* end,
                              const std::uint32_t* second, std::size_t from, std::size_t to, IdPair* out);

/// Appends to `escaped` those of `slots` whose key box is not inside its fat box.
void find_escapes(const KeyBox* keys, const KeyBox* fat, std::span<const std::uint32_t> slots,
                  std::vector<std::uint32_t>& escaped);

}  // namespace touchstone::broad
