// Which algorithms answer which pair of shapes: one in extended precision, and one in double and float that
// knows its own error. Rows and columns are ShapeKind; the lower triangle is the upper one seen from the
// other side.
#pragma once

#include "core/narrow/filtered/separate.h"
#include "core/narrow/result.h"
#include "core/shape/shape.h"

namespace touchstone::narrow {

/// Frames in coordinates whose origin is A's translation. `unsupported` for mesh–mesh, half-space–half-space.
Separation separate_placed(const Shape& a, const WideFrame& frame_a, const Shape& b,
                           const WideFrame& frame_b);

/// World frames; shifts to A's translation once, so that the pair's offset costs nothing.
Separation separate(const Shape& a, const WideFrame& frame_a, const Shape& b, const WideFrame& frame_b);

/// The fast answer, as asked of (A, B): normal from A to B, points about A's translation. `mirrored`: the row
/// is (B, A), and so is `scene`. Null function of a pair: `has_fast` is false, the answer `unsure`.
template <class R>
struct FastAnswer {
  fast::Answer<R> answer;
  fast::PairScene<R> scene;
  bool mirrored = false;
};
template <class R>
void separate_fast(const PlacedShape& a, const PlacedShape& b, fast::Asked asked, FastAnswer<R>& out);

/// Whether the table has an algorithm of the arithmetic R for the pair.
template <class R>
bool has_fast(ShapeKind a, ShapeKind b);

}  // namespace touchstone::narrow
