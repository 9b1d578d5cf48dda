// Checks a stored certificate from the scene alone, in rationals and rational bounds of square roots. Shares
// the scene's value types with the rest and no code with what finds certificates. Its parts are this,
// checker_set.h (exact sets) and checker_motion.cpp (sets in motion); certificate_json.cpp only reads.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// What a certificate of each kind proves when it holds:
///   separating_plane  A on direction·x <= offset, B on direction·x > offset. With rationals: any number of
///                     planes, four numbers each; each pair of triangles of meshes needs one of them.
///   common_point      the point is in both.
///   depth_direction   B moved by `offset` along direction/|direction| shares no interior point with A.
///   inner_polytope    depth >= offset: the facets' surface encloses the origin of A-B at the needed
///   distance.
///                     Without facets: one pair of core points near enough for the balls around them, or one
///                     point that is deep enough in a half-space.
/// False when it does not hold for these two bodies or is of a kind that proves nothing by itself. Throws
/// InputError for a rational that is none. Motions: impact_certificate.h.
bool check(const Certificate& c, const Placed& a, const Placed& b);

/// Reads what to_json (referee.h) wrote. Throws InputError when it is not a certificate.
Certificate certificate_from_json(const nlohmann::ordered_json& j);

}  // namespace touchstone::referee
