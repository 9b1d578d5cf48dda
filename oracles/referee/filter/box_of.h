// AABB of a body, rounded outward: six support values with their proven error.
#pragma once

#include "core/math/aabb.h"
#include "oracles/referee/filter/body.h"

namespace touchstone::referee {

/// The body's numbers must be relative to the world origin.
Aabb box_of(const Solid& b);

}  // namespace touchstone::referee
