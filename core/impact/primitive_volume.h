// The signed volume that the polygon's plane spans with the origin, a cubic in time, and what its sign
// proves.
#pragma once

#include "core/impact/primitive_polygon.h"

namespace touchstone::ccd {

/// A time up to which, from t on, the volume is proven not to be zero, so that the origin is in no plane of
/// the polygon; t when nothing is proven.
double volume_clear_until(const MovingPolygon& p, double t);

/// True when it is proven that the polygon holds the origin at some time near t; false says nothing.
bool crosses_near(const MovingPolygon& p, double t);

}  // namespace touchstone::ccd
