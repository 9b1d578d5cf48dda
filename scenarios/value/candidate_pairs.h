// What a right answer to a query for candidates is made of: the pairs that count, the pairs whose boxes
// overlap, and the boxes of bodies that are exactly boxes.
#pragma once

#include <optional>
#include <vector>

#include "core/math/aabb.h"
#include "core/scene/scene.h"

namespace touchstone {

/// Whether a broad phase must report the pair if its bodies overlap: neither filtered nor both static.
bool is_reportable(const Scene& scene, int a, int b);

struct BoxedBody {
  Aabb box;
  int body = 0;
};
/// The pairs (a < b) of bodies whose closed boxes overlap, sorted. No box may hold a NaN.
std::vector<BodyPair> overlapping_boxes(std::vector<BoxedBody> bodies);

/// Every pair as (a, b) with a <= b, sorted, without duplicates.
std::vector<BodyPair> sorted_unique(std::vector<BodyPair> pairs);

/// The box of a body that is exactly a box: a box that is upright or turned by a third about the diagonal
/// (which permutes its extents), or a half-space perpendicular to an axis, which is infinite. Empty for any
/// other body. Non-finite numbers follow IEEE arithmetic.
std::optional<Aabb> exact_box(const Shape& shape, const Pose& pose);

/// The rotations that exact_box recognises.
Quat turn_by_thirds(unsigned thirds);

}  // namespace touchstone
