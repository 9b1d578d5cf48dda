// A moving body as represented in double: its core at t = 0 and bounds on its rotation.
#pragma once

#include "core/impact/advance.h"
#include "core/narrow/filtered/query.h"
#include "core/shape/convex_body.h"

namespace touchstone::impact::filtered {

using narrow::filtered::u;
using Vec = V3<double>;
using Mat = M3<double>;

struct Mover {
  ConvexBody<double> body;
  WideMat start_wide;  // rotation at t = 0; `start` is rounded
  Mat start;
  Vec linear = Vec::Zero(), angular = Vec::Zero();
  bool turns = false;
  Vec axis = Vec::UnitZ();  // of rotation, unit
  WideVec axis_wide = WideVec::UnitZ();
  double speed = 0;  // |angular|
  Wide speed_wide = 0;
  double off_axis = 0;      // bound on the core's distance from the axis
  double up = 0, down = 0;  // support values of the core along ±axis; constant
};

/// Rotation of any finite non-zero quaternion; equals wide_rotation() except for the last bits, and is
/// faster.
WideMat rotation_of(const Quat& q);

/// Precondition: a bounded convex shape. A body whose core is a point does not rotate.
Mover make_mover(const ShapeRef& shape, const WideMat& rotation, const Motion& motion);

/// A triangle, or any few points. The points must outlive the mover.
Mover make_points(std::span<const Vec3> points, const WideMat& rotation, const Motion& motion = {});

/// Rotation at time t. `precise`: computed in extended precision and rounded once.
Mat rotation_at(const Mover& m, double t, bool precise);

inline bool is_point(const Mover& m) { return symmetry(m.body) == convex::Symmetry::centre; }

/// The core if it is a box, otherwise null.
inline const convex::BoxCore<double>* box_core(const Mover& m) {
  return std::get_if<convex::BoxCore<double>>(&m.body.core);
}

/// Core point farthest along n at a rotation r, in the body's frame.
inline Vec farthest(const Mover& m, const Mat& r, const Vec& n) {
  return on_core(m.body, [&]<class C>(const C& core) -> Vec {
    if constexpr (C::symmetry == convex::Symmetry::centre)
      return Vec::Zero();
    else
      return core.support(r.transpose() * n);
  });
}

}  // namespace touchstone::impact::filtered
