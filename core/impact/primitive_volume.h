// The signed volume spanned by the polygon's plane and the origin, a cubic in time, and what its sign proves.
#pragma once

#include "core/impact/primitive_polygon.h"

namespace touchstone::impact {

/// A time up to which, from t on, the volume is proven to be non-zero, so that the origin is not in the
/// polygon's plane; t if nothing is proven.
double volume_clear_until(const MovingPolygon& p, double t);

/// True: the polygon is proven to contain the origin at some time near t. False: undecided.
bool crosses_near(const MovingPolygon& p, double t);

}  // namespace touchstone::impact
