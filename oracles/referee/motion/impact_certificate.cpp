// Puts the result of judge_motion in a form that the checker accepts: planes up to t_lo (moving_plane.h) and
// a common point at t_hi. Everything returned has been accepted by `check`.
#include "oracles/referee/referee.h"

#include <algorithm>

#include "oracles/checker/checker.h"
#include "oracles/referee/certificate.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/half_space.h"
#include "oracles/referee/motion/moving_plane.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

using MovingParts = std::vector<MovingPart>;

// Parts of the way from a candidate point towards the middle of a body.
constexpr Real inward_steps[] = {0.0L, 0x1p-60L, 0x1p-50L, 0x1p-40L, 0x1p-25L, 0x1p-8L, 0.25L};
// How much later than t_hi a contact is looked for, in units of the step.
constexpr double delays[] = {0x1p-53, 0x1p-51, 0x1p-48, 0x1p-44, 0x1p-40, 0x1p-34, 0x1p-27};

struct Scene2 {
  const Placed &a, &b;
  const Motion &motion_a, &motion_b;
  bool accepts(const ImpactCertificate& c) const { return checker::check(c, a, motion_a, b, motion_b); }
};

MovingParts parts(const Placed& p, const Motion& m, const Vec3& minus, const Vec3& origin) {
  MovingParts r;
  const auto* mesh = std::get_if<TriangleMesh>(p.shape);
  if (!mesh) r.emplace_back(p, m, minus, origin, std::nullopt);
  for (std::size_t i = 0; mesh && i < mesh->triangles.size(); ++i) r.emplace_back(p, m, minus, origin, i);
  return r;
}

std::array<std::string, 3> texts(const Rational3& v) { return {text_of(v.x), text_of(v.y), text_of(v.z)}; }

ImpactCertificate::Track printed(const PlaneTrack& track) {
  ImpactCertificate::Track r;
  for (const PlaneKey& k : track) r.push_back({k.t, texts(k.direction), text_of(k.offset)});
  return r;
}

// Every pair of parts needs a track; an earlier one may serve. When one track ends early, all of them must
// end there.
std::vector<PlaneTrack> tracks(const MovingParts& a, const MovingParts& b, double& until) {
  std::vector<PlaneTrack> r;
  for (const MovingPart& x : a)
    for (const MovingPart& y : b) {
      spend(50'000 + 5'000 * static_cast<std::int64_t>(r.size()));
      if (std::any_of(r.begin(), r.end(), [&](const PlaneTrack& t) { return keeps_apart(t, x, y); }))
        continue;
      r.push_back(track_between(x, y, until));
      if (r.back().empty()) return {};
      if (const double reached = r.back().back().t; reached < until) {
        until = reached;
        return tracks(a, b, until);
      }
    }
  return r;
}

void add_planes(ImpactCertificate& c, const Scene2& s, const MovingParts& a, const MovingParts& b,
                double until) {
  ImpactCertificate planes;
  for (const PlaneTrack& t : tracks(a, b, until)) planes.tracks.push_back(printed(t));
  planes.clear_until = until;
  if (s.accepts(planes)) c = planes;
}

// The core point of the body that is deepest in normal·x <= offset, or, if that point is outside, its foot on
// the plane.
Rational3 deepest(const std::vector<Rational3>& points, const Rational3& normal, const Rational& offset) {
  Rational3 best = points.front();
  for (const Rational3& x : points)
    if (dot(normal, x) < dot(normal, best)) best = x;
  const Rational over = dot(normal, best) - offset;
  return over > 0 ? best - over / dot(normal, normal) * normal : best;
}

// A point in the interior, if there is an interior.
Real3 middle_of(const Solid& s) {
  if (s.kind != Solid::Kind::points) return s.centre;
  Real3 sum{0, 0, 0};
  for (const Real3& p : s.points) sum = sum + p;
  return (1 / static_cast<Real>(s.points.size())) * sum;
}

