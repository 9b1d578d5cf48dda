// Selects the algorithms for each pair of shapes: one in extended precision, and one in double and float that
// bounds its own error. Rows and columns are ShapeKind; a pair without a row of its own uses the mirrored
// row.
#pragma once

#include "core/narrow/filtered/separate.h"
#include "core/narrow/result.h"
#include "core/shape/shape.h"

namespace touchstone::narrow {

/// Frames are relative to A's translation. `unsupported` for half-space–half-space.
Separation separate_placed(const ShapeRef& a, const WideFrame& frame_a, const ShapeRef& b,
                           const WideFrame& frame_b);

/// Takes world frames and subtracts A's translation once, so that a large common offset costs no accuracy.
Separation separate(const ShapeRef& a, const WideFrame& frame_a, const ShapeRef& b, const WideFrame& frame_b);

/// The fast answer to the query (A, B): normal from A to B, points relative to A's translation. `mirrored`:
/// the table row is (B, A), and `scene` follows the row. If the pair has no function, `has_fast` is false and
/// the answer is `unsure`.
template <class R>
struct FastAnswer {
  filtered::Answer<R> answer;
  filtered::PairScene<R> scene;
  bool mirrored = false;
};
template <class R>
void separate_fast(const PlacedShape& a, const PlacedShape& b, filtered::Asked asked, FastAnswer<R>& out);

/// Whether the table has an algorithm in the arithmetic R for the pair.
template <class R>
bool has_fast(ShapeKind a, ShapeKind b);

}  // namespace touchstone::narrow
