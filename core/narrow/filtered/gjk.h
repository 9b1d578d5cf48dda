// The iteration of core/narrow/gjk.h in double or float, in A's frame, with help for curved pairs. If the
// bounds do not meet, the caller falls back to extended precision. A tetrahedron of support points that
// encloses the origin with a margin beyond rounding proves overlap.
#pragma once

#include "core/narrow/filtered/local_depth.h"
#include "core/narrow/gjk.h"

namespace touchstone::narrow::filtered {

/// Newton step for the direction n (unit, A to B) whose support point w is parallel to it, as at the nearest
/// point: (H + g) dn = w − g n, where H is the derivative of the support point and g = n·w. Where a body has
/// corners or edges, H is 0 and the step may fail; it only proposes the next direction.
template <class R>
V3<R> newton_direction(const Difference<R>& d, const V3<R>& n, const V3<R>& w) {
  const V3<R> local = d.at.b_to_a.transpose() * -n;
  M3<R> m = support_derivative<R>(d.a, n) +
            d.at.b_to_a * support_derivative<R>(d.b, local) * d.at.b_to_a.transpose();
  const R g = n.dot(w);
  m.diagonal().array() += g;
  const V3<R> r = w - g * n, c0 = m.col(1).cross(m.col(2)), c1 = m.col(2).cross(m.col(0)),
              c2 = m.col(0).cross(m.col(1));
  const R det = c0.dot(m.col(0));
  return n + V3<R>(c0.dot(r), c1.dot(r), c2.dot(r)) / det;
}

/// For pairs with a curved body, which converge linearly without it; the others have finished by then.
template <class R>
class CurvedHelp {
 public:
  static constexpr bool careful = false;
  CurvedHelp(const Difference<R>& d, R size, const GjkLimits<R>& limit)
      : d_(d),
        size_(size),
        tolerance_(limit.tolerance),
        curved_(is_curved(d.a) || is_curved(d.b)),
        wants_distance_(limit.certain > size) {}

  bool settle(GjkResult<R>& g) const {
    return curved_ && wants_distance_ && g.iterations % 3 == 2 && g.iterations > 4 && g.lower > 0 &&
           find_features(g);
  }

  /// From the sixth iteration on, every other step is a Newton step.
  V3<R> direction(const GjkResult<R>& g, const V3<R>& n, const V3<R>& w) const {
    constexpr int first = 6;
    if (!(curved_ && g.iterations >= first && g.iterations % 2 == 0 && g.lower > 0)) return n;
    const V3<R> step = newton_direction(d_, g.normal, w);
    const R size = step.norm();
    return size > R(0.5) && size < 2 ? V3<R>(step / size) : n;
  }

  void see(const Vertex<R>&) const {}

 private:
  // Guesses the touching features from the simplex and computes their nearest points: if the guess is right,
  // a curved pair is finished.
  bool find_features(GjkResult<R>& g) const {
    std::array<Vertex<R>, 3> facet;
    std::array<R, 3> weight{};
    for (std::size_t k = 0; k < 3; ++k) {
      const bool own = static_cast<int>(k) < g.simplex.size;
      facet[k] = g.simplex.p[own ? k : 0];
      weight[k] = own ? g.simplex.weight[k] : R(0);
    }
    LocalMinimum<R> at(d_, size_);
    if (!at.find(facet, weight, -g.normal)) return false;
    const R length = at.point().norm();
    if (!(length + at.height() <= tolerance_)) return false;
    g.simplex.size = 1;
    g.simplex.weight[0] = 1;
    g.simplex.p[0] = {at.point(), at.on_a()};
    g.upper = length;
    g.lower = -at.height();
    g.normal = -at.outward();
    return true;
  }

  const Difference<R>& d_;
  R size_, tolerance_;
  bool curved_, wants_distance_;
};

/// `certain`: a lower bound that ends the iteration when only the verdict is requested; infinite otherwise.
/// `size`: size of the pair, which rounding is relative to. `guess`: an initial direction from A to B, or
/// zero.
template <class R>
GjkResult<R> gjk(const Difference<R>& d, R tolerance, R certain, R size, const V3<R>& guess) {
  constexpr int iterations = 96, idle = 3;
  const GjkLimits<R> limit{tolerance, certain, rounding::height * u<R> * size, iterations, idle};
  const R guessed = guess.squaredNorm();
  return narrow::gjk<R>(d, limit, guessed > R(0.5) && guessed < 2 ? guess : d.at.offset,
                        CurvedHelp<R>(d, size, limit));
}

}  // namespace touchstone::narrow::filtered
