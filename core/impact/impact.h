// Time of impact under constant velocities (core/math/pose.h, Motion), t in [0,1].
#pragma once

#include <array>
#include <optional>

#include "core/base/outcome.h"
#include "core/shape/shape.h"

namespace touchstone {

struct MeshTree;

struct MovingShape {
  const Shape* shape = nullptr;
  Pose pose;
  Motion motion;
  /// Of a mesh, core/narrow/mesh_tree.h: what spares looking at every triangle. Same answers without.
  const MeshTree* tree = nullptr;
};

struct ImpactAnswer {
  Outcome outcome = Outcome::answered;
  /// Set: contact at this time, to within `separation`; never after first contact by more than the rounding
  /// of t to double. Not set with `answered`: the gap is proven positive over [0,1].
  std::optional<double> toi;
  double separation = 0;   // signed gap at `toi`: at most the core's τ, 0 or less only at toi = 0
  double clear_until = 0;  // no contact before this time: proven, also when not_converged
  /// With a toi: unit, world axes, from A to B, and the nearest points on A and on B at that time, in the
  /// world. At toi = 0 in overlap: a normal along which −separation separates them, the least such depth as
  /// far as double tells, and the deepest points.
  Vec3 normal_ab = Vec3::Zero();
  std::array<Vec3, 2> witness_w{Vec3::Zero(), Vec3::Zero()};
  int steps = 0;
};

/// What is asked: `time` leaves the witness points out, and at toi = 0 separation and normal too, where they
/// would be work of their own.
enum class ImpactDetail { time, contact };

/// Every pair of the narrow phase. A mesh or half-space with a velocity is unsupported: they are static
/// shapes.
ImpactAnswer time_of_impact(const MovingShape& a, const MovingShape& b,
                            ImpactDetail detail = ImpactDetail::contact);

}  // namespace touchstone
