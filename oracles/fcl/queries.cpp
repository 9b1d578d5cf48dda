// The two ways in which FCL 0.7 is queried:
//
// As shipped: default tolerances; distance with signed distance enabled; contact through collide(); time of
// impact through the transform overload of continuousCollide() with its defaults (CCDC_NAIVE, ten samples),
// CCDM_TRANS for translations and CCDM_LINEAR if a body rotates.
//
// Tuned: collide at 1e-12. Distance: unsigned at 1e-12 and, if that finds an overlap, signed at 1e-7 (libccd
// solver only; the other has no signed distance). Contact (libccd solver, bounded convex shapes): normal and
// depth from the signed distance; from collide() if the signed distance contradicts the overlap. Time of
// impact: conservative advancement over an explicit InterpMotion with pivot 0, because the transform overload
// leaves its pivot uninitialised.
#include "oracles/fcl/queries.h"

#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>

#include <limits>
#include <numbers>
#include <utility>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::fcl_adapter {
namespace {

constexpr double shipped_tolerance = 1e-6;  // gjk_tolerance and distance_tolerance of FCL's requests
constexpr double tuned_overlap_tolerance = 1e-12;
constexpr double tuned_distance_tolerance = 1e-12;
constexpr double tuned_depth_tolerance = 1e-7;  // below this FCL's EPA fails its own assertions
constexpr std::size_t max_contacts = 256;       // the default of 1 would reduce every manifold to a point

fcl::CollisionRequestd collision_request(const Settings& s, bool with_contacts) {
  fcl::CollisionRequestd r;
  r.gjk_solver_type = s.solver;
  r.gjk_tolerance = overlap_tolerance(s);
  if (with_contacts) {
    r.enable_contact = true;
    r.num_max_contacts = max_contacts;
  }
  return r;
}

/// FCL puts a mesh first, whatever the order of the arguments: o1 and o2 of a contact or distance tell which
/// object the normal and the points refer to. A shape paired with itself is never reordered.
template <class Result>
bool has_b_first(const Result& r, const Placed& a, const Placed& b) {
  return r.o1 == b.geometry && r.o2 == a.geometry && a.geometry != b.geometry;
}

fcl::DistanceResultd run_distance(const Placed& a, const Placed& b, const Settings& s, bool with_sign,
                                  double tolerance) {
  fcl::DistanceRequestd request(/*enable_nearest_points=*/true, with_sign);
  request.distance_tolerance = tolerance;
  request.gjk_solver_type = s.solver;
  fcl::DistanceResultd result;
  // Neither the constructor nor the query for some pairs sets the points: without this they would contain
  // leftovers from the stack.
  for (Vec3& p : result.nearest_points) p.setConstant(std::numeric_limits<double>::quiet_NaN());
  fcl::distance(a.geometry, a.transform, b.geometry, b.transform, request, result);
  // If FCL has no function for a pair, it prints a warning and leaves the largest double in place.
  if (result.min_distance == std::numeric_limits<double>::max())
    throw kit::Unsupported("fcl::distance has no function for these shapes in this order");
  if (has_b_first(result, a, b)) std::swap(result.nearest_points[0], result.nearest_points[1]);
  return result;
}

bool is_bounded_convex(const Placed& p) { return p.kind != TS_HALF_SPACE && p.kind != TS_MESH; }

/// distance_request.h on enable_signed_distance: GST_INDEP and any mesh are NP_X, nearest points "NOT
/// guaranteed to be on the surface of objects". For separated bodies they are the usual closest points.
bool guarantees_deepest_points(const Placed& a, const Placed& b, const Settings& s) {
  return s.libccd() && a.kind != TS_MESH && b.kind != TS_MESH;
}

/// Depth and normal from the signed distance: the witness points of an overlap are the deepest points.
bool refine(const Placed& a, const Placed& b, const Settings& s, Contact& c) {
  const fcl::DistanceResultd r = run_distance(a, b, s, /*with_sign=*/true, tuned_depth_tolerance);
  const Vec3 across = r.nearest_points[0] - r.nearest_points[1];
  const double length = across.norm();
  if (!(r.min_distance < 0 && length > 0)) return false;
  c.normal = across / length;
  c.depth = -r.min_distance;
  c.claimed_tolerance = tuned_depth_tolerance;
  return true;
}

// Upper bound on the speed of a body's points relative to its moving origin.
double turning_speed(const Placed& p, const Motion& m) {
  return m.angular.norm() * (p.geometry->aabb_center.norm() + p.geometry->aabb_radius);
}

}  // namespace

double impact_tolerance(const Placed& a, const Motion& a_motion, const Placed& b, const Motion& b_motion,
                        const Settings& s) {
  const fcl::ContinuousCollisionRequestd request;
  const double toc_err = s.impact_tolerance > 0 ? s.impact_tolerance : request.toc_err;
  return toc_err * ((a_motion.linear - b_motion.linear).norm() + turning_speed(a, a_motion) +
                    turning_speed(b, b_motion));
}

