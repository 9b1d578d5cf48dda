// Which algorithm answers which pair of shapes. Rows and columns are ShapeKind; the lower triangle is the
// upper one seen from the other side.
#pragma once

#include "core/narrow/result.h"
#include "core/shape/shape.h"

namespace touchstone::narrow {

/// Frames in coordinates whose origin is A's translation. `unsupported` for mesh–mesh, half-space–half-space.
Separation separate_placed(const Shape& a, const WideFrame& frame_a, const Shape& b,
                           const WideFrame& frame_b);

/// World frames; shifts to A's translation once, so that the pair's offset costs nothing.
Separation separate(const Shape& a, const WideFrame& frame_a, const Shape& b, const WideFrame& frame_b);

}  // namespace touchstone::narrow
