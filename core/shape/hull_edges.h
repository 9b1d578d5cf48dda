// The edges of a hull that was not made by make_hull(), which finds them itself.
#pragma once

#include "core/shape/hull.h"

namespace touchstone {

/// Sets the edges by the vertices and faces; none if a coordinate is not finite. Precondition: the faces'
/// indices are those of vertices.
void derive_edges(Hull& hull);

}  // namespace touchstone
