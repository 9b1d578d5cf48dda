// How far is a point from a curved body or from a mesh? Closed forms in extended precision, for the many
// points that engines put on or in a body: where a form does not close the question, the general search does.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "oracles/referee/filter/body.h"

namespace touchstone::referee {

/// Proven bounds [lo, hi] of the distance from the origin to a cylinder, cone or ellipsoid, not swept; lo may
/// be below 0 (on or in the body) by rounding. nullopt: another kind.
std::optional<std::array<Real, 2>> origin_to_curved(const Solid& b);

/// The same to the nearest of a union of triangles, each three indices of `points.points`.
std::array<Real, 2> origin_to_triangles(const Solid& points, std::span<const std::array<int, 3>> triangles);

}  // namespace touchstone::referee
