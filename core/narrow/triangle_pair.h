// Two triangles in doubles: bounds of their signed gap that include all rounding, and tests that are certain.
// The coordinates are taken as exact; by how much they may be off is the caller's `displacement`.
//
// Nearest points: Ericson 2005, §5.1 (segment and segment, point and triangle). What they are worth is not
// assumed but measured: |b − a| of two points of the triangles bounds the gap from above, the support planes
// along b − a bound it from below. Separating axes: the directions of the facets of the difference of two
// triangles. Crossing: an edge of one passes through the other, by the signs of five volumes.
#pragma once

#include <array>

#include "core/math/pose.h"

namespace touchstone::narrow {

using Triangle = std::array<Vec3, 3>;

/// lo <= gap <= hi; gap: the distance of the triangles, or minus the least translation that separates them.
struct TriangleGap {
  double lo, hi;
  Vec3 a, b;    // points of the triangles that are hi apart, within rounding
  Vec3 normal;  // of length 1 along b − a, or zero
};

/// The largest distance of two of the six corners, or a little more: roundings are relative to it.
double local_size(const Triangle& a, const Triangle& b);

/// In units of u · local_size: what `lo` and `hi` allow for the rounding of their own formulas.
inline constexpr double triangle_rounding = 12;

/// Bounds of the gap. Once it is certain that the gap exceeds `enough`, hi is infinite.
TriangleGap triangle_gap(const Triangle& a, const Triangle& b, double enough);

/// A lower bound of the gap by the normals of both triangles.
double gap_by_faces(const Triangle& a, const Triangle& b);

struct AxisGap {
  double lo;
  Vec3 normal;  // of length 1 from A to B, within rounding: the direction that shows `lo`; zero if none does
};

/// A lower bound of the gap by separating axes alone: exact, within rounding, if the triangles meet and are
/// not coplanar. As soon as a bound exceeds `enough`, it is returned.
AxisGap gap_by_axes(const Triangle& a, const Triangle& b, double enough);

/// Whether the triangles certainly share a point, wherever their corners are within `displacement`.
bool cross_certainly(const Triangle& a, const Triangle& b, double displacement);

}  // namespace touchstone::narrow
