// Replaces a shape by a simpler one, within a proven error.
//
// Error. Two convex sets whose support functions differ by at most δ along every unit direction (their
// Hausdorff distance) change the support of a difference set by at most δ each, hence every signed gap, every
// depth along a direction and the least depth by no more than δ_a + δ_b.
//
// The candidates, and the proof of each δ:
//   hull       as a ball    the hull lies in a ball of radius R and contains one of radius r about the same
//                           centre (by its vertices and faces): (R − r)/2 for the ball half way between
//              as a box     the box contains the hull; each of its corners is within δ of a hull vertex
//              of fewer     the new hull lies in the old one; each omitted vertex is within δ of it (GJK's
//              vertices     distance and its bound). Vertices that are not extreme cost nothing. Farthest
//                           first (greedy ε-nets; Agarwal, Har-Peled, Varadarajan 2004, §3)
//   ellipsoid  as a ball    (largest − smallest semi-axis)/2
//   capsule    as a ball    half its half height
//   rounded    as a box     0, for radius 0; as a capsule along an axis: 0, for two half extents of zero;
//   that box                     capsule may again be a ball
// A mesh is a surface without an inside and is kept, unless the caller declares that meshes stand for solids.
// Then a mesh that is exactly closed and convex is replaced by its hull, which may be simplified further.
#pragma once

#include <optional>

#include "core/shape/shape.h"

namespace touchstone {

struct SimplerShape {
  Shape shape;
  Pose in_body;      // of the simpler shape in the frame of the original; unit quaternion
  double error = 0;  // δ, in the scene's unit, rounded up; excludes the rounding of placing `in_body`
  bool moved() const { return !(in_body == Pose{}); }
  bool operator==(const SimplerShape&) const = default;
};

/// The first of ball, box and fewer vertices whose error is at most `allowed`; empty when there is none or
/// none is simpler.
std::optional<SimplerShape> simpler_shape(const Shape& shape, double allowed, bool solid_meshes = false);

/// The hull of a mesh in which every edge joins two triangles and every triangle has all vertices behind it,
/// both decided exactly; empty for other meshes.
std::optional<Hull> convex_solid(const TriangleMesh& mesh);

/// body ∘ in_body, in double: coordinates within 2^-48 of (|translation| + |in_body|).
Pose placed_in(const Pose& body, const Pose& in_body);

}  // namespace touchstone
