// The least depth where EPA cannot separate the candidates: minima along a curve (nearly coaxial round
// bodies) or a surface (nearly concentric spheroids), in which the depth differs by less than any affordable
// polytope resolves.
//
// Search: directions are written as (azimuth θ, polar angle α) about the axis of a round body. φ(θ) = min
// over α of the height h(n(θ, α)) is a function of one variable with few minima. Both minimisations are
// samples followed by golden sections, so kinks do no harm, and the search resolves differences of φ down to
// rounding. What is proven globally stays what EPA proved (`lower`); samples of φ every 7.5° are what speaks
// for the rest.
//
// Witness: one proximal step. EPA is asked for the boundary point nearest to s·x, x the foot of the found
// plane, 0 < s < 1. Near x that point is isolated even when the origin's nearest points form a ring, so EPA
// closes; its normal m1 satisfies h(m1) <= h(m) (1 − s (1 − m·m1)), and a fixed point is a local minimum.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/narrow/epa.h"

namespace touchstone::narrow {

namespace detail {

/// Least point of f in [lo, hi] by golden section to the arithmetic's resolution; returns (argument, value).
template <class R, class F>
std::pair<R, R> golden(R lo, R hi, F&& f) {
  constexpr int sections = 80;  // 0.618^80 = 2e-17
  const R ratio = (std::sqrt(R(5)) - 1) / 2;
  R x1 = hi - ratio * (hi - lo), x2 = lo + ratio * (hi - lo), f1 = f(x1), f2 = f(x2);
  for (int i = 0; i < sections; ++i) {
    if (f1 <= f2) {
      hi = x2, x2 = x1, f2 = f1, x1 = hi - ratio * (hi - lo), f1 = f(x1);
    } else {
      lo = x1, x1 = x2, f1 = f2, x2 = lo + ratio * (hi - lo), f2 = f(x2);
    }
  }
  return f1 <= f2 ? std::pair{x1, f1} : std::pair{x2, f2};
}

/// Column of the frame about which a core is (most nearly) round; -1 when it has no such axis.
template <class R>
int round_axis(const ConvexCore<R>& c) {
  if (c.kind == CoreKind::segment || c.kind == CoreKind::cylinder || c.kind == CoreKind::cone) return 2;
  if (c.kind != CoreKind::ellipsoid) return -1;
  const V3<R>& s = c.size;
  const R d0 = std::abs(s[1] - s[2]), d1 = std::abs(s[2] - s[0]), d2 = std::abs(s[0] - s[1]);
  return d0 <= d1 && d0 <= d2 ? 0 : (d1 <= d2 ? 1 : 2);
}

template <class R>
class MeridianSearch {
 public:
  MeridianSearch(const ConvexCore<R>& a, const ConvexCore<R>& b, const V3<R>& axis)
      : a_(a), b_(b), w_(axis.normalized()), u_(w_.unitOrthogonal()), v_(w_.cross(u_)) {}

  V3<R> direction(R theta, R alpha) const {
    return std::sin(alpha) * (std::cos(theta) * u_ + std::sin(theta) * v_) + std::cos(alpha) * w_;
  }
  R height(const V3<R>& n) const { return -n.dot(difference_support<R>(a_, b_, -n).w); }

  /// Least direction and height.
  std::pair<V3<R>, R> least() const {
    std::array<std::pair<R, R>, azimuths> at;  // α and φ at θ_i
    for (int i = 0; i < azimuths; ++i) at[static_cast<std::size_t>(i)] = whole_meridian(i * step_theta);
    // On an exact ring every sample is a minimum up to rounding; four of them are then as good as all.
    constexpr std::size_t followed = 4;
    std::vector<std::pair<R, int>> valleys;
    for (int i = 0; i < azimuths; ++i) {
      const R phi = at[static_cast<std::size_t>(i)].second;
      const R before = at[static_cast<std::size_t>((i + azimuths - 1) % azimuths)].second;
      const R after = at[static_cast<std::size_t>((i + 1) % azimuths)].second;
      if (phi <= before && phi <= after) valleys.emplace_back(phi, i);
    }
    std::sort(valleys.begin(), valleys.end());
    std::pair<V3<R>, R> best{V3<R>::UnitX(), std::numeric_limits<R>::infinity()};
    for (std::size_t k = 0; k < std::min(followed, valleys.size()); ++k) {
      const int i = valleys[k].second;
      const R theta = golden<R>((i - 1) * step_theta, (i + 1) * step_theta, [&](R t) {
                        return whole_meridian(t).second;
                      }).first;
      const auto [x, h] = whole_meridian(theta);
      if (h < best.second) best = {direction(theta, x).normalized(), h};
    }
    return best;
  }

