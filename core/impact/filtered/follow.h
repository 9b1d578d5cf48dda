// How far the pair may advance along one direction: turning_bound.h, e being the error of the separation s.
//
// s is evaluated afresh at the ends, so the bound is exact at contact: near it a step is as long as the root
// of s, found by Newton's method with the second derivative of the present points, and the remaining gap is
// due to the direction only. It is quadratic in the step if the direction follows the features that define
// it: rotating with a face or an edge of one body, or perpendicular to an edge of each. (If the direction is
// fixed in the world, the far corner of a rotating face becomes the next support point, and steps shrink by a
// constant factor.) The rounding of the rotated n counts as one of Ω: 16 u / h is added to it.
//
// A rotating core also stays inside the body of revolution that it sweeps, at any angle: this bounds s along
// a fixed direction by a line.
#pragma once

#include "core/impact/filtered/look.h"
#include "core/impact/turning_bound.h"
#include "core/math/axis_rotation.h"

namespace touchstone::impact::filtered {

struct Followed {
  Spot spot;           // no contact up to its time; s >= error there
  bool clear = false;  // no contact up to the end
};

namespace detail {

inline constexpr int follow_cap = 40, chain_cap = 6;
/// Cover the rounding of a bound by far.
inline constexpr double round_up = 1 + 0x1p-40, round_down = 1 - 0x1p-40;
/// A step is followed by another along the same direction while the separation is at least this share of the
/// first, and this many errors: it is cheaper than a look only where it gains much.
inline constexpr double chain_share = 0.3, chain_errors = 64;
/// Rounding of a rotated unit vector, in u.
inline constexpr int normal_rounding = 16;
/// A step that is too long is shortened to the root of a parabola through its ends, but to these shares of
/// its length at least and at most; to half of it after the first few trials.
inline constexpr double shortest_share = 0.05, longest_share = 0.98;
inline constexpr int trials_by_root = 3;
/// A step that is not proven, though its end is apart: a bit less than the bound allows, and shorter than it
/// was.
inline constexpr double certain_share = 0.95, shrinking_share = 0.9;

class Follower {
 public:
  Follower(const Sweep& w, const Spot& from, const View& view, const Vec& turn, double end)
      : w_(w), n_(view.normal), end_(end), spot_(from), side_(view.side) {
    approach_ = n_.dot(w.velocity());
    for (const Mover* m : {&w.a(), &w.b()}) {
      if (!m->turns) continue;
      const double across = n_.cross(m->angular).norm();
      still_ += core_curvature_along_fixed(m->off_axis, m->speed, across);
      jerk_ += m->off_axis * m->speed * m->speed * across;
    }
    still_ *= round_up;
    if (!turn.isZero(0)) try_turn(turn);
  }

  Followed run() {
    const double s0 = side_.s;
    for (int i = 0; i < chain_cap; ++i) {
      const double before = spot_.t;
      if (revolve()) return {spot_, true};
      if (spot_.t >= end_ || step()) return {spot_, true};
      // Continues along the same direction while that gains much.
      if (!(spot_.t > before) || side_.s < chain_share * s0 || side_.s < chain_errors * spot_.error) break;
    }
    return {spot_, false};
  }

 private:
  static double margin(const Spot& x) { return x.error * 1.25; }

  // A rotating direction is used if the whole Newton step is then proven.
  void try_turn(const Vec& turn) {
    const double still = rate();
    turn_ = turn;
    turn_speed_ = turn.norm();
    far_ = std::max(spot_.offset.norm(), offset_at(end_));
    const double v = w_.velocity().norm(), turning = rate();
    const double fastest = std::max(turning * turning, still * still);
    if (side_.s * curvature(1) <= 2 * fastest) {
      jerk_ = turn_speed_ * turn_speed_ * (turn_speed_ * far_ + 3 * v);
      for (const Mover* m : {&w_.a(), &w_.b()})
        jerk_ += m->body.reach * std::pow(turn_speed_ + m->speed, 2) * (m->angular - turn).norm();
    } else {
      turn_ = Vec::Zero();
      turn_speed_ = 0;
    }
  }
  bool turning() const { return turn_speed_ > 0; }
  double offset_at(double t) const { return (spot_.offset + (t - spot_.t) * w_.velocity()).norm(); }

  // K for a step h.
  double curvature(double h) const {
    if (!turning()) return still_;
    const double slack = normal_rounding * u<double> / h, speed = turn_speed_ + slack;
    double k = offset_curvature(speed, far_, w_.velocity().norm());
    for (const Mover* m : {&w_.a(), &w_.b()})
      k += core_curvature(m->body.reach, (m->angular - turn_).norm() + slack, speed, m->speed);
    return k * round_up;
  }

  Vec normal_at(double t) const {
    if (!turning()) return n_;
    return rotated<double>(n_, turn_ / turn_speed_, turn_speed_ * (t - spot_.t));
  }

  void move_to(double t) {
    spot_ = w_.at(t, spot_.precise);
    side_ = w_.along(spot_, n_);
  }

