// Checks a stored certificate from the scene alone, in rationals and signs of sums of square roots. Shares
// the scene's value types with the rest and no code with what finds certificates; its parts are this and
// checker_set.h.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// What is proven when a certificate of the kind holds:
/// separating_plane  A on direction·x <= offset, B on direction·x > offset. With rationals: any number of
/// planes, four
///                   numbers each; each triangle of a mesh needs one of them.
/// common_point      the point is in both.
/// depth_direction   B moved by `offset` along direction/|direction| shares no interior point with A: depth
/// <= offset. inner_polytope    depth >= offset: the surface of the facets encloses the origin of A-B at the
/// needed distance. Without
///                   facets: one pair of core points near enough for the balls around them, or one point of
///                   the body that is deep enough in a half-space.
/// True when it holds for these two bodies; false when it does not or is of a kind that proves nothing by
/// itself. Throws InputError for a rational that is none.
bool check(const Certificate& c, const Placed& a, const Placed& b);

/// Reads what to_json (referee.h) wrote. Throws InputError when it is not a certificate.
Certificate certificate_from_json(const nlohmann::ordered_json& j);

}  // namespace touchstone::referee
