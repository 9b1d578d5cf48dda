// Bounds on rounding in the measurements of a cover.
#pragma once

#include "core/math/roundoff.h"

namespace touchstone::fuzz::cover {

/// What rounding moves a point on a triangle or in a tetrahedron by, relative to the largest coordinate: each
/// of at most 64 halvings adds a unit roundoff per coordinate.
inline constexpr double moved_by_rounding = 128 * double_roundoff;
/// The error of a computed distance from a triangle, of a volume of a clipped polytope: a few hundred
/// roundings, relative to the largest coordinate and to the volume of the box.
inline constexpr double computed_in_doubles = 4096 * double_roundoff;
/// A bracket below this, relative to the largest coordinate, is not narrowed further: nothing in a file of
/// float32 coordinates means less.
inline constexpr double least_length = 1e-9;

}  // namespace touchstone::fuzz::cover
