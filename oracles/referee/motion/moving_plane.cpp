// Finds planes at times 0 = t0 <= t1 <= ... <= until, linear in between, that keep A and B apart. Each piece
// must pass the test of checker_motion.cpp, whose derivation is there: bend <= a + b + 2·min(a, b) for the
// margins a, b of a body at the two ends. Here the test uses the filter's numbers, with some slack.
//
// A piece may keep its direction (that of the nearest points at either end) or turn from one to the other,
// which follows a face or an edge that turns. At distance δ in time before a contact the gap is about μδ and
// the bend at most of the order of C·δ², so once δ < μ/C one piece reaches all the way: few keys suffice.
//
// Exits: `until` is reached; or no step of 2^-54 holds any more (the rounding of the planes exceeds the gap);
// or the cap on attempts is reached (a long graze). In the last two cases the track ends early, at its last
// key.
#include "oracles/referee/motion/moving_plane.h"

#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/exact/exact_pair.h"

namespace touchstone::referee {
namespace {

// Slack over the checker's own test, so that what holds here also holds there.
constexpr Real rounding_factor = 1 + 0x1p-30L;
// The shortest step in time that is tried.
constexpr double least_step = 0x1p-54;
constexpr int attempt_cap = 600;

Real rounded(const Rational& x) { return x.convert_to<Real>(); }

struct Margins {
  Real a = 0, b = 0;
};

Margins margins(const PlaneKey& k, const MovingPart& a, const MovingPart& b) {
  const Real slack = value_rounding * std::fabs(k.o);
  return {k.o - a.top(k.n, k.t) - slack, -k.o - b.top(-k.n, k.t) - slack};
}

Real bend(const PlaneKey& from, const PlaneKey& to, const MovingPart& p) {
  const Real dt = static_cast<Real>(to.t) - static_cast<Real>(from.t);
  const Real longest = std::fmax(norm(from.n), norm(to.n));
  return (dt * norm(to.n - from.n) * p.speed() + dt * dt / 2 * longest * p.bend()) * rounding_factor;
}

bool holds(Real margin0, Real margin1, Real bend) {
  return margin0 > 0 && margin1 > 0 && bend < margin0 + margin1 + 2 * std::fmin(margin0, margin1);
}

bool piece_holds(const PlaneKey& from, const PlaneKey& to, const MovingPart& a, const MovingPart& b) {
  const Margins x = margins(from, a, b), y = margins(to, a, b);
  return holds(x.a, y.a, bend(from, to, a)) && holds(x.b, y.b, bend(from, to, b));
}

// Neither body is left without a part of the gap.
constexpr Real least_share = 0.1L, most_share = 0.9L;

// The part of the gap given to A: nearly all of it when A moves and B does not.
Real share(const MovingPart& a, const MovingPart& b) {
  const Real x = a.speed() + a.bend(), y = b.speed() + b.bend();
  return x + y > 0 ? std::fmin(most_share, std::fmax(least_share, x / (x + y))) : 0.5L;
}

std::optional<PlaneKey> key_along(const Rational3& direction, const Real3& n, double t, const MovingPart& a,
                                  const MovingPart& b) {
  const Real from = a.top(n, t), to = -b.top(-n, t);
  if (!(from < to)) return std::nullopt;
  PlaneKey k{t, direction, 0, n, from + share(a, b) * (to - from)};
  k.offset = exact_of(k.o);
  return k;
}

/// Proposes directions: the half-space's own normal, or that of the nearest points.
class Directions {
 public:
  Directions(const MovingPart& a, const MovingPart& b) : a_(a), b_(b) {
    if (!a.is_half_space() && !b.is_half_space()) return;
    const Rational3 n = a.is_half_space() ? a.normal() : Rational(-1) * b.normal();
    const Rational size = std::max({Rational(abs(n.x)), Rational(abs(n.y)), Rational(abs(n.z))});
    fixed_ = size > 0 ? Rational(1) / size * n : n;
  }
  std::optional<PlaneKey> key(double t) const {
    if (fixed_) return along(*fixed_, t);
    const ConvexTruth v = judge_convex(a_.at(t), b_.at(t), {}, Effort::gap);
    if (!(v.lo > 0)) return std::nullopt;
    return along(exact(to_double(v.normal)), t);
  }
  std::optional<PlaneKey> along(const Rational3& n, double t) const {
    return key_along(n, {rounded(n.x), rounded(n.y), rounded(n.z)}, t, a_, b_);
  }

