#include "core/ccd/impact.h"

#include "core/ccd/advance.h"
#include "core/ccd/sphere_sphere.h"
#include "core/narrow/mesh.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"

namespace touchstone {
namespace {

using namespace ccd;

bool moves(const MovingShape& s) { return !s.motion.linear.isZero(0) || !s.motion.angular.isZero(0); }
bool is_static_shape(const Shape& s) {
  return kind_of(s) == ShapeKind::half_space || kind_of(s) == ShapeKind::mesh;
}

// Coordinates relative to the first body's start, so that a common offset costs nothing.
WideFrame shifted(const Pose& p, const WideVec& origin) {
  WideFrame f = wide_frame(p);
  f.translation -= origin;
  return f;
}

ImpactAnswer at_rest(const MovingShape& a, const MovingShape& b) {
  const Separation s = separation({a.shape, a.pose}, {b.shape, b.pose});
  ImpactAnswer r;
  r.outcome = s.outcome, r.separation = static_cast<double>(s.gap);
  if (s.outcome != Outcome::answered) return r;
  if (s.gap <= tolerance::narrow_contact_factor * s.size)
    r.toi = 0;
  else
    r.clear_until = 1;
  return r;
}

// Triangles near the ball that the body sweeps, nearest first; each is asked only up to the first hit so far.
ImpactAnswer against_mesh(const MovingCore& a, const TriangleMesh& mesh, const WideFrame& frame) {
  const WideVec middle = a.start.frame.translation + a.linear / 2;
  const Wide radius = a.start.reach + a.start.radius + a.linear.norm() / 2;
  const WideVec centre = frame.rotation.transpose() * (middle - frame.translation);
  ImpactAnswer best;
  best.clear_until = 1;
  Wide end = 1;
  for (const auto& near : narrow::triangles_near(mesh, centre, radius, 0)) {
    const auto corners = narrow::corners(mesh, near.triangle);
    const ImpactAnswer r = advance(a, moving_core(narrow::vertices_core(corners, frame), {}), end);
    if (r.outcome != Outcome::answered) return r;
    if (r.toi && (!best.toi || *r.toi < *best.toi)) best = r, end = *r.toi;
    if (best.toi && *best.toi == 0) break;
  }
  return best;
}

ImpactAnswer from_convex(const MovingShape& a, const MovingShape& b) {
  const WideVec origin = a.pose.translation.cast<Wide>();
  const MovingCore ca = moving_core(narrow::make_core(*a.shape, shifted(a.pose, origin)), a.motion);
  const WideFrame fb = shifted(b.pose, origin);
  if (const auto* h = std::get_if<HalfSpace>(b.shape)) return advance(ca, narrow::place(*h, fb), 1);
  if (const auto* m = std::get_if<TriangleMesh>(b.shape)) return against_mesh(ca, *m, fb);
  const MovingCore cb = moving_core(narrow::make_core(*b.shape, fb), b.motion);
  if (kind_of(*a.shape) == ShapeKind::sphere && kind_of(*b.shape) == ShapeKind::sphere)
    return sphere_sphere(ca, cb);
  return advance(ca, cb, 1);
}

}  // namespace

ImpactAnswer time_of_impact(const MovingShape& a, const MovingShape& b) {
  for (const MovingShape* s : {&a, &b})
    if (is_static_shape(*s->shape) && moves(*s)) {
      ImpactAnswer r;
      r.outcome = Outcome::unsupported;
      return r;
    }
  if (!moves(a) && !moves(b)) return at_rest(a, b);
  return is_static_shape(*a.shape) ? from_convex(b, a) : from_convex(a, b);
}

}  // namespace touchstone