/// Points that are likely to be in both parts at time t, relative to the origin of B; only the exact one if
/// there is one.
std::vector<Rational3> candidates(const MovingPart& a, const MovingPart& b, double t) {
  const Rational3 origin = exact(a.origin());
  const bool plane_a = a.is_half_space(), plane_b = b.is_half_space();
  if (plane_a && plane_b) return {};
  const MovingPart &body = plane_a ? b : a, &other = plane_a ? a : b;
  const Operand x = body.at(t);
  const Real3 centre_a = middle_of(x.body);
  std::vector<Real3> from;
  Real3 centre_b = centre_a;
  if (plane_a || plane_b) {
    if (x.exact) {
      std::vector<Rational3> points = world_points(*x.exact);
      for (Rational3& p : points) p = p - origin;
      return {deepest(points, other.normal(), other.offset(exact(t)))};
    }
    const Rational3 m = other.normal();
    const Real3 n = normalized(Real3{m.x.convert_to<Real>(), m.y.convert_to<Real>(), m.z.convert_to<Real>()});
    from.push_back(support(x.body, -n).point - static_cast<Real>(x.body.radius) * n);
  } else {
    const Operand y = other.at(t);
    centre_b = middle_of(y.body);
    if (x.exact && y.exact) {
      const ExactPair p = make_exact(*x.exact, *y.exact);
      const ExactVerdict v = decide(p, {});
      if (!v.overlap) return {};
      return {common_point(p, v) - origin};
    }
    const ConvexTruth g = judge_convex(x, y, {}, Effort::gap);
    from = {0.5L * (g.witness_a + g.witness_b), g.witness_a, g.witness_b, g.common};
  }
  std::vector<Rational3> r;
  for (const Real s : inward_steps)
    for (const Real3& p : from)
      for (const Real3& to : {0.5L * (centre_a + centre_b), centre_a, centre_b})
        r.push_back(exact_of(p + s * (to - p)));
  return r;
}

bool may_touch(const MovingPart& a, const MovingPart& b, double t) {
  if (a.is_half_space() || b.is_half_space()) return true;
  return judge_convex(a.at(t), b.at(t), {}, Effort::verdict_only).verdict != Verdict::disjoint;
}

// Whether four vertices are not coplanar, decided exactly.
bool is_solid(const Hull& hull) {
  const Rational3 origin = exact(hull.vertices.front()), zero{0, 0, 0};
  Rational3 edge = zero, normal = zero;
  for (const Vec3& v : hull.vertices) {
    const Rational3 d = exact(v) - origin;
    if (dot(normal, d) != 0) return true;
    if (dot(normal, normal) != 0) continue;
    if (dot(edge, edge) == 0)
      edge = d;
    else
      normal = cross(edge, d);
  }
  return false;
}

// The pose of a turning body at t > 0 is known only up to rounding, and the checker requires that a ball of
// that size about the common point lies inside the body. A surface has no room for one.
bool has_room(const Placed& p, const Motion& m) {
  if (m.angular.isZero(0) || core_form(p).radius > 0) return true;
  const auto* hull = hull_if(*p.shape);
  return hull ? is_solid(*hull) : !std::holds_alternative<TriangleMesh>(*p.shape);
}

