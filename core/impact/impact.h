// Time of impact under constant velocities (core/math/pose.h, Motion), t in [0,1], of two moving shapes,
// which come from colliders, Collider::at(pose, motion), or from shapes as they are, {&shape, pose, motion}.
#pragma once

#include <array>
#include <optional>

#include "core/base/outcome.h"
#include "core/narrow/collider.h"

namespace touchstone {

struct ImpactAnswer {
  Outcome outcome = Outcome::answered;
  /// Set: contact at this time, to within `separation`; later than the first contact by at most the rounding
  /// of t to double. Not set with `answered`: the gap is proven positive over [0,1].
  std::optional<double> toi;
  double separation = 0;   // signed gap at `toi`: at most the core's τ; <= 0 only at toi = 0
  double clear_until = 0;  // no contact before this time; proven, also when not_converged
  /// With a toi: unit normal in world axes, from A to B, and the nearest points on A and on B at that time,
  /// in the world. At toi = 0 in overlap: a normal along which a motion by −separation separates them (the
  /// least such depth that double can determine), and the deepest points.
  Vec3 normal_ab = Vec3::Zero();
  std::array<Vec3, 2> witness_w{Vec3::Zero(), Vec3::Zero()};
  int steps = 0;
};

/// The requested detail: `time` omits the witness points and, at toi = 0, separation and normal where they
/// would cost extra work.
enum class ImpactDetail { time, contact };

/// Supports every pair of the narrow phase. A half-space with a velocity is unsupported: it is a static shape.
ImpactAnswer time_of_impact(const MovingShape& a, const MovingShape& b,
                            ImpactDetail detail = ImpactDetail::contact);

}  // namespace touchstone