 private:
  static constexpr int azimuths = 48, polars = 48;
  static constexpr R step_theta = 2 * std::numbers::pi_v<R> / azimuths,
                     step_alpha = std::numbers::pi_v<R> / polars;

  // Two round bodies have two families of minima on a meridian, which may lie close and change places: every
  // valley of the samples is followed down.
  std::pair<R, R> whole_meridian(R theta) const {
    const auto h = [&](R x) { return height(direction(theta, x)); };
    std::array<R, polars + 1> sample;
    for (int k = 0; k <= polars; ++k) sample[static_cast<std::size_t>(k)] = h(k * step_alpha);
    std::pair<R, R> best{0, std::numeric_limits<R>::infinity()};
    for (int k = 0; k <= polars; ++k) {
      const R x = sample[static_cast<std::size_t>(k)];
      if ((k > 0 && sample[static_cast<std::size_t>(k - 1)] < x) ||
          (k < polars && sample[static_cast<std::size_t>(k + 1)] < x))
        continue;
      if (const auto low = golden<R>((k - 1) * step_alpha, (k + 1) * step_alpha, h); low.second < best.second)
        best = low;
    }
    return best;
  }

  const ConvexCore<R>&a_, &b_;
  V3<R> w_, u_, v_;
};

/// The proximal step from direction n (A to B).
template <class R>
EpaResult<R> proximal(const V3<R>& n, R share, const ConvexCore<R>& a, const ConvexCore<R>& b, R size,
                      R tolerance) {
  constexpr int budget = 2000;
  const auto height = [&](const V3<R>& m) { return -m.dot(difference_support<R>(a, b, -m).w); };
  EpaResult<R> step;
  const V3<R> shift = -n * (height(n) * share);  // D's outward normal is −n
  ConvexCore<R> moved = b;
  moved.frame.translation -= shift;
  const GjkResult<R> g = gjk<R>(a, moved, tolerance, tolerance / 4, budget);
  if (g.status != GjkStatus::enclosed && g.status != GjkStatus::touching) return step;
  step = Epa<R>(a, moved, size, tolerance).run(g, budget);
  step.b += shift, step.upper = height(step.normal);
  return step;
}

}  // namespace detail

/// Improves e in place; e.status becomes closed at a local minimum. `lower` is kept: it is what EPA proved of
/// all directions.
template <class R>
void descend(EpaResult<R>& e, const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance) {
  for (const ConvexCore<R>* c : {&a, &b}) {
    const int axis = detail::round_axis(*c);
    if (axis < 0) continue;
    const auto [n, h] = detail::MeridianSearch<R>(a, b, c->frame.rotation.col(axis)).least();
    if (h < e.upper) e.upper = h, e.normal = n;
  }
  for (const R share : {R(0.25), R(0.5), R(0.75), R(0.9375)}) {
    const EpaResult<R> step = detail::proximal<R>(e.normal, share, a, b, size, tolerance);
    const R depth = std::min(step.upper, e.upper);
    // EPA's own tolerance, seen through the shift, is paid once in height and once in length.
    if (step.status == EpaStatus::broken || std::abs((step.b - step.a).norm() - depth) > 4 * tolerance)
      continue;
    e.a = step.a, e.b = step.b, e.status = EpaStatus::closed;
    if (step.upper <= e.upper) e.upper = step.upper, e.normal = step.normal;
    return;
  }
}

}  // namespace touchstone::narrow
