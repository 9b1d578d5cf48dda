// At time t let n be the unit direction of least distance, d the gap along it. A point r of body A (relative
// to its origin) stands at time t+Δ, along n, at most at
//     n·(x + Δ v) + (n + Δ n×ω)·r + ½Δ²|ω|²|r|
// (Taylor: n·(ω×r) = (n×ω)·r, and the second derivative of a rotating point is at most |ω|²|r|). Maximising
// over r, and likewise for B, the gap along the fixed n at t+Δ is at least
//     G(Δ) = d + Δ n·(v_B − v_A) − [h_A(n + Δ n×ω_A) − h_A(n)] − [h_B(−n − Δ n×ω_B) − h_B(−n)] −
//     ½Δ²(|ω_A|²ρ_A + |ω_B|²ρ_B)
// with h the support functions at time t and ρ the bounding radii. G is concave, since support functions are
// convex, and G(0) = d > 0. So G(Δ) >= 0 proves that the bodies are apart on all of [t, t+Δ]. A second bound,
// of first order, is better for many turns: the gap closes no faster than n·(v_A − v_B) + |n×ω_A|ρ_A +
// |n×ω_B|ρ_B. The longer step is taken.
#include "core/ccd/advancement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ccd/pose_in_motion.h"
#include "core/tolerance.h"

namespace touchstone {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double u = std::numeric_limits<double>::epsilon() / 2;

// A body as seen along n at time t: what its own motion can take from the gap.
class Side {
 public:
  // `sign` +1 for A (support along n), −1 for B (along −n).
  Side(const MovingShape& s, const Pose& now, const Vec3& n, double sign)
      : shape_(s.shape),
        n_(sign * n),
        turn_((sign * n).cross(s.motion.angular)),
        rotates_(!s.motion.angular.isZero(0)),
        radius_(rotates_ ? bounding_radius(*s.shape) : 0),
        linear_(sign * n.dot(s.motion.linear)) {
    if (!rotates_) return;
    rotation_ = rotation_matrix(now.rotation);
    start_ = support_value(n_);
    curvature_ = s.motion.angular.squaredNorm() * radius_ / 2;
  }
  // Upper bound of how far the support has come towards the other body after Δ.
  double second_order(double delta) const {
    double advance = delta * linear_;
    if (rotates_) advance += support_value(n_ + delta * turn_) - start_ + delta * delta * curvature_;
    return advance;
  }
  double first_order_rate() const { return linear_ + (rotates_ ? turn_.norm() * radius_ : 0); }
  double radius() const { return radius_; }

 private:
  double support_value(const Vec3& d) const {
    const Vec3 local = rotation_.transpose() * d;
    return std::visit(
        [&](const auto& s) -> double {
          if constexpr (requires { support(s, local); })
            return support(s, local).dot(local);
          else
            return inf;  // meshes and half-spaces do not rotate
        },
        *shape_);
  }
  const Shape* shape_;
  Vec3 n_, turn_;
  bool rotates_;
  double radius_, linear_, start_ = 0, curvature_ = 0;
  Mat3 rotation_ = Mat3::Identity();
};

// Longest Δ <= room with d − (advance of both) >= 0, from below: bisection on the concave G keeps a proven
// left end.
double second_order_step(const Side& a, const Side& b, double d, double room) {
  const auto g = [&](double delta) { return d - a.second_order(delta) - b.second_order(delta); };
  if (g(room) >= 0) return room;
  double lo = 0, hi = room, g_lo = d, g_hi = g(room);
  for (int i = 0; i < 60 && hi - lo > 1e-3 * hi; ++i) {
    // Between regula falsi, which on a concave function stays left of the root, and the middle.
    const double chord = lo + (hi - lo) * (g_lo / (g_lo - g_hi));
    const double mid = i % 2 == 0 ? chord : lo + (hi - lo) / 2;
    const double g_mid = g(mid);
    if (g_mid >= 0)
      lo = mid, g_lo = g_mid;
    else
      hi = mid, g_hi = g_mid;
  }
  return lo;
}

// How long the bodies stay apart for certain, given gap d along n; at most `room`.
double safe_step(const Side& a, const Side& b, double d, double room) {
  const double rate = a.first_order_rate() + b.first_order_rate();
  const double first = rate <= 0 ? inf : d / rate;
  if (first >= room) return inf;
  if (a.radius() == 0 && b.radius() == 0) return first;
  const double second = second_order_step(a, b, d, room);
  return second >= room ? inf : std::max(first, second);
}

}  // namespace

TimeOfImpact advance(const MovingShape& a, const MovingShape& b, double scale) {
  const double target = tolerance::impact_gap_factor * scale;
  // Rounding of poses, of the direction, and of the support values in a step: taken off the gap before each
  // step.
  const double slack = tolerance::impact_slack_factor * u * scale;
  TimeOfImpact out;
  double t = 0;
  for (out.steps = 1; out.steps <= tolerance::impact_step_cap; ++out.steps) {
    const Pose pa = pose_in_motion(a.pose, a.motion, t), pb = pose_in_motion(b.pose, b.motion, t);
    const DistanceAnswer d = distance({a.shape, pa}, {b.shape, pb});
    out.t = t, out.gap = d.distance, out.normal = d.normal, out.witness = d.witness;
    if (d.outcome != Outcome::answered) {
      out.outcome = d.outcome;
      return out;
    }
    if (d.distance <= target) {
      out.hit = true;
      return out;
    }
    const double room = 1 - t;
    const Side side_a(a, pa, d.normal, 1), side_b(b, pb, d.normal, -1);
    const double step = safe_step(side_a, side_b, d.distance - slack - d.error_bound, room);
    if (step > room) {  // apart to the end
      out.t = 1;
      return out;
    }
    const double next = t + step;
    if (!(next > t))
      break;  // the step is below the resolution of time: the gap cannot be brought to the target
    t = std::min(1.0, next);
  }
  // Time has no finer value, or the cap is reached. The first is a hit as far as time can tell: the next
  // double after t is not proven free.
  if (out.steps > tolerance::impact_step_cap) {
    out.outcome = Outcome::not_converged;
    return out;
  }
  out.hit = true;
  return out;
}

}  // namespace touchstone
