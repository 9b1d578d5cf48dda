// How far the pair may go along one direction. With n fixed in the world, every pair of core points has a
// separation along n whose second derivative is at most
//
//   K = ρ_A |ω_A| |n×ω_A| + ρ_B |ω_B| |n×ω_B|,   ρ: distance of the core from its axis of rotation,
//
// since the acceleration ω×(ω×r) is ω² r_perp long and perpendicular to ω. So each of them, and with them
// their minimum s, lies on an interval of length h above the chord of its ends less K x (h − x)/2. From s1
// and s2 at the ends, both beyond the error e of s, the minimum is beyond e when
//
//   K h²/2 <= (√(s1 − e) + √(s2 − e))².
//
// The ends are where s is evaluated anew, so the bound is exact at contact: near it a step is as long as the
// root of s along n, found by Newton's method with the second derivative of the present points, and the gap
// left over is that of the direction alone, quadratic in the step. A turning core also stays inside what it
// sweeps as a body of revolution, whatever the angle: that bounds s by a line.
#pragma once

#include "core/ccd/fast/look.h"

namespace touchstone::ccd::fast {

struct Followed {
  Spot spot;           // no contact up to its time: s >= error there
  bool clear = false;  // none up to the end either
};

namespace detail {

inline constexpr int follow_cap = 40, chain_cap = 6;

class Follower {
 public:
  Follower(const Sweep& w, const Vec& n, double end) : w_(w), n_(n), end_(end) {
    approach_ = n.dot(w.velocity());
    for (const Mover* m : {&w.a(), &w.b()}) {
      if (!m->turns) continue;
      const double turn = n.cross(m->angular).norm();
      curvature_ += m->off_axis * m->speed * turn, jerk_ += m->off_axis * m->speed * m->speed * turn;
    }
    curvature_ *= 1 + 0x1p-40;
  }

  Followed run(const Spot& from, const Side& side) {
    spot_ = from, side_ = side;
    const double s0 = side.s;
    for (int i = 0; i < chain_cap; ++i) {
      const double before = spot_.t;
      if (revolve()) return {spot_, true};
      if (spot_.t >= end_ || step()) return {spot_, true};
      // Farther along the same direction while that gains much.
      if (!(spot_.t > before) || side_.s < 0.3 * s0 || side_.s < 64 * spot_.error) break;
    }
    return {spot_, false};
  }

 private:
  static double margin(const Spot& x) { return x.error * 1.25; }

  void go(double t) { spot_ = w_.at(t, spot_.precise), side_ = w_.along(spot_, n_); }

  // By the bodies of revolution; true: clear to the end.
  bool revolve() {
    if (!w_.turns()) return false;
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
    const double t = spot_.t + s / -approach_ * (1 - 0x1p-40);
    if (t > spot_.t) go(std::min(t, end_));
    return false;
  }

  double rate() const {
    return approach_ + n_.cross(w_.b().angular).dot(side_.pb) - n_.cross(w_.a().angular).dot(side_.pa);
  }
  double acceleration() const {
    const auto of = [&](const Mover& m, const Vec& p) {
      return m.turns ? m.angular.dot(p) * m.angular.dot(n_) - m.speed * m.speed * n_.dot(p) : 0.0;
    };
    return of(w_.b(), side_.pb) - of(w_.a(), side_.pa);
  }

  // First h > 0 at which s + d h + a h²/2 is `aim`; infinite if there is none.
  static double root(double s, double d, double a, double aim) {
    const double c = s - aim, disc = d * d - 2 * a * c;
    if (!(c > 0)) return 0;
    if (disc < 0) return std::numeric_limits<double>::infinity();
    const double q = -d + std::sqrt(disc);
    return q > 0 ? 2 * c / q : std::numeric_limits<double>::infinity();
  }

  double certain_step(double e2) const {
    if (!(curvature_ > 0)) return std::numeric_limits<double>::infinity();
    const double e1 = std::max(0.0, side_.s - margin(spot_));
    return (std::sqrt(e1) + std::sqrt(std::max(e2, 0.0))) * std::sqrt(2 / curvature_);
  }

  double proposal(double h_end) const {
    const double s = side_.s, d = rate(), a = acceleration(), goal = 3 * spot_.error;
    double h = std::min(root(s, d, a, goal), h_end);
    // What the model leaves out: vertices that take over, and the third derivative.
    if (w_.turns()) h = std::min(root(s, d, a, goal + std::min(s / 16, jerk_ * h * h * h)), h_end);
    const double e2 = s + d * h + a * h * h / 2;
    return std::min(h, certain_step(e2));
  }

  // To a later time that is proven; true: the end was reached.
  bool step() {
    const double h_end = end_ - spot_.t, s1 = side_.s, e1 = s1 - margin(spot_), d = rate();
    if (!(e1 > 0)) return false;
    double h = proposal(h_end);
    for (int i = 0; i < follow_cap; ++i) {
      const double t = h >= h_end ? end_ : spot_.t + h;
      if (!(t > spot_.t)) return false;
      const Spot y = w_.at(t, spot_.precise);
      const Side side = w_.along(y, n_);
      const double e2 = side.s - margin(y), length = t - spot_.t;
      const double room = e2 < 0 ? -1 : std::sqrt(e1) + std::sqrt(e2);
      if (room >= 0 && curvature_ * length * length / 2 <= room * room * (1 - 0x1p-40)) {
        spot_ = y, side_ = side;
        return t >= end_;
      }
      if (e2 < 0) {
        const double q = (side.s - s1 - d * length) / (length * length);
        const double r = root(s1, d, 2 * q, 2 * spot_.error + (i > 3 ? s1 / 4 : 0));
        h = std::clamp(r, 0.05 * length, 0.98 * length);
      } else {
        h = std::min(0.95 * certain_step(e2), 0.9 * length);
      }
    }
    return false;
  }

  const Sweep& w_;
  Vec n_;
  double end_, approach_ = 0, curvature_ = 0, jerk_ = 0;
  Spot spot_;
  Side side_;
};

}  // namespace detail

/// From a spot with `side` along n, side.s > error.
inline Followed follow(const Sweep& w, const Vec& n, const Spot& from, const Side& side, double end) {
  return detail::Follower(w, n, end).run(from, side);
}

}  // namespace touchstone::ccd::fast
