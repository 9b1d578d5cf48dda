// Stores box updates, in SIMD, chosen at run time for the processor (Highway).
#pragma once

#include <span>

#include "core/broad/broad_phase.h"
#include "core/broad/float_key.h"

namespace touchstone::broad {

/// Stores box m of `moves` at index at[m]: the box, its keys, and the largest change of its coordinates
/// (capped at largest_step; the difference of two infinities counts as 0).
void put_boxes(std::span<const BoxUpdate> moves, const std::uint32_t* at, Aabb* boxes, KeyBox* keys,
               float* steps);

}  // namespace touchstone::broad
