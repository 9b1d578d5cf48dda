// Boxes taken in, in SIMD, chosen at run time for the processor (Highway).
#pragma once

#include <span>

#include "core/broad/broad_phase.h"
#include "core/broad/float_key.h"

namespace touchstone::broad {

/// Puts box m of `moves` in place at[m]: the box, its keys, and the largest change of its coordinates (no
/// more than 1e30; the difference of two infinities counts as none).
void put_boxes(std::span<const BoxUpdate> moves, const std::uint32_t* at, Aabb* boxes, KeyBox* keys,
               float* steps);

}  // namespace touchstone::broad