double overlap_tolerance(const Settings& s) {
  if (s.tolerance > 0) return s.tolerance;
  return s.tuned ? tuned_overlap_tolerance : shipped_tolerance;
}

bool overlap(const Placed& a, const Placed& b, const Settings& s) {
  fcl::CollisionResultd result;
  fcl::collide(a.geometry, a.transform, b.geometry, b.transform, collision_request(s, false), result);
  return result.isCollision();
}

Contact contact(const Placed& a, const Placed& b, const Settings& s) {
  fcl::CollisionResultd result;
  fcl::collide(a.geometry, a.transform, b.geometry, b.transform, collision_request(s, true), result);
  Contact c;
  c.claimed_tolerance = overlap_tolerance(s);
  c.overlap = result.isCollision();
  c.depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contactd& k = result.getContact(i);
    // The normal points from o1 to o2.
    const Vec3 normal = has_b_first(k, a, b) ? Vec3(-k.normal) : Vec3(k.normal);
    c.points.push_back({k.pos, k.penetration_depth, normal});
    if (!(k.penetration_depth > c.depth)) continue;
    c.depth = k.penetration_depth;
    c.normal = normal;
  }
  if (s.tuned && s.libccd() && c.overlap && is_bounded_convex(a) && is_bounded_convex(b)) refine(a, b, s, c);
  return c;
}

Distance distance(const Placed& a, const Placed& b, const Settings& s) {
  Distance d;
  d.claimed_tolerance = s.tolerance > 0 ? s.tolerance
                        : s.tuned       ? tuned_distance_tolerance
                                        : shipped_tolerance;
  fcl::DistanceResultd r = run_distance(a, b, s, /*with_sign=*/!s.tuned, d.claimed_tolerance);
  if (s.tuned && r.min_distance < 0) {  // the cores overlap
    // Unsigned: "in collision, the result distance is implementation defined (mostly -1)".
    if (!s.libccd()) {
      d.overlap = true;
      return d;
    }
    r = run_distance(a, b, s, /*with_sign=*/true, tuned_depth_tolerance);
    d.claimed_tolerance = tuned_depth_tolerance;
  }
  d.distance = r.min_distance - a.padding - b.padding;
  const bool are_apart = r.min_distance > 0;
  if (are_apart || guarantees_deepest_points(a, b, s)) d.points = {r.nearest_points[0], r.nearest_points[1]};
  if (d.points && a.padding + b.padding > 0) {
    const Vec3 across = (are_apart ? 1 : -1) * (r.nearest_points[1] - r.nearest_points[0]);
    const double length = across.norm();
    if (!(length > 0)) {
      d.points.reset();
    } else {
      (*d.points)[0] += across * (a.padding / length);
      (*d.points)[1] -= across * (b.padding / length);
    }
  }
  return d;
}

std::optional<double> time_of_impact(const Placed& a, const Pose& a_start, const Motion& a_motion,
                                     const Placed& b, const Pose& b_start, const Motion& b_motion,
                                     const Settings& s) {
  const double turn = std::max(a_motion.angular.norm(), b_motion.angular.norm());
  if (turn >= std::numbers::pi)
    throw kit::Unsupported("FCL defines motions by their end poses: only less than half a turn");
  const fcl::Transform3d a_end = make_transform(pose_at(a_start, a_motion, 1));
  const fcl::Transform3d b_end = make_transform(pose_at(b_start, b_motion, 1));
  fcl::ContinuousCollisionRequestd request;
  request.gjk_solver_type = s.solver;
  if (s.samples > 0) request.num_max_iterations = s.samples;
  if (s.impact_tolerance > 0) request.toc_err = s.impact_tolerance;
  fcl::ContinuousCollisionResultd result;
  if (s.tuned) {
    request.ccd_motion_type = fcl::CCDM_LINEAR;
    request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    const auto motion = [](const fcl::Transform3d& from, const fcl::Transform3d& to) {
      return fcl::InterpMotion<double>(from.linear(), from.translation(), to.linear(), to.translation(),
                                       Vec3::Zero());
    };
    const fcl::InterpMotion<double> move_a = motion(a.transform, a_end), move_b = motion(b.transform, b_end);
    const double t = fcl::continuousCollide(a.geometry, &move_a, b.geometry, &move_b, request, result);
    if (t < 0) throw kit::Unsupported("FCL has no conservative advancement for these shapes");
  } else {
    request.ccd_motion_type = turn > 0 ? fcl::CCDM_LINEAR : fcl::CCDM_TRANS;
    fcl::continuousCollide(a.geometry, a.transform, a_end, b.geometry, b.transform, b_end, request, result);
  }
  if (!result.is_collide) return std::nullopt;
  return result.time_of_contact;
}

}  // namespace touchstone::fcl_adapter
