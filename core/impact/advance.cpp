// Conservative advancement (Mirtich 1996) with a second-order bound. At time t let n be the unit normal of a
// pair of support planes with gap s. For a body point at c + r, rotating with ω about c, the coordinate along
// n satisfies for Δ >= 0, with the K of turning_bound.h for a fixed direction,
//
//   n·x(t+Δ) <= n·x(t) + Δ n·v + Δ r·(n×ω) + K Δ²/2,
//
// because n·(ω×r) = r·(n×ω). The maximum over the body of r·n + Δ r·(n×ω) is the support value of the core at
// time t along n + Δ n×ω. Hence the gap along the fixed n is at least
//
//   f(Δ) = base + Δ (v_B − v_A)·n − h_A(n + Δ n×ω_A) − h_B(−n − Δ n×ω_B) − radii − (K_A + K_B) Δ²/2,
//
// which is concave (support functions are convex), so a chord from a point with f >= 0 to one with f < 0
// crosses zero before f does, and f >= 0 at both ends of an interval implies f >= 0 throughout. No step can
// pass the first contact. Near contact f is exact to second order: convergence is quadratic where the
// approach speed is non-zero; where it is zero (grazing), the step is about √(2 gap / K).
#include "core/impact/advance.h"

#include <algorithm>
#include <cmath>

#include "core/impact/turning_bound.h"
#include "core/narrow/convex_pair.h"
#include "core/tolerance.h"

namespace touchstone::impact {
namespace {

// About half a second. Random motions have needed at most 600 steps (tests/core/impact_stress).
constexpr int step_cap = 5000;
constexpr int chord_cap = 40;
// The chord search ends when its interval is this small relative to the step, or the gap left at the step is
// this small relative to the gap: more gains nothing.
constexpr Wide step_tolerance = 0x1p-30, gap_share = 0x1p-10;
// Witness points across the normal by more than this · size are improved with the bodies pushed apart by
// push · size.
constexpr Wide across_tolerance = 0x1p-34, push = 0x1p-20;
// After this many steps along fixed directions, rotating ones are tried too.
constexpr int steps_before_turning = 4;
// Halvings of the interval in which a step along a rotating direction ceases to be proven: it is known to
// 2⁻¹², and what it falls short of is left to the next step.
constexpr int turning_halvings = 12;

Wide turned_support(const Core& c, const WideVec& d) {
  const WideVec local = c.frame.rotation.transpose() * d;
  return local.dot(support_local<Wide>(c, local));
}

// f(Δ) of the header comment. A plane has no support term of its own.
class GapBound {
 public:
  GapBound(const WideVec& n, Wide base, Wide radii) : n_(n), constant_(base - radii) {}
  void add(const Core& c, const MovingCore& m, Wide side) {
    Part& p = parts_[count_++];
    p.core = &c;
    p.direction = side * n_;
    p.turn = side * n_.cross(m.angular);
    slope_ -= side * m.linear.dot(n_);
    const Wide turn = p.turn.norm();
    lipschitz_ += c.reach * turn;
    curvature_ += core_curvature_along_fixed<Wide>(c.reach, m.angular.norm(), turn);
  }
  Wide operator()(Wide delta) const {
    Wide f = constant_ + slope_ * delta - curvature_ * delta * delta / 2;
    for (int i = 0; i < count_; ++i)
      f -= turned_support(*parts_[i].core, parts_[i].direction + delta * parts_[i].turn);
    return f;
  }
  /// Largest Δ <= end for which f >= 0 over [0, Δ] is proven. Precondition: f(0) > 0.
  Wide safe_step(Wide end) const {
    const Wide gap = (*this)(0), fall = lipschitz_ - slope_;
    if (!(fall > 0) || fall * end < gap) return end;
    Wide lo = std::min(end, gap / fall), hi = end, f_hi = (*this)(hi);
    if (f_hi >= 0) return end;
    Wide f_lo = (*this)(lo);
    if (!(f_lo > 0)) return lo;  // the first-order bound is exact here
    for (int i = 0; i < chord_cap && hi - lo > step_tolerance * lo && f_lo > gap_share * gap; ++i) {
      // The chord's zero is safe; the midpoint tightens the far end.
      const Wide chord = lo + (hi - lo) * (f_lo / (f_lo - f_hi)), middle = lo + (hi - lo) / 2;
      if (const Wide f = (*this)(chord); f >= 0) {
        lo = chord;
        f_lo = f;
      }
      if (middle <= lo) continue;
      if (const Wide f = (*this)(middle); f >= 0) {
        lo = middle;
        f_lo = f;
      } else {
        hi = middle;
        f_hi = f;
      }
    }
    return lo;
  }

