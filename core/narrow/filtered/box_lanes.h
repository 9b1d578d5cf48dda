// The separating axis test of two boxes (box_box.h) for several pairs of poses at once, one in each lane of
// the processor's vectors. Every lane does the operations of boxes_meet() in their order, without
// contraction: verdicts and bounds are the same bits. Where boxes_meet() is unsure, or another way answers (a
// quaternion far from unit length, sizes whose squares leave the range of double), a lane gives no verdict.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/math/pose.h"
#include "core/shape/box.h"

namespace touchstone::narrow::filtered {

/// Poses by coordinate.
struct PoseLanes {
  static constexpr std::size_t most_lanes = 8;  // of doubles, in any processor
  static constexpr std::size_t capacity = 4 * most_lanes;
  using Row = std::array<double, capacity>;
  /// Translation x, y, z; rotation x, y, z, w.
  alignas(64) std::array<Row, 7> row;

  /// Precondition: 1 to `capacity` poses. The last one is repeated where lanes are left over.
  void fill(std::span<const Pose> poses);
};

/// Half extents and their sums.
struct LaneBoxes {
  std::array<double, 3> a, b;
  double sum_a, sum_b, largest;
  LaneBoxes(const Box& first, const Box& second);
};

/// By pose: not 0 where it is certain; the error bound of the gap; the largest length of the pair.
struct BoxVerdicts {
  alignas(64) PoseLanes::Row meeting;
  alignas(64) PoseLanes::Row apart;
  alignas(64) PoseLanes::Row bound;
  alignas(64) PoseLanes::Row length;
};

/// Answers the first `count` pairs of poses, 1 to PoseLanes::capacity; the rest of `out` is unspecified.
void boxes_meet(const LaneBoxes& boxes, const PoseLanes& a, const PoseLanes& b, std::size_t count,
                BoxVerdicts& out);

}  // namespace touchstone::narrow::filtered
