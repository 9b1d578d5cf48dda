// One broad phase of the core as an engine that answers `candidates` and `swept_candidates`.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "oracles/abi/native_engine.h"

namespace touchstone {

/// What box a body is given. exact: that of a body which is one, as it stands (an upright box, or one turned
/// by thirds about the diagonal; a half-space perpendicular to an axis); any other body makes the answer
/// `unsupported`. bodies: the core's own box around the body; of the whole step for swept_candidates, which
/// exact boxes do not answer.
enum class BroadBoxes { exact, bodies };

/// Names of core/broad/catalog.h.
std::span<const std::string_view> core_broad_phases();

/// Null when there is no such broad phase. Boxes that the broad phase refuses (NaN, inverted) are left out;
/// the answer's detail says so.
std::unique_ptr<NativeEngine> make_broad_engine(std::string_view name, BroadBoxes boxes);

}  // namespace touchstone