  // Steps by the bodies of revolution; true: clear to the end.
  bool revolve() {
    if (!w_.turns() || turning()) return false;
    double s = n_.dot(spot_.offset) - w_.radii();
    for (int k = 0; k < 2; ++k) {
      const Mover& m = k == 0 ? w_.a() : w_.b();
      const Vec d = k == 0 ? n_ : Vec(-n_);
      if (!m.turns) {
        s -= d.dot(k == 0 ? side_.pa : side_.pb);
        continue;
      }
      const double c = d.dot(m.axis);
      s -= (c > 0 ? c * m.up : -c * m.down) + d.cross(m.axis).norm() * m.off_axis;
    }
    s -= 2 * spot_.error;
    if (!(s > 0)) return false;
    const double h = end_ - spot_.t;
    if (s + approach_ * h > 0) return true;
    const double t = spot_.t + s / -approach_ * round_down;
    if (t > spot_.t) move_to(std::min(t, end_));
    return false;
  }

  // For the present points: n·w and its derivatives, w = b − a.
  Vec gap_velocity() const {
    return w_.velocity() + w_.b().angular.cross(side_.pb) - w_.a().angular.cross(side_.pa);
  }
  double rate() const {
    const double r = n_.dot(gap_velocity());
    return turning() ? r + turn_.cross(n_).dot(spot_.offset + side_.pb - side_.pa) : r;
  }
  double acceleration() const {
    const auto of = [&](const Mover& m, const Vec& p) {
      return m.turns ? m.angular.dot(p) * m.angular.dot(n_) - m.speed * m.speed * n_.dot(p) : 0.0;
    };
    double r = of(w_.b(), side_.pb) - of(w_.a(), side_.pa);
    if (turning()) {
      const Vec first = turn_.cross(n_);
      r += 2 * first.dot(gap_velocity()) + turn_.cross(first).dot(spot_.offset + side_.pb - side_.pa);
    }
    return r;
  }

  // First h > 0 at which s + d h + a h²/2 equals `aim`; infinite if there is none.
  static double root(double s, double d, double a, double aim) {
    const double c = s - aim, disc = d * d - 2 * a * c;
    if (!(c > 0)) return 0;
    if (disc < 0) return std::numeric_limits<double>::infinity();
    const double q = -d + std::sqrt(disc);
    return q > 0 ? 2 * c / q : std::numeric_limits<double>::infinity();
  }

  double certain_step(double e2, double h) const {
    const double k = curvature(h);
    if (!(k > 0)) return std::numeric_limits<double>::infinity();
    const double e1 = std::max(0.0, side_.s - margin(spot_));
    return (std::sqrt(e1) + std::sqrt(std::max(e2, 0.0))) * std::sqrt(2 / k);
  }

  double proposal(double h_end, double d) const {
    const double s = side_.s, a = acceleration(), goal = 1.75 * spot_.error;
    double h = std::min(root(s, d, a, goal), h_end);
    // Not in the model: vertices that take over, and the third derivative.
    if (w_.turns()) h = std::min(root(s, d, a, goal + std::min(s / 16, jerk_ * h * h * h)), h_end);
    const double e2 = s + d * h + a * h * h / 2;
    return std::min(h, certain_step(e2, h));
  }

  // Advances to a later time that is proven; true: the end was reached.
  bool step() {
    const double h_end = end_ - spot_.t, s1 = side_.s, e1 = s1 - margin(spot_), d = rate();
    if (!(e1 > 0)) return false;
    double h = proposal(h_end, d);
    // A step converges quadratically, so what it leaves may be within the error of a rounded rotation.
    const bool precise = spot_.precise || s1 * s1 < 1024 * spot_.error * (s1 + spot_.offset.norm());
    for (int i = 0; i < follow_cap; ++i) {
      const double t = h >= h_end ? end_ : spot_.t + h;
      if (!(t > spot_.t)) return false;
      const Spot y = w_.at(t, precise);
      const Vec n = normal_at(t);
      const Side side = w_.along(y, n);
      const double e2 = side.s - margin(y), length = t - spot_.t;
      if (e2 >= 0 && stays_apart(curvature(length), length, e1, e2, round_down)) {
        spot_ = y;
        side_ = side;
        n_ = n;
        return t >= end_;
      }
      if (e2 < 0) {
        const double q = (side.s - s1 - d * length) / (length * length);
        const bool late = i > trials_by_root;
        const double r = root(s1, d, 2 * q, 2 * spot_.error + (late ? s1 / 4 : 0));
        h = std::clamp(r, shortest_share * length, (late ? 0.5 : longest_share) * length);
      } else {
        h = std::min(certain_share * certain_step(e2, length), shrinking_share * length);
      }
    }
    return false;
  }

  const Sweep& w_;
  Vec n_, turn_ = Vec::Zero();
  double end_, turn_speed_ = 0, far_ = 0, approach_ = 0, still_ = 0, jerk_ = 0;
  Spot spot_;
  Side side_;
};

}  // namespace detail

/// Starts from a spot with view.side along view.normal and view.side.s > error. `turn`: Ω of the features
/// that define the normal.
inline Followed follow(const Sweep& w, const Spot& from, const View& view, const Vec& turn, double end) {
  return detail::Follower(w, from, view, turn, end).run();
}

}  // namespace touchstone::impact::filtered
