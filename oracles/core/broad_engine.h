// One broad phase of the core as an engine that answers `candidates` and `swept_candidates`.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "oracles/abi/native_engine.h"

namespace touchstone {

/// Which box represents a body. exact: the body itself, if it is an axis-aligned box (unrotated, or rotated
/// by thirds of a turn about the diagonal) or a half-space perpendicular to an axis; any other body makes the
/// answer `unsupported`. bodies: the core's own AABB of the body, over the whole step for swept_candidates,
/// which exact boxes do not answer.
enum class BroadBoxes { exact, bodies };

/// Names of core/broad/catalog.h.
std::span<const std::string_view> core_broad_phases();

/// Null if there is no such broad phase. Boxes that the broad phase refuses (NaN, inverted) are left out, and
/// the answer's detail says so.
std::unique_ptr<NativeEngine> make_broad_engine(std::string_view name, BroadBoxes boxes);

}  // namespace touchstone
