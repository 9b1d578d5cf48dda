// The referee: what is true of a pair, with a certificate, in arithmetic that cannot be wrong about it
// (truth.md §4). Shares only the scene's value types with the rest of the project.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/pose.h"
#include "core/scene/scene.h"
#include "scenarios/value/certificate.h"

namespace touchstone::referee {

/// lo <= truth <= hi, proven. What is too expensive to find (work.h) is undecided: from -infinity to
/// infinity.
struct Bracket {
  double lo = 0, hi = 0;
};

enum class Verdict { disjoint, overlap, undecided };
std::string_view to_string(Verdict v);

struct PairTruth {
  Verdict verdict = Verdict::undecided;
  /// Signed: > 0 distance, < 0 minus the depth. For an overlapping mesh [-inf, 0]: its depth is not defined.
  /// For a solid mesh that is not convex the bracket of a depth may be wide.
  Bracket gap;
  /// Unit within rounding, A to B: a separating direction, or a direction of (nearly) least w.
  Vec3 normal = Vec3::Zero();
  /// Rounded points of A and B that realise the gap. Where convex bodies overlap in more than one point they
  /// need not be those of `normal`, or be one point of both: with_witness.
  std::array<Vec3, 2> witness;
  Certificate verdict_certificate;  // separating_plane or common_point
  /// Which arithmetic settled the verdict: 0 doubles with their error bounds, 1 extended precision, 2 exact.
  /// The bracket is proven in extended precision in every case.
  int level = 0;
};

/// `hints`: directions (A to B) and points that engines proposed; tried first as certificates, never trusted.
PairTruth judge_pair(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions = {},
                     std::span<const Vec3> hint_points = {});

/// `t`, judge_pair's answer for the same bodies, with points that realise the depth along its normal:
/// witness[0] - witness[1] is the depth times the normal, up to 1e-7 of the bodies' size. Unchanged where
/// they do so already, for bodies that are apart, half-spaces and meshes.
PairTruth with_witness(PairTruth t, const Placed& a, const Placed& b);

/// Is the signed gap at most `margin` (finite, any sign)? overlap: yes, disjoint: no. `truth` is what
/// judge_pair says of the pair; where its bracket holds the margin, the answer is exact for hulls of points
/// rounded by balls, their meshes included, and half-spaces. Undecided: too expensive; a curved body whose
/// gap is within the bracket's width of the margin; a negative margin and a mesh that overlaps, which has no
/// depth.
Verdict judge_within(const Placed& a, const Placed& b, double margin, const PairTruth& truth);

/// The certificate of the verdict on a pair of spheres, boxes, capsules, hulls and half-spaces in a form that
/// checker.h accepts: unchanged if that holds, else with rationals found by the exact level. Kind none: the
/// verdict has no such form.
Certificate checkable_certificate(const PairTruth& truth, const Placed& a, const Placed& b);

/// Evidence that the depth is at least -gap.hi (less the cost of rounding its points to doubles):
/// inner_polytope. Computed on demand, and slower than judging. Kind none: not an overlap with a depth.
Certificate depth_certificate(const PairTruth& truth, const Placed& a, const Placed& b);

/// The directions in which B leaves A about equally fast: all local minima of w over unit n whose w is within
/// `slack` of the depth, slack = max(1e-6·depth, 1e-9·extent of the pair). Not needed for judging, and slower
/// than judging.
struct NearMinimalNormals {
  std::vector<Vec3> normals;  // A to B, unit within rounding, least w first; no two within 1e-9 of each other
  std::vector<double> widths;  // w of each, rounded
  double depth = 0, slack = 0;
  /// Conditioning: the least w among the other local minima, and by how much it exceeds the depth; infinite
  /// when there is no other.
  double second_best = 0, conditioning = 0;
  /// The minima are not isolated (concentric spheres, a circle of directions): `normals` is a sample.
  bool continuum = false;
  bool capped = false;  // more than 256 normals; the rest is not listed
  /// The list is complete and second_best is a lower bound, both up to rounding (1e-15 of the extent).
  /// Otherwise (cylinder, cone, ellipsoid, flat bodies) both are estimates, from a descent from 512
  /// directions.
  bool certified = false;
};
/// Bodies that are apart have one normal and infinite conditioning (the direction of the gap is unique). For
/// undecided pairs, and for meshes and half-spaces that overlap: the normal of judge_pair, not certified.
NearMinimalNormals near_minimal_normals(const Placed& a, const Placed& b);

/// w(n)/|n| where w(n) = h_A(n) + h_B(-n): how far B must move along n to be separated from A. n finite,
/// non-zero. A half-space has a support value only along its own normal m; for it the answer to the same
/// question is depth/cos(n, m), infinite when n does not lead out of it. With a solid mesh that is not
/// convex: the least motion along n, at least 0, after which the two are apart; a bracket that may be wide.
Bracket width(const Placed& a, const Placed& b, const Vec3& n);

/// Two bodies of which at least one is a solid mesh, and that overlap, half-spaces excepted: no motion
/// shorter than this separates them, proven. 0 where nothing is known.
double certain_depth_of_solids(const Placed& a, const Placed& b);

/// Distance of a point from the closed body; 0 inside. The bracket is as narrow as possible, or wider once it
/// is certain that the distance is at most `enough`.
Bracket distance_to(const Placed& a, const Vec3& point_w, double enough = 0);

/// First contact over t in [0,1] under constant velocities. hit: contact is certain at some t <= t_hi, and
/// there is none (gap > 0) for t < t_lo. none: certainly no contact in [0,1]. undecided: a graze that cannot
/// be resolved; `least_gap` then brackets the minimum of the gap over t as far as known.
struct TimeTruth {
  enum class Verdict { hit, none, undecided };
  Verdict verdict = Verdict::undecided;
  double t_lo = 0, t_hi = 1;
  Bracket least_gap;  // minimum of the gap over [0,1], as far as certified
  std::string note;
};
TimeTruth judge_motion(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b);

/// Signed gap at time t of the motion, t exact. A mesh has no interior, but each of its triangles is a convex
/// set: overlapping bodies have the gap of the two parts that overlap most, i.e. one body must move by at
/// least -gap for those parts to separate.
Bracket gap_at(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b, double t);

/// A depth that is certain at time t, in the sense of gap_at, and the parts that are this deep in each other.
struct DepthInTime {
  double depth = 0, t = 0;
  std::size_t part_a = 0, part_b = 0;  // triangle indices for meshes; 0 for any other shape
};
/// The largest depth that a search finds at any time up to t: never more than the truth, 0 if none is found,
/// -infinity if the search is too expensive. `contact`: a time at which the bodies are known to touch, where
/// the search begins.
DepthInTime deepest_before(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           double t, double contact = 0);
double certified_depth_before(const Placed& a, const Motion& motion_a, const Placed& b,
                              const Motion& motion_b, double t, double contact = 0);

/// Bounding box of the placed body, computed exactly and rounded outward; used to judge broad phases without
/// querying every pair.
Aabb outer_box(const Placed& a);
/// The same for the whole motion.
Aabb outer_box(const Placed& a, const Motion& motion);

// Finds certificates about the first contact of two bodies in motion.

/// Certifies the result of judge_motion for the same arguments. Every part of the certificate is accepted by
/// `checker::check`. clear_until is t_lo, or a few ulps of its motion less; the contact is at t_hi or as
/// little after it. Parts that cannot be shown are left out: a contact of a spinning body that has no
/// interior, a graze without depth while spinning, a spinning half-space.
ImpactCertificate impact_certificate(const Placed& a, const Motion& motion_a, const Placed& b,
                                     const Motion& motion_b, const TimeTruth& truth);

/// Adds evidence that the bodies are (about) as deep in each other as deepest_before reported. Adds nothing
/// if the checker rejects it, or for half-spaces, where the common point is evidence enough.
void add_overlap(ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
                 const Motion& motion_b, const DepthInTime& deepest);

// Deforming primitives: a vertex against a triangle or an edge against an edge, every vertex on a straight
// path over t in [0,1]. Decided exactly; nothing is left undecided.

enum class PrimitivePair { vertex_face, edge_edge };

struct PrimitiveTruth {
  bool collides = false;      // the closed primitives share a point at some t in [0,1]
  double t_lo = 0, t_hi = 0;  // bracket the first such t: one double, or two neighbours
};

/// vertex_face: v f0 f1 f2; edge_edge: a0 a1 b0 b1. Positions at t = 0 and at t = 1, all finite.
PrimitiveTruth judge_primitive_motion(PrimitivePair kind, const std::array<Vec3, 4>& start,
                                      const std::array<Vec3, 4>& end);

}  // namespace touchstone::referee
