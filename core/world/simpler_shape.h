// A shape by a simpler one, within an error that is proven.
//
// Error. Two convex sets whose support functions differ by at most δ along every unit direction (their
// Hausdorff distance) change the support of a difference set by at most δ each, hence every signed gap, every
// depth along a direction and the least depth by no more than δ_a + δ_b.
//
// What is tried, and the proof of each δ:
//   hull       as a ball    the hull lies in a ball of radius R and holds one of radius r about the same
//                           centre (its vertices, its faces): (R − r)/2 for the ball half way between
//              as a box     the box holds the hull; each of its corners is within δ of a vertex of it
//              of fewer     the new hull lies in the old one; each vertex left out is within δ of it (GJK's
//              vertices     distance and its bound). Vertices that are not extreme go at no cost. Farthest
//                           first (greedy ε-nets; Agarwal, Har-Peled, Varadarajan 2004, §3)
//   ellipsoid  as a ball    (largest − smallest semi-axis)/2
//   capsule    as a ball    half its half height
// A mesh is a surface without an inside and stays as it is, unless the caller says that his stand for solids:
// then one that is closed and convex, exactly, is its hull, and that may be simpler still.
#pragma once

#include <optional>

#include "core/shape/shape.h"

namespace touchstone {

struct SimplerShape {
  Shape shape;
  Pose in_body;      // of the simpler shape in the frame of the one it stands for; unit quaternion
  double error = 0;  // δ, in the scene's unit, rounded up; placing `in_body` costs its rounding on top
  bool moved() const { return !(in_body == Pose{}); }
  bool operator==(const SimplerShape&) const = default;
};

/// The simplest of those whose error is at most `allowed`: ball, box, fewer vertices, in this order; nothing
/// when none is, or when none is simpler.
std::optional<SimplerShape> simpler_shape(const Shape& shape, double allowed, bool solid_meshes = false);

/// The hull of a mesh whose every edge joins two triangles and whose every triangle has all vertices behind
/// it, both decided exactly; nothing for others.
std::optional<Hull> convex_solid(const TriangleMesh& mesh);

/// body ∘ in_body, in double: coordinates within 2^-48 of (|translation| + |in_body|).
Pose placed_in(const Pose& body, const Pose& in_body);

}  // namespace touchstone
