// The least depth where EPA cannot separate the candidates: minima along a curve (nearly coaxial round
// bodies) or a surface (nearly concentric spheroids), on which the depth varies by less than any affordable
// polytope resolves.
//
// Search: directions are parametrised by azimuth θ and polar angle α about the axis of a round body. φ(θ) =
// min over α of the height h(n(θ, α)) is a function of one variable with few minima. Both minimisations
// sample the function and descend from the local minima of the samples (kinks do no harm), and resolve
// differences of φ down to rounding. Only EPA's bound (`lower`) is proven globally; beyond it, the evidence
// is samples of φ every 7.5°.
//
// Witness: one proximal step. EPA computes the boundary point nearest to s·x, where x is the foot of the
// plane found and 0 < s < 1. Near x that point is isolated even when the points nearest to the origin form a
// ring, so EPA closes; its normal m1 satisfies h(m1) <= h(m) (1 − s (1 − m·m1)), and a fixed point is a local
// minimum.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/narrow/extended/epa.h"

namespace touchstone::narrow::extended {

namespace detail {

/// Minimum of f in [lo, hi]; returns (argument, value). Brent 1973, ch. 5: a parabola through the three best
/// points where that shrinks the steps, golden sections elsewhere, so kinks do no harm. Departure: it also
/// ends when the values at both ends of the remaining interval exceed the minimum by no more than rounding;
/// for a smooth minimum this happens long before the arguments have converged.
template <class R, class F>
std::pair<R, R> least_between(R lo, R hi, R noise, F&& f) {
  constexpr int steps = 100;  // 0.618^100 = 1e-21
  constexpr R eps = std::numeric_limits<R>::epsilon();
  const R section = (3 - sqrt(R(5))) / 2, finest = eps * (hi - lo);
  R x = lo + section * (hi - lo), fx = f(x), f_lo = f(lo), f_hi = f(hi);
  R second = x, third = x, f_second = fx, f_third = fx, step = 0, before = 0;
  for (int i = 0; i < steps; ++i) {
    const R middle = (lo + hi) / 2;
    if (hi - lo <= 4 * finest || std::max(f_lo, f_hi) - fx <= noise) break;
    R p = (x - second) * (fx - f_third), q = (x - third) * (fx - f_second);
    R num = (x - third) * q - (x - second) * p, den = 2 * (q - p);
    if (den > 0) num = -num;
    den = abs(den);
    if (abs(num) < abs(den * before / 2) && num > den * (lo - x) && num < den * (hi - x)) {
      before = step;
      step = num / den;
    } else {
      before = x < middle ? hi - x : lo - x;
      step = section * before;
    }
    const R u = abs(step) >= finest ? x + step : x + (step > 0 ? finest : -finest), fu = f(u);
    if (fu <= fx) {
      (u < x ? hi : lo) = x;
      (u < x ? f_hi : f_lo) = fx;
      third = second;
      f_third = f_second;
      second = x;
      f_second = fx;
      x = u;
      fx = fu;
    } else {
      (u < x ? lo : hi) = u;
      (u < x ? f_lo : f_hi) = fu;
      if (fu <= f_second || second == x) {
        third = second;
        f_third = f_second;
        second = u;
        f_second = fu;
      } else if (fu <= f_third || third == x || third == second) {
        third = u;
        f_third = fu;
      }
    }
  }
  return {x, fx};
}

template <class R>
class MeridianSearch {
 public:
  MeridianSearch(const ConvexCore<R>& a, const ConvexCore<R>& b, const V3<R>& axis, R size)
      : a_(a),
        b_(b),
        noise_(rounding::wide_support_noise * std::numeric_limits<R>::epsilon() * size),
        w_(axis.normalized()),
        u_(w_.unitOrthogonal()),
        v_(w_.cross(u_)) {}

  V3<R> across(R theta) const { return cos(theta) * u_ + sin(theta) * v_; }
  V3<R> direction(R theta, R alpha) const { return sin(alpha) * across(theta) + cos(alpha) * w_; }
  R height(const V3<R>& n) const { return Difference<R>{a_, b_}.height(n); }

