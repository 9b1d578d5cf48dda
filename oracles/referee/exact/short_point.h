// Decides exactly, in 512-bit integers, whether a point is in a body.
#pragma once

#include <optional>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// nullopt: the numbers are too long, or the body is a mesh, a half-space, placed by an affine map, or a cone
/// or ellipsoid without interior.
std::optional<bool> contains_short(const Placed& body, const Vec3& point_w);

}  // namespace touchstone::referee
