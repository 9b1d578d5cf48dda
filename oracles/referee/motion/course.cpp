// How long a separation lasts. Let n be a unit direction from A to B along which the bodies are g > 0 apart
// at time t.
//
// By speed (conservative advancement, Mirtich 1996): a point of A at p from its origin moves along n at v·n +
// (ω×p)·n = v·n + p·(n×ω), which is at most v·n + ρ|n×ω|, where ρ is the core's radius about its origin (a
// ball around the core adds nothing: it does not turn). Likewise for B. So there is no contact before t +
// g/μ, μ = v·n + ρA|n×ωA| + ρB|n×ωB|. Where spinning makes μ large and the step small, the same is tried for
// the hulls of the circles that the vertices trace, for which μ = v·n.
//
// By acceleration: for points p of A and q of B the height f(t) = n·(q(t) - p(t)) has |f''| <= |ωA|²ρA +
// |ωB|²ρB =: M, because only turning accelerates. If every such height is at least g0 at one time and g1 at τ
// later, each is at least (1-λ)g0 + λg1 - λ(1-λ)Mτ²/2 in between, which is positive when Mτ²/2 < g0 + g1 +
// 2·min(g0, g1) <= (√g0 + √g1)². Two support values prove it, and close to a contact the step covers almost
// the whole way.
//
// A turning half-space: the height of a point of A over its plane is m(t)·z(t) minus a constant, where z is
// relative to the half-space's origin and m is a unit vector that turns at ω: |(m·z)''| <= |ω|²|z| + 2|ω||z'|
// + |z''|, |z'| <= |v| + |ωA|ρA, |z''| <= |ωA|²ρA. That is the M of this case; there is no step by speed.
#include "oracles/referee/motion/course.h"

#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/filter/half_space.h"