 private:
  struct Part {
    const Core* core = nullptr;
    WideVec direction, turn;
  };
  WideVec n_;
  Wide constant_, slope_ = 0, lipschitz_ = 0, curvature_ = 0;
  Part parts_[2];
  int count_ = 0;
};

struct Snapshot {
  Separation s;
  Core a, b;  // b unused against a plane
};

// Upper bound of the gap: if GJK has not converged, the distance of its points.
Wide upper_bound(const Separation& s) {
  return s.outcome == Outcome::answered ? s.gap : std::max(s.gap, (s.b - s.a).norm());
}

// Largest step that turning_bound.h proves along a direction n that rotates with Ω. Moving an end costs two
// support points; computing the nearest points costs a hundred times that.
class TurningStep {
 public:
  TurningStep(const MovingCore& a, const MovingCore& b, const WideVec& n, const WideVec& turn, Wide t,
              Wide end)
      : a_(a), b_(b), n_(n), turn_(turn), t_(t), end_(end), s1_(std::max<Wide>(0, separation(0))) {
    const Wide speed = turn.norm(), far = std::max(offset(0).norm(), offset(end).norm());
    curvature_ = offset_curvature<Wide>(speed, far, (b.linear - a.linear).norm());
    for (const MovingCore* m : {&a, &b})
      curvature_ +=
          core_curvature<Wide>(m->start.reach, (m->angular - turn).norm(), speed, m->angular.norm());
  }
  /// `step`: proven already.
  Wide extend(Wide step) const {
    Wide far = 2 * step;
    for (; far < end_ && proven(far); far *= 2) step = far;
    far = std::min(far, end_);
    if (proven(far)) return far;
    for (int i = 0; i < turning_halvings; ++i) {
      const Wide middle = step + (far - step) / 2;
      (proven(middle) ? step : far) = middle;
    }
    return step;
  }

 private:
  WideVec offset(Wide h) const {
    return b_.start.frame.translation - a_.start.frame.translation + (t_ + h) * (b_.linear - a_.linear);
  }
  Wide separation(Wide h) const {
    const WideVec n = turned(n_, turn_, h);
    const auto support = [&](const MovingCore& m, const WideVec& d) {
      const WideVec local = turned(m.rotation, m.angular, t_ + h).transpose() * d;
      return local.dot(support_local<Wide>(m.start, local));
    };
    return n.dot(offset(h)) - support(a_, n) - support(b_, -n) - a_.start.radius - b_.start.radius;
  }
  bool proven(Wide h) const {
    const Wide s2 = separation(h);
    return s2 >= 0 && stays_apart<Wide>(curvature_, h, s1_, s2);
  }

