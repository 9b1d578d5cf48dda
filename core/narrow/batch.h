// One pair of shapes in many pairs of poses: samples of a path, of a grasp, of a configuration space. The
// answers are those of overlap() for each pair of poses, bit for bit, on every processor. Two boxes are
// tested several poses at a time, one in each lane of the processor's vectors; other shapes one after the
// other.
#pragma once

#include <span>

#include "core/narrow/narrow_phase.h"

namespace touchstone {

/// out[i]: whether A at poses_a[i] and B at poses_b[i] overlap, as overlap(a.at(poses_a[i]),
/// b.at(poses_b[i])). Throws std::invalid_argument unless the three are of the same length.
void overlaps(const Collider& a, std::span<const Pose> poses_a, const Collider& b,
              std::span<const Pose> poses_b, std::span<OverlapAnswer> out);

}  // namespace touchstone