namespace touchstone::referee {
namespace {

// Covers the rounding of the bounds that are multiplied by it.
constexpr Real rounding_factor = 1 + 0x1p-40L;
// Covers the rounding of a quotient and a sum in a step in time.
constexpr Real shortened = 1 - 0x1p-50L;
// A step by speed of this length or more needs no second attempt with the orbits.
constexpr double long_step = 0.01;
// A step by speed below this makes no real progress when the gap is down in the rounding.
constexpr double creeping_step = 0x1p-30;
// A normal divided by its length and turned, relative to its length.
constexpr Real unit_normal_rounding = 32 * unit;
// The shortest step by acceleration that is tried.
constexpr double least_step = 0x1p-52;

// The latest time before which there is certainly no contact, given a separation at t; above 1 when there is
// none in the rest of the step.
double after(double t, Real gap, Real speed) {
  if (!(gap > 0)) return t;
  if (!(speed > 0)) return infinity;
  const Real step = gap / speed * shortened;
  return static_cast<Real>(t) + step > 1 ? infinity : std::max(t, round_down(static_cast<Real>(t) + step));
}

Real square(Real x) { return x * x; }

}  // namespace

Course::Course(const Mover& a, const Mover& b, const Vec3& origin) : a_(a), b_(b), origin_(origin) {
  spin_a_ = a_.spins() ? round_up(a_.at(0, origin_).body.spin_radius) : 0;
  spin_b_ = b_->spins() ? round_up(b_->at(0, origin_).body.spin_radius) : 0;
  const auto turning = [](const Mover& m, Real radius) {
    const Real w = norm(m.angular());
    return w * w * radius;
  };
  acceleration_ = (turning(a_, spin_a_) + turning(*b_, spin_b_)) * rounding_factor;
  approach_ =
      (norm(a_.velocity()) + norm(a_.angular()) * spin_a_ + norm(b_->angular()) * spin_b_) * rounding_factor;
}

Course::Course(const Mover& a, const Placed& half_space, const Vec3& angular, const Vec3& origin)
    : a_(a), half_space_(half_space), angular_(angular), origin_(origin) {
  half_space_turns_ = !angular.isZero(0);
  const Solid start = a_.at(0, origin_).body;
  spin_a_ = a_.spins() ? round_up(start.spin_radius) : 0;
  const Real w = norm(a_.angular()), turn = norm(to_real(angular)), v = norm(a_.velocity());
  acceleration_ = w * w * spin_a_ * rounding_factor;
  // |z|: the body's origin starts at most extent + radius away and moves by at most |v|; a point is at most
  // the radius from it.
  if (half_space_turns_)
    acceleration_ = (square(turn) * (start.extent + v + 2 * start.spin_radius) +
                     2 * turn * (v + w * spin_a_) + w * w * spin_a_) *
                    rounding_factor;
}

ConvexTruth Course::judge(const Operand& x, const Operand& y, Effort effort) {
  ++evaluations;
  return half_space_ ? judge_half_space(*half_space_, x, origin_) : judge_convex(x, y, {}, effort);
}

ConvexTruth Course::at(double t, Effort effort) {
  if (half_space_turns_ && t > 0) {
    ++evaluations;
    return against_turned_plane(t);
  }
  const Snapshot& s = parts_at(t);
  return judge(s.a, s.b, effort);
}

const Course::Snapshot& Course::parts_at(double t) {
  if (!now_ || now_->t != t) now_ = Snapshot{t, a_.at(t, origin_), b_ ? b_->at(t, origin_) : Operand{}};
  return *now_;
}

ConvexTruth Course::swept(double from, double to, Effort effort) {
  return judge(a_.swept(from, to, origin_), b_ ? b_->at(0, origin_) : Operand{}, effort);
}

std::optional<MovingRay> Course::ray() const { return b_ ? ray_between(a_, *b_) : std::nullopt; }

// m(t) = exp(tω)·m, the plane m(t)·(x - origin) = o. Each entry of the turning matrix has an error of at most
// E, so m(t) is off by at most 3E|m|; the exact m(t) has the length of m. The body's error terms are as in
// half_space.cpp.
ConvexTruth Course::against_turned_plane(double t) const {
  ConvexTruth r;
  r.lo = -infinity;
  r.hi = infinity;
  const RationalPlane plane = world_plane(*half_space_);
  if (is_zero(plane.normal)) return r;
  const auto real = [](const Rational& x) { return x.convert_to<Real>(); };
  static const Shape dot_shape = Sphere{0};
  const Frame turned = frame_at({&dot_shape, Pose{}}, {Vec3::Zero(), angular_}, t, Vec3::Zero());
  const Real3 m{real(plane.normal.x), real(plane.normal.y), real(plane.normal.z)};
  const Real length = norm(m);
  const Real3 n = turned.matrix * ((1 / length) * m);
  const Real n_error = 3 * turned.matrix_error + unit_normal_rounding;
  const Real height = real(plane.offset - dot(plane.normal, exact(origin_))) / length;
  const Solid body = a_.at(t, origin_).body;
  const SupportPoint s = support(body, -n);
  const Real value = dot(n, s.point) - height - body.radius;
  const Real slack = 2 * n_error * (body.extent + std::fabs(height)) + 2 * body.error +
                     projection_rounding * (body.extent + body.radius + std::fabs(height));
  r.lo = value - slack;
  r.hi = value + slack;
  r.normal = n;
  r.verdict = r.lo > 0 ? Verdict::disjoint : r.hi <= 0 ? Verdict::overlap : Verdict::undecided;
  r.common = r.witness_b = s.point - static_cast<Real>(body.radius) * n;
  r.witness_a = r.witness_b - value * n;
  return r;
}

/// Upper bound of the closing speed along n at any time.
Real Course::closing_speed(const Real3& n, bool turning) const {
  const Real3 v = a_.velocity();
  Real mu = dot(v, n) + projection_rounding * norm(v);
  if (turning && spin_a_ > 0) mu += spin_a_ * norm(cross(n, a_.angular())) * (1 + projection_rounding);
  if (turning && spin_b_ > 0) mu += spin_b_ * norm(cross(n, b_->angular())) * (1 + projection_rounding);
  return mu > 0 ? mu / norm(n) * (1 + projection_rounding) : 0;
}

double Course::clear_without_turning(double t, const ConvexTruth& g) const {
  return after(t, g.lo, closing_speed(a_to_b(g), false));
}

Course::Clear Course::by_speed(double t, const ConvexTruth& g) {
  if (half_space_turns_) return {t, 0};
  const Real rest = 1 - static_cast<Real>(t);
  const Real speed = closing_speed(a_to_b(g), true);
  Clear c{after(t, g.lo, speed), 0};
  if (c.until > 1) return {c.until, g.lo - speed * rest};
  if (c.until - t >= long_step) return c;
  const ConvexTruth o =
      judge(a_.orbit(t, origin_), b_ ? b_->orbit(t, origin_) : Operand{}, Effort::verdict_only);
  const Real slow = closing_speed(a_to_b(o), false);
  const double far = after(t, o.lo, slow);
  return far > c.until ? Clear{far, far > 1 ? o.lo - slow * rest : 0} : c;
}

// Rodrigues' formula, rounded. Any direction may be tried, so the error does not matter.
Real3 turned(const Real3& n, const Real3& angular, Real t) {
  const Real speed = norm(angular), angle = speed * t;
  if (!(angle > 0)) return n;
  const Real3 k = (1 / speed) * angular;
  return normalized(std::cos(angle) * n + std::sin(angle) * cross(k, n) +
                    ((1 - std::cos(angle)) * dot(k, n)) * k);
}

/// Lower bounds of the gap at time t, one along each n; for a half-space, a single one along its own normal.
std::vector<Real> Course::least_along(const std::vector<Real3>& directions, double t) {
  if (half_space_) return {half_space_turns_ ? against_turned_plane(t).lo : at(t).lo};
  const Snapshot& s = parts_at(t);
  const Difference d(s.a.body, s.b.body);
  std::vector<Real> r;
  for (const Real3& n : directions)
    r.push_back(-(d.width_above(d.support(n), n) + d.radius + d.radius_error +
                  value_rounding * (d.extent + d.radius)));
  return r;
}

Course::Clear Course::by_acceleration(double t, const ConvexTruth& g, const Clear& first) {
  const double beyond = first.until;
  const Real3 n = normalized(a_to_b(g));
  const Real now = least_along({n}, t)[0];
  // The gap is lost in rounding: steps by speed would creep through it one after another.
  if (!(now > 0)) return beyond - t < creeping_step ? Clear{t, 0} : first;
  const double rest = 1 - t;
  for (double step = std::min(rest, std::max(stride_, 16 * (beyond - t)));
       t + step > beyond && step >= least_step; step /= 2) {
    const double end = step >= rest ? 1 : t + step;
    const Real length = static_cast<Real>(end) - static_cast<Real>(t);
    std::vector<Real3> directions{n};
    if (!half_space_ && a_.spins()) directions.push_back(turned(n, a_.angular(), length));
    if (b_ && b_->spins()) directions.push_back(turned(n, b_->angular(), length));
    const std::vector<Real> then = least_along(directions, end);
    for (std::size_t i = 0; i < then.size(); ++i) {
      const Real swing = norm(directions[i] - n) + projection_rounding * static_cast<Real>(i > 0);
      const Real bend = (acceleration_ * length * length / 2 + length * swing * approach_) * rounding_factor;
      const Real least = std::min(now, then[i]);
      if (!(least > 0) || !(bend < now + then[i] + 2 * least)) continue;
      stride_ = std::min(1.0, 4 * step);
      return {end >= 1 ? infinity : end, std::max(Real{0}, least - bend / 4)};
    }
  }
  stride_ /= 4;
  return first;
}

Course::Clear Course::clear_from(double t, const ConvexTruth& g) {
  if (!(g.lo > 0)) return {t, 0};
  const Clear first = by_speed(t, g);
  if (first.until > 1) return first;
  return by_acceleration(t, g, first);
}

}  // namespace touchstone::referee
