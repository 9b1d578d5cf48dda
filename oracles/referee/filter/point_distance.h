// Distance of a point from a curved body or a mesh, by closed forms in extended precision, for the many
// points that engines place on or in a body. Where a closed form does not settle the question, the general
// search does.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "oracles/referee/filter/body.h"

namespace touchstone::referee {

/// Proven bounds [lo, hi] of the distance from the origin to a cylinder, cone or ellipsoid, not swept; lo may
/// be below 0 (on or in the body) by rounding. nullopt: any other kind.
std::optional<std::array<Real, 2>> origin_to_curved(const Solid& b);

/// The same for a union of triangles, each given as three indices into `points.points`.
std::array<Real, 2> origin_to_triangles(const Solid& points, std::span<const std::array<int, 3>> triangles);

}  // namespace touchstone::referee