bool add_contact_at(ImpactCertificate& c, const Scene2& s, const MovingParts& a, const MovingParts& b,
                    double t) {
  for (const MovingPart& x : a)
    for (const MovingPart& y : b) {
      if (!may_touch(x, y, t)) continue;
      for (const Rational3& p : candidates(x, y, t)) {
        spend(100'000);
        ImpactCertificate only;
        only.contact = {text_of(exact(t)), texts(p)};
        if (!s.accepts(only)) continue;
        c.contact = only.contact;
        return true;
      }
    }
  return false;
}

// A point and a curved body that do not turn share a point at an exact time, which need not be a double.
bool add_ray_contact(ImpactCertificate& c, const Scene2& s, const MovingParts& a, const MovingParts& b) {
  for (const MovingPart& x : a)
    for (const MovingPart& y : b) {
      const auto past = ray_between(x.mover(), y.mover());
      const auto meeting = past ? past->ray.first_meeting() : std::nullopt;
      if (!meeting || !meeting->contact) continue;
      const Rational& t = *meeting->contact;
      const Rational3 p = past->body_at(t) + past->ray.point_at(t) - exact(x.origin());
      ImpactCertificate only;
      only.contact = {text_of(t), texts(p)};
      if (!s.accepts(only)) continue;
      c.contact = only.contact;
      return true;
    }
  return false;
}

// At t_hi contact is certain only up to rounding, or (an exact graze) certain only a little earlier. A
// slightly later time will do if the bodies are deeper then.
void add_contact(ImpactCertificate& c, const Scene2& s, const MovingParts& a, const MovingParts& b,
                 double t_hi) {
  const bool room = has_room(s.a, s.motion_a) && has_room(s.b, s.motion_b);
  if (!room && t_hi > 0) return;
  if (add_ray_contact(c, s, a, b) || add_contact_at(c, s, a, b, t_hi) || !room) return;
  for (const double later : delays) {
    const double t = std::min(1.0, std::max(std::nextafter(t_hi, 2.0), t_hi + later));
    if (add_contact_at(c, s, a, b, t)) return;
  }
}

bool is_unbounded_and_turns(const Placed& p, const Motion& m) {
  return std::holds_alternative<HalfSpace>(*p.shape) && !m.angular.isZero(0);
}

void overlap_for(ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
                 const Motion& motion_b, const DepthInTime& deepest) {
  const auto is_half_space = [](const Placed& p) { return std::holds_alternative<HalfSpace>(*p.shape); };
  if (!(deepest.depth > 0) || is_half_space(a) || is_half_space(b)) return;
  const Vec3 origin = translation_of(b);
  Motion turning = motion_b;
  turning.linear = Vec3::Zero();
  const Operand x = parts(a, motion_a, motion_b.linear, origin).at(deepest.part_a).at(deepest.t),
                y = parts(b, turning, Vec3::Zero(), origin).at(deepest.part_b).at(deepest.t);
  const ConvexTruth g = judge_convex(x, y, {}, Effort::certificate);
  if (g.verdict != Verdict::overlap) return;
  ImpactCertificate only;
  only.overlap = {deepest.t, deepest.part_a, deepest.part_b,
                  lower_depth_certificate(g, Difference(x.body, y.body), Vec3::Zero())};
  if (Scene2{a, b, motion_a, motion_b}.accepts(only)) c.overlap = only.overlap;
}

ImpactCertificate certificate_for(const Placed& a, const Motion& motion_a, const Placed& b,
                                  const Motion& motion_b, const TimeTruth& truth) {
  ImpactCertificate c;
  if (is_unbounded_and_turns(a, motion_a) || is_unbounded_and_turns(b, motion_b)) return c;
  const Scene2 s{a, b, motion_a, motion_b};
  const Vec3 origin = translation_of(b);
  Motion turning = motion_b;
  turning.linear = Vec3::Zero();
  const MovingParts x = parts(a, motion_a, motion_b.linear, origin),
                    y = parts(b, turning, Vec3::Zero(), origin);
  const bool hit = truth.verdict == TimeTruth::Verdict::hit;
  const double until = truth.verdict == TimeTruth::Verdict::none ? 1 : truth.t_lo;
  if (!hit || until > 0) add_planes(c, s, x, y, until);
  if (hit) add_contact(c, s, x, y, truth.t_hi);
  return c;
}

}  // namespace

void add_overlap(ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
                 const Motion& motion_b, const DepthInTime& deepest) {
  const AsSurface x(a), y(b);
  c = within_limit(c, [&] {
    ImpactCertificate with = c;
    overlap_for(with, *x, motion_a, *y, motion_b, deepest);
    return with;
  });
}

ImpactCertificate impact_certificate(const Placed& a, const Motion& motion_a, const Placed& b,
                                     const Motion& motion_b, const TimeTruth& truth) {
  const AsSurface x(a), y(b);
  return within_limit(ImpactCertificate{},
                      [&] { return certificate_for(*x, motion_a, *y, motion_b, truth); });
}

}  // namespace touchstone::referee
