// The true contact region of two bodies: what a contact manifold should span (truth.md §2, §3).
#pragma once

#include <optional>
#include <vector>

#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// The features of A and B that face each other across a contact plane, projected onto it along the normal
/// and intersected. Vertices: world frame, half-way between the two bodies' support planes, counter-clockwise
/// seen against the normal (from B), each within `error` of the region defined at contact_region.
struct ContactRegion {
  enum class Kind {
    none,     // a mesh (it has no depth), or features that do not face each other
    point,    // one vertex
    segment,  // two
    polygon   // three or more
  };
  Kind kind = Kind::none;
  std::vector<Vec3> vertices;
  double area = 0;    // of a polygon
  double length = 0;  // of a segment
  double error = 0;
};

/// How far below its support plane a vertex may lie and still belong to the feature, in units of L: faces
/// that were meant to be parallel are parallel only up to the rounding of a pose, often that of a float.
inline constexpr double contact_slack_factor = 1e-6;

/// Corners of the polygon that approximates the rim of a cylinder or cone; its area is 1e-4 less than the
/// disc's.
inline constexpr int rim_corners = 256;

/// A's feature: the hull of its extreme points x with n·x >= h_A(n) - slack·|n|, n = normal_ab; B's likewise
/// with -n. For polytopes and cores of rounded shapes these are vertices, decided exactly; for rims, the
/// corners of a polygon, one of them the support point; for an ellipsoid, its support point; for a
/// half-space, the whole plane. Features that miss each other by less than slack in the plane count as
/// meeting. slack: a length > 0. normal_ab: finite, not zero.
ContactRegion contact_region(const Placed& a, const Placed& b, const Vec3& normal_ab, double slack);
/// The same with a slack for each body, as where a face of one is the reference for what lies deeper of the
/// other. The smaller of the two is the distance up to which features meet.
ContactRegion contact_region(const Placed& a, const Placed& b, const Vec3& normal_ab, double slack_a,
                             double slack_b);

/// The corners of what `body` has beyond the plane of the other body's face, within the prism over that face:
/// corners of the body, places where its edges cross the prism's sides, and where the prism's edges leave the
/// body; each more than `slack` deeper than the plane. Half-way to the plane, world frame. A round face is a
/// polygon with rim_corners. Of rounded shapes the cores, as above; of a round side, the line through the
/// support point. face_normal: out of `face`, finite, not zero; its face is what lies within slack of the
/// support plane. nullopt: that is not a polygon, or one of the bodies is a mesh or a half-space.
std::optional<std::vector<Vec3>> corners_beyond_face(const Placed& face, const Placed& body,
                                                     const Vec3& face_normal, double slack);

/// How far each corner of the body is below its support plane along the normal (finite, not zero): the slacks
/// at which contact_region() takes it, to rounding. A rim's highest and lowest point; not of a half-space.
std::vector<double> corner_heights(const Placed& body, const Vec3& normal);

/// The share of a polygon's area, or of a segment's length, covered by the hull of the points projected along
/// the normal; at most 1. nullopt when the region is neither a polygon nor a segment.
std::optional<double> covered_share(const ContactRegion& region, const std::vector<Vec3>& points,
                                    const Vec3& normal);

/// Whether the points bear a weight that rests evenly on the region: whether its centroid is in their hull,
/// projected along the normal, or within 1e-3 of the region's largest diameter of it. nullopt as for
/// covered_share.
std::optional<bool> holds_centroid(const ContactRegion& region, const std::vector<Vec3>& points,
                                   const Vec3& normal);

/// Area of the hull of the points projected along the normal.
double spanned_area(const std::vector<Vec3>& points, const Vec3& normal);
/// Largest distance between two of the points projected along the normal.
double spanned_length(const std::vector<Vec3>& points, const Vec3& normal);

/// How far `p` is from the hull of the points across the normal (their projections along it; not empty), and
/// along it from the heights that they have: the root of the sum of both squares.
double distance_from_span(const Vec3& p, const std::vector<Vec3>& points, const Vec3& normal);

// Where a mesh is a plane as far as a body reaches through it, so that the surface has a least depth and a
// normal (truth.md §2).

/// The plane of the triangles that the body touches.
struct FlatSurface {
  Vec3 normal;    // unit within rounding, world; either side
  Bracket reach;  // of the least motion that separates body and mesh: along `normal` or against it
};

/// Precondition: a mesh and any body. The mesh equals one plane at every point nearer to the body than twice
/// `reach`: there all its triangles lie in the plane exactly, and each of their edges has triangles on both
/// sides. The body must then move by at least min(reach/|n·normal|, 2·reach) along a unit vector n to leave
/// the mesh. nullopt: this is not the case, or not shown (T-junctions, triangles without area, too
/// expensive); the bodies are apart; the body is neither bounded nor convex.
std::optional<FlatSurface> flat_surface(const Placed& mesh, const Placed& body);

}  // namespace touchstone::referee
