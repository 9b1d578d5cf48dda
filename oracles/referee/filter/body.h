// A placed convex shape as the filter sees it: core ⊕ ball(radius) ⊕ segment[0, sweep], with a bound on how
// far the numbers held here can be from the exact set. Everything that is certified later is certified from
// `support` and `error` alone.
#pragma once

#include <optional>
#include <vector>

#include "oracles/referee/filter/real3.h"
#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// x_world = matrix·x + translation; entries of the matrix within matrix_error of the exact ones, each
/// component of the translation within translation_error.
struct Frame {
  Matrix3 matrix;
  Real3 translation;
  Real matrix_error = 0, translation_error = 0;
};

Vec3 translation_of(const Placed& p);
/// The same body, turned as it is, elsewhere.
Placed with_translation(const Placed& p, const Vec3& to);

/// The exact placement, its translation relative to `origin` (a double vector, exact).
Frame frame_of(const Placed& p, const Vec3& origin);
/// The same at time t of a constant motion; t is exact.
Frame frame_at(const Placed& p, const Motion& m, double t, const Vec3& origin);

/// A convex shape as core ⊕ ball, in its body frame. `none`: a half-space or a mesh. A cylinder or cone of
/// zero radius counts as a segment, an ellipsoid with equal semi-axes under a Pose as a ball.
struct CoreForm {
  enum class Kind { none, origin, segment, box, vertices, cylinder, cone, ellipsoid };
  Kind kind = Kind::none;
  Vec3 size = Vec3::Zero();  // segment, cylinder, cone: (radius, half height, -); box: half extents;
                             // ellipsoid: semi-axes
  double radius = 0;         // of the ball
  /// The core is the hull of finitely many points.
  bool has_points() const { return kind >= Kind::origin && kind <= Kind::vertices; }
};
CoreForm core_form(const Placed& p);

/// The vertices of a core that has_points(), exact doubles: a box's (bit k of the index set: +
/// half_extents[k]), a hull's own vertices. nullopt: any other shape.
std::optional<std::vector<Vec3>> core_points(const Placed& p);

/// T is the arithmetic: long double for every result, double for the filter's first level, Wide for a search
/// whose results the checker must accept.
template <class T>
struct BasicSolid {
  /// orbit: the hull of the circles traced by the points of a polytope when it turns about an axis
  /// indefinitely.
  enum class Kind { points, cylinder, cone, ellipsoid, orbit };
  Kind kind = Kind::points;
  std::vector<Triple<T>> points;  // Kind::points; orbit: (position along the axis, radius of the circle, -)
  Square<T> matrix;               // curved: core = matrix·(shape) + centre; orbit: row[2] is the axis
  Triple<T> centre;
  Triple<T> size;  // cylinder, cone: (radius, half height, -); ellipsoid: semi-axes
  double radius = 0;
  Triple<T> sweep;
  bool is_swept = false;
  /// Proven: (1) every point that `support` returns is within `error` of the exact core, (2) for every n the
  /// exact support value is <= n·support(n) + error·|n|, rounding of that dot product included.
  T error = 0;
  T extent = 0;       // |x| <= extent for every point x of the core
  T spin_radius = 0;  // largest distance of a core point from the body's own origin, rounded up
};
using Solid = BasicSolid<Real>;

template <class T>
struct SupportPoint {
  Triple<T> point;
  int index = -1;  // vertex of a `points` core
};

/// The body in doubles, with an error that covers the rounding. False, with `out` unusable, when the numbers
/// are too large or too small for squares and products of six of them.
bool round_to_double(const Solid& b, BasicSolid<double>& out);

/// Precondition: convex and bounded. `origin` as in frame_of.
Solid make_body(const Placed& p, const Frame& f);
/// For a triangle of a mesh.
Solid make_body(const std::vector<Vec3>& core_points, double radius, const Frame& f);
/// Turns the body into core ⊕ [0, sweep]; `sweep_error` bounds the error of each component.
void add_sweep(Solid& b, const Real3& sweep, Real sweep_error);

/// A set that contains the body turned by any angle about the axis `angular` (not zero) through `centre`, its
/// own origin.
Solid make_orbit(const Solid& b, const Real3& centre, const Real3& angular);

/// Instantiated for double, Real and Wide (wide.h).
template <class T>
SupportPoint<T> support(const BasicSolid<T>& b, const Triple<T>& n);

}  // namespace touchstone::referee