 private:
  const MovingPart &a_, &b_;
  std::optional<Rational3> fixed_;
};

// Keys that lead from `last` to time t; empty when none of the three ways holds.
PlaneTrack step(const Directions& d, const PlaneKey& last, double t, const MovingPart& a,
                const MovingPart& b) {
  const auto end = d.key(t);
  if (!end) return {};
  if (piece_holds(last, *end, a, b)) return {*end};
  if (const auto same = d.along(last.direction, t); same && piece_holds(last, *same, a, b)) return {*same};
  if (const auto start = d.along(end->direction, last.t); start && piece_holds(*start, *end, a, b))
    return {*start, *end};
  return {};
}

PlaneKey key_of(const ExactPlane& plane, double t) {
  const Rational size = std::max(
      {Rational(abs(plane.direction.x)), Rational(abs(plane.direction.y)), Rational(abs(plane.direction.z))});
  PlaneKey k;
  k.t = t;
  k.direction = Rational(1) / size * plane.direction;
  k.offset = plane.offset / size;
  k.n = {rounded(k.direction.x), rounded(k.direction.y), rounded(k.direction.z)};
  k.o = rounded(k.offset);
  return k;
}

// Neither turns: one plane for the whole sweep, exact for polytopes and rounded shapes.
PlaneTrack exact_track(const MovingPart& a, const MovingPart& b, double until) {
  const Operand x = a.mover().swept(0, until, a.origin()), y = b.at(0);
  if (!x.exact || !y.exact) return {};
  const ExactPair p = make_exact(*x.exact, *y.exact);
  const ExactVerdict v = decide(p, {});
  if (v.overlap) return {};
  const ExactPlane plane = separating_plane(p, v);
  const PlaneKey k = key_of({plane.direction, plane.offset - dot(plane.direction, exact(a.origin()))}, 0);
  PlaneKey last = k;
  last.t = until;
  return {k, last};
}

// A point past a curved body that does not turn: one plane that travels with the body.
PlaneTrack ray_track(const MovingPart& a, const MovingPart& b, double until) {
  const auto past = ray_between(a.mover(), b.mover());
  if (!past) return {};
  const auto beyond = past->ray.plane_until(exact(until));
  if (!beyond) return {};
  const Rational side = past->is_past_b ? -1 : 1;
  PlaneTrack track;
  for (const double t : {0.0, until}) {
    const Rational3 centre = past->body_at(exact(t)) - exact(a.origin());
    track.push_back(
        key_of({side * beyond->direction, side * (beyond->offset + dot(beyond->direction, centre))}, t));
  }
  return track;
}

}  // namespace

MovingPart::MovingPart(const Placed& p, const Motion& m, const Vec3& minus, const Vec3& origin,
                       std::optional<std::size_t> triangle)
    : mover_(p, m, minus, triangle), origin_(origin) {
  const Rational3 velocity = exact(m.linear) - exact(minus);
  speed_ = norm(mover_.velocity()) * (1 + dot_rounding);
  if (std::holds_alternative<HalfSpace>(*p.shape)) {
    const RationalPlane plane = world_plane(p);
    half_space_ =
        Plane{plane.normal, plane.offset - dot(plane.normal, exact(origin)), dot(plane.normal, velocity)};
    return;
  }
  turns_ = !m.angular.isZero(0);
  if (!turns_) return;
  // Even if the turning does not change the set: the checker bounds the motion of points.
  const Real radius = mover_.at(0, origin).body.spin_radius, rate = norm(to_real(m.angular));
  constexpr Real allowance = 1.7321L;  // the checker's bound for discs and ellipsoids: up to √3·radius
  const Real reach = mover_.at(0, origin).exact ? radius : allowance * radius;
  speed_ += rate * reach * (1 + projection_rounding);
  bend_ = rate * rate * reach * (1 + projection_rounding);
}

Rational MovingPart::offset(const Rational& t) const { return half_space_->offset + t * half_space_->rate; }

Real MovingPart::top(const Real3& n, double t) const {
  if (half_space_) {
    // n is a multiple of the normal up to rounding.
    const Rational3& m = half_space_->normal;
    const Real3 r{rounded(m.x), rounded(m.y), rounded(m.z)};
    if (!(dot(r, n) > 0)) return infinity;
    const Real value = rounded(offset(exact(t))) * (dot(n, r) / dot(r, r));
    return value + projection_rounding * std::fabs(value);
  }
  const Solid body = at(t).body;
  const Real value = dot(n, support(body, n).point);
  return value + norm(n) * (body.error + body.radius + projection_rounding * (body.extent + body.radius));
}

bool keeps_apart(const PlaneTrack& track, const MovingPart& a, const MovingPart& b) {
  for (std::size_t i = 0; i + 1 < track.size(); ++i)
    if (!piece_holds(track[i], track[i + 1], a, b)) return false;
  const Margins last = margins(track.back(), a, b);
  return last.a > 0 && last.b > 0;
}

PlaneTrack track_between(const MovingPart& a, const MovingPart& b, double until) {
  const bool bounded = !a.is_half_space() && !b.is_half_space();
  if (bounded && !a.turns() && !b.turns())
    for (const auto& exactly : {exact_track, ray_track})
      if (PlaneTrack whole = exactly(a, b, until); !whole.empty()) return whole;
  const Directions directions(a, b);
  const auto first = directions.key(0);
  if (!first) return {};
  PlaneTrack track{*first};
  double length = until;
  for (int attempt = 0; track.back().t < until && attempt < attempt_cap; ++attempt) {
    const double t = track.back().t, next = length >= until - t ? until : t + length;
    if (!(next > t) || length < least_step) break;
    const PlaneTrack more = step(directions, track.back(), next, a, b);
    track.insert(track.end(), more.begin(), more.end());
    length = more.empty() ? length / 2 : std::min(until, 2 * length);
  }
  return track;
}

}  // namespace touchstone::referee