  const MovingCore &a_, &b_;
  WideVec n_, turn_;
  Wide t_, end_, s1_, curvature_ = 0;
};

// A pair of bodies over time: its separation at t, and how far it may advance from there.
struct CorePair {
  const MovingCore &a, &b;
  WideVec origin(Wide t) const { return a.start.frame.translation + t * a.linear; }
  Snapshot look(Wide t) const {
    const WideVec origin = this->origin(t);
    Snapshot x{{}, at_time(a, t, origin), at_time(b, t, origin)};
    x.s = narrow::separate_convex(x.a, x.b);
    return x;
  }
  Wide step(const Snapshot& x, Wide end) const {
    const WideVec& n = x.s.normal;
    GapBound f(n, n.dot(x.b.frame.translation - x.a.frame.translation), x.a.radius + x.b.radius);
    f.add(x.a, a, 1);
    f.add(x.b, b, -1);
    return f(0) > 0 ? f.safe_step(end) : 0;
  }
  // Nearest points of bodies that nearly touch: the bodies are pushed apart along n, which does not change
  // the points but makes the distance long enough to have a direction.
  void improve_points(Separation& s, Wide t) const {
    const WideVec d = s.b - s.a;
    if ((d - d.dot(s.normal) * s.normal).norm() <= across_tolerance * s.size) return;
    const WideVec origin = this->origin(t), away = push * s.size * s.normal;
    Core pushed = at_time(b, t, origin);
    pushed.frame.translation += away;
    const Separation x = narrow::separate_convex(at_time(a, t, origin), pushed);
    if (x.outcome == Outcome::answered) {
      s.a = x.a;
      s.b = x.b - away;
    }
  }
  // Extends the step along a direction that rotates with a body, or continues as it has rotated since the
  // last look.
  Wide extend_step(const Snapshot& x, Wide t, Wide end, Wide step, const WideVec& seen) const {
    for (const WideVec* turn : {&a.angular, &b.angular, &seen})
      if (step > 0 && step < end && !turn->isZero(0))
        step = TurningStep(a, b, x.s.normal, *turn, t, end).extend(step);
    return step;
  }
};

struct PlanePair {
  const MovingCore& a;
  const narrow::WidePlane& plane;
  WideVec origin(Wide) const { return WideVec::Zero(); }
  Snapshot look(Wide t) const {
    Snapshot x{{}, at_time(a, t, WideVec::Zero()), {}};
    x.s = narrow::convex_plane(x.a, plane);
    return x;
  }
  Wide step(const Snapshot& x, Wide end) const {
    const WideVec& n = x.s.normal;
    GapBound f(n, -n.dot(x.a.frame.translation) - plane.offset, x.a.radius);
    f.add(x.a, a, 1);
    return f(0) > 0 ? f.safe_step(end) : 0;
  }
  void improve_points(Separation&, Wide) const {}
  // The direction is the plane's normal, which is fixed.
  Wide extend_step(const Snapshot&, Wide, Wide, Wide step, const WideVec&) const { return step; }
};

// Rounds t to double: downwards, so that it is not late, unless the bodies move so fast that only the next
// double is in contact to the required accuracy. (At |w| = 500 they rotate by 6e-14 between consecutive
// doubles.)
template <class P>
ImpactAnswer hit(const P& pair, Wide t, Separation s, Wide target, const Goal& goal, int steps) {
  ImpactAnswer r;
  r.steps = steps;
  r.separation = static_cast<double>(s.gap);
  r.clear_until = static_cast<double>(t);
  r.normal_ab = s.normal.template cast<double>();
  const WideVec origin = pair.origin(t);
  pair.improve_points(s, t);
  r.witness_w = {(s.a + origin).template cast<double>(), (s.b + origin).template cast<double>()};
  double d = static_cast<double>(t);
  if (static_cast<Wide>(d) > t) d = std::nextafter(d, 0.0);
  r.toi = r.clear_until = d;
  if (static_cast<Wide>(d) == t) return r;
  const Wide below = upper_bound(pair.look(d).s);
  r.separation = static_cast<double>(below);
  if (below <= target) return r;
  const double next = std::nextafter(d, 1.0);
  if (const Wide above = pair.look(next).s.gap; abs(above) < std::min(below, Wide(goal.accuracy))) {
    r.toi = next;
    r.separation = static_cast<double>(above);
  }
  return r;
}

template <class P>
Advance run(const P& pair, Wide t_start, const Goal& goal) {
  Advance out;
  ImpactAnswer& r = out.answer;
  Wide t = t_start, last_time = t_start;
  WideVec last_normal = WideVec::Zero();
  for (r.steps = 0; r.steps < step_cap; ++r.steps) {
    Snapshot x = pair.look(t);
    // Bounds that have not met are still bounds: the plane proves the next step, and the points decide what
    // is contact.
    const bool known = x.s.outcome == Outcome::answered;
    x.s.gap = upper_bound(x.s);
    r.clear_until = static_cast<double>(t);
    r.separation = static_cast<double>(x.s.gap);
    const Wide target = known ? tolerance::impact_gap_factor * x.s.size : Wide(goal.accuracy);
    if (x.s.gap <= target) return {hit(pair, t, x.s, target, goal, r.steps)};
    if (t >= goal.end) return out;
    if (r.clear_until > t) r.clear_until = std::nextafter(r.clear_until, 0.0);
    if (x.s.gap > goal.leave && r.clear_until > t_start) {
      out.gap_opened = true;
      return out;
    }
    Wide step = pair.step(x, goal.end - t);
    if (r.steps >= steps_before_turning) {
      const WideVec seen =
          t > last_time ? WideVec(last_normal.cross(x.s.normal) / (t - last_time)) : WideVec(WideVec::Zero());
      step = pair.extend_step(x, t, goal.end - t, step, seen);
    }
    last_time = t;
    last_normal = x.s.normal;
    if (step >= goal.end - t) {
      t = goal.end;
      continue;
    }
    if (!(t + step > t)) break;  // the gap is positive, but t has no finer resolution
    t += step;
  }
  r.outcome = Outcome::not_converged;
  return out;
}

}  // namespace

MovingCore moving_core(const Core& start, const Motion& motion) {
  return {start, start.frame.rotation, motion.linear.cast<Wide>(), motion.angular.cast<Wide>()};
}

Core at_time(const MovingCore& c, Wide t, const WideVec& origin) {
  Core r = c.start;
  r.frame.rotation = turned(c.rotation, c.angular, t);
  r.frame.translation = (c.start.frame.translation - origin) + t * c.linear;
  return r;
}

Advance advance(const MovingCore& a, const MovingCore& b, Wide t_start, const Goal& goal) {
  return run(CorePair{a, b}, t_start, goal);
}

Advance advance(const MovingCore& a, const narrow::WidePlane& plane, Wide t_start, const Goal& goal) {
  return run(PlanePair{a, plane}, t_start, goal);
}

}  // namespace touchstone::impact
