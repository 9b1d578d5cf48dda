#include "core/narrow/narrow_phase.h"

#include <algorithm>
#include <stdexcept>

#include "core/narrow/filtered/box_lanes.h"

namespace touchstone {
namespace {

using narrow::filtered::BoxVerdicts;
using narrow::filtered::LaneBoxes;
using narrow::filtered::PoseLanes;

OverlapAnswer alone(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b) {
  return overlap(a.at(pose_a), b.at(pose_b));
}

void box_overlaps(const Collider& a, std::span<const Pose> poses_a, const Collider& b,
                  std::span<const Pose> poses_b, std::span<OverlapAnswer> out) {
  const LaneBoxes boxes(std::get<Box>(a.shape()), std::get<Box>(b.shape()));
  PoseLanes lanes_a, lanes_b;
  BoxVerdicts verdicts;
  for (std::size_t from = 0; from < out.size(); from += PoseLanes::capacity) {
    const std::size_t count = std::min(PoseLanes::capacity, out.size() - from);
    lanes_a.fill(poses_a.subspan(from, count));
    lanes_b.fill(poses_b.subspan(from, count));
    narrow::filtered::boxes_meet(boxes, lanes_a, lanes_b, count, verdicts);
    for (std::size_t i = 0; i < count; ++i) {
      const bool meeting = verdicts.meeting[i] != 0;
      out[from + i] = meeting || verdicts.apart[i] != 0
                          ? OverlapAnswer{Outcome::answered, meeting, verdicts.bound[i]}
                          : alone(a, poses_a[from + i], b, poses_b[from + i]);
    }
  }
}

}  // namespace

void overlaps(const Collider& a, std::span<const Pose> poses_a, const Collider& b,
              std::span<const Pose> poses_b, std::span<OverlapAnswer> out) {
  if (poses_a.size() != out.size() || poses_b.size() != out.size())
    throw std::invalid_argument("overlaps: poses_a, poses_b and out differ in length");
  if (kind_of(a.shape()) == ShapeKind::box && kind_of(b.shape()) == ShapeKind::box)
    return box_overlaps(a, poses_a, b, poses_b, out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = alone(a, poses_a[i], b, poses_b[i]);
}

}  // namespace touchstone