  /// Direction of least height, and that height.
  std::pair<V3<R>, R> least() const {
    std::array<std::pair<R, R>, azimuths> at;  // α and φ at θ_i
    for (int i = 0; i < azimuths; ++i) at[static_cast<std::size_t>(i)] = whole_meridian(i * step_theta);
    // On an exact ring every sample is a minimum up to rounding, and following four of them is enough.
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
      const R theta = least_between<R>((i - 1) * step_theta, (i + 1) * step_theta, noise_, [&](R t) {
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

  // Two round bodies have two families of minima on a meridian, which may lie close together and swap order:
  // every local minimum of the samples is followed.
  std::pair<R, R> whole_meridian(R theta) const {
    const V3<R> out = across(theta);
    const auto h = [&](R x) { return height(sin(x) * out + cos(x) * w_); };
    std::array<R, polars + 1> sample;
    for (int k = 0; k <= polars; ++k) sample[static_cast<std::size_t>(k)] = h(k * step_alpha);
    std::pair<R, R> best{0, std::numeric_limits<R>::infinity()};
    for (int k = 0; k <= polars; ++k) {
      const R x = sample[static_cast<std::size_t>(k)];
      if ((k > 0 && sample[static_cast<std::size_t>(k - 1)] < x) ||
          (k < polars && sample[static_cast<std::size_t>(k + 1)] < x))
        continue;
      if (const auto low = least_between<R>((k - 1) * step_alpha, (k + 1) * step_alpha, noise_, h);
          low.second < best.second)
        best = low;
    }
    return best;
  }

  const ConvexCore<R>&a_, &b_;
  R noise_;
  V3<R> w_, u_, v_;
};

/// Shares s of the way to the foot, tried in turn. The nearer to 1, the better is the point isolated, and the
/// flatter is what EPA has to resolve.
inline constexpr double proximal_shares[] = {0.25, 0.5, 0.75, 0.9375};

/// The proximal step from direction n (A to B).
template <class R>
EpaResult<R> proximal(const V3<R>& n, R share, const ConvexCore<R>& a, const ConvexCore<R>& b, R size,
                      R tolerance) {
  constexpr int budget = 2000;
  const Difference<R> d{a, b};
  EpaResult<R> step;
  const V3<R> shift = -n * (d.height(n) * share);  // D's outward normal is −n
  ConvexCore<R> moved = b;
  moved.frame.translation -= shift;
  const Distance<R> g = gjk<R>(a, moved, tolerance, tolerance / 4, budget);
  if (g.status != GjkStatus::enclosed && g.status != GjkStatus::touching) return step;
  step = Epa<R>(a, moved, size, tolerance).run(g, budget);
  step.b += shift;
  step.upper = d.height(step.normal);
  return step;
}

}  // namespace detail

/// Improves e in place; e.status becomes `closed` at a local minimum. `lower` is kept: it is what EPA proved
/// for all directions.
template <class R>
void descend(EpaResult<R>& e, const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance) {
  for (const ConvexCore<R>* c : {&a, &b}) {
    const int axis = on_core(*c, [](const auto& core) { return core.round_axis(); });
    if (axis < 0) continue;
    const auto [n, h] = detail::MeridianSearch<R>(a, b, c->frame.rotation.col(axis), size).least();
    if (h < e.upper) {
      e.upper = h;
      e.normal = n;
    }
  }
  for (const double share : detail::proximal_shares) {
    const EpaResult<R> step = detail::proximal<R>(e.normal, R(share), a, b, size, tolerance);
    const R depth = std::min(step.upper, e.upper);
    // EPA's tolerance enters twice through the shift: once in height and once in length.
    if (step.status == EpaStatus::broken || abs((step.b - step.a).norm() - depth) > 4 * tolerance) continue;
    e.a = step.a;
    e.b = step.b;
    e.status = EpaStatus::closed;
    if (step.upper <= e.upper) {
      e.upper = step.upper;
      e.normal = step.normal;
    }
    return;
  }
}

/// How far `part_a_little` moves B, as shares of the bodies' size. For the normal: far above rounding, so
/// that the distance is found well, and below the radii of curvature of bodies that are not needles, so that
/// it converges fast.
inline constexpr double parted_for_normal = 0x1p-10;
/// For the points, which are off by at most √(2 · tolerance · distance) along the contact: little above the
/// tolerance.
inline constexpr double parted_for_points = 0x1p-44;

/// Improves e in place for bodies that touch within rounding, whose polytope is too flat around the origin to
/// be expanded. B is moved a little along the best normal: the distance of bodies that are apart is easy to
/// find, and its normal is the next direction. Where bodies touch along m, moving B along m by t makes their
/// distance t along m: a fixed point, which an error in the direction approaches by t / (r + t) each time, r
/// being the radius of curvature of B − A. Where that is nearly 1 (an edge almost along a rim), the steps are
/// nearly in proportion: the least depth on the way to twice their limit (Aitken's extrapolation) is taken.
template <class R>
void part_a_little(EpaResult<R>& e, const ConvexCore<R>& a, const ConvexCore<R>& b, R size, R tolerance) {
  constexpr int most = 8;
  constexpr int budget = 2000;
  const auto parted = [&](const V3<R>& shift) {
    ConvexCore<R> moved = b;
    moved.frame.translation += shift;
    return gjk<R>(a, moved, tolerance, tolerance / 4, budget);
  };
  const Difference<R> d{a, b};
  const R noise = rounding::wide_support_noise * std::numeric_limits<R>::epsilon() * size;
  R last = 0;  // length of the step before
  for (int i = 0; i < most; ++i) {
    const V3<R> shift = R(parted_for_normal) * size * e.normal;
    const Distance<R> g = parted(shift);
    if (g.status != GjkStatus::separated) return;
    const R depth = d.height(g.normal);
    if (!(depth < e.upper)) break;
    const V3<R> step = g.normal - e.normal;
    e.upper = depth;
    e.normal = g.normal;
    e.a = g.a;
    e.b = g.b - shift;
    const R length = step.norm(), before = std::exchange(last, length);
    if (!(length < before)) continue;
    last = 0;
    const R farthest = 2 * length / (before - length);
    const auto ahead = [&](R x) { return V3<R>((g.normal + x * step).normalized()); };
    const auto [x, least] =
        detail::least_between<R>(0, farthest, noise, [&](R at) { return d.height(ahead(at)); });
    if (!(least < e.upper)) continue;
    e.upper = least;
    e.normal = ahead(x);
  }
  const V3<R> shift = R(parted_for_points) * size * e.normal;
  const Distance<R> g = parted(shift);
  if (g.status != GjkStatus::separated || !((g.b - shift - g.a).norm() < (e.b - e.a).norm())) return;
  e.a = g.a;
  e.b = g.b - shift;
}

}  // namespace touchstone::narrow::extended
