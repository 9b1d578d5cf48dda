// The depth of two polytopes along the features that touched in an earlier query, if it is proven to be the
// least still. One support point of each body gives the depth along the features' direction, and two bodies
// inside C = B − A bound it from below over all directions (local_depth.h has the bounds):
//
// * the disc of radius r about the foot, in the plane of the feature of C that contains the foot: along the
//   great circle m(θ) of the direction m, h >= d cos θ + r sin θ, which is at least d up to tan(θ/2) = r/d;
// * a point q of C far on the other side: h >= −H cos θ − Q sin θ, with H = −q·m and Q = |q + H m|, which is
//   at least d from tan(θ/2) = T = (Q + √(Q² + H² − d²))/(H − d) on.
//
// The direction is global where r >= d T. All points come from the bodies as they are: a memory that is wrong
// fails the proof. Outcome: proven or not.
#pragma once

#include "core/narrow/filtered/difference.h"

namespace touchstone::narrow::filtered {

namespace detail {

// Corners have numbers: of a box, bit k is set on the positive side of axis k; of vertices, their order.
template <class R>
std::int32_t corner_count(const convex::BoxCore<R>&) {
  return 8;
}
template <class R>
V3<R> corner(const convex::BoxCore<R>& c, std::int32_t i) {
  const V3<R> h = c.half();
  return {i & 1 ? h[0] : -h[0], i & 2 ? h[1] : -h[1], i & 4 ? h[2] : -h[2]};
}
template <class R>
std::int32_t corner_count(const convex::VerticesCore<R>& c) {
  return static_cast<std::int32_t>(c.vertices.size());
}
template <class R>
V3<R> corner(const convex::VerticesCore<R>& c, std::int32_t i) {
  return c.vertices[static_cast<std::size_t>(i)].template cast<R>() * c.unit;
}

template <class C>
concept HasCorners = requires(const C& c) {
  corner_count(c);
};

template <class R>
bool has_corners(const ConvexBody<R>& b) {
  return on_core(b, []<class C>(const C&) { return HasCorners<C>; });
}

/// The corners with these numbers; false: there are none.
template <class R, std::size_t n>
bool corners_of(const ConvexBody<R>& b, const std::array<std::int32_t, n>& number,
                std::array<V3<R>, n>& out) {
  return on_core(b, [&]<class C>(const C& core) {
    if constexpr (HasCorners<C>) {
      for (std::size_t k = 0; k < n; ++k) {
        if (number[k] < 0 || number[k] >= corner_count(core)) return false;
        out[k] = corner(core, number[k]);
      }
      return true;
    } else {
      return false;
    }
  });
}

/// The number of the corner nearest to a point. Precondition: has_corners(b).
template <class R>
std::int32_t corner_at(const ConvexBody<R>& b, const V3<R>& p) {
  std::int32_t best = 0;
  on_core(b, [&]<class C>(const C& core) {
    if constexpr (HasCorners<C>) {
      R least = std::numeric_limits<R>::infinity();
      for (std::int32_t i = 0; i < corner_count(core); ++i)
        if (const R far = (corner(core, i) - p).squaredNorm(); far < least) {
          least = far;
          best = i;
        }
    }
  });
  return best;
}

/// Whether the disc about the foot in the facet of `e` (Depth) may be large enough: T is about 1, and two
/// edges span twice the triangle of their facet.
template <class R, class D>
bool may_prove(const D& e) {
  const auto edge = [&](std::size_t k) { return V3<R>(e.corner[(k + 1) % 3].w - e.corner[k].w); };
  const V3<R> n = edge(0).cross(edge(1));
  const R need = e.upper * e.upper / 4;
  for (std::size_t k = 0; k < 3; ++k) {
    // The distance of the foot from the edge, times the lengths of the edge and of n.
    const R inside = edge(k).cross(V3<R>(e.w - e.corner[k].w)).dot(n);
    if (!(inside > 0 && inside * inside >= need * edge(k).squaredNorm() * n.squaredNorm())) return false;
  }
  return true;
}

}  // namespace detail

template <class R>
class RecalledDepth {
  using Feature = convex::Feature<R>;
  using FeatureKind = convex::FeatureKind;

 public:
  bool proven = false;
  R upper = 0, lower = 0;  // as in Depth
  V3<R> outward, a, w;

  /// `guess`: about the direction from A to B. `size` and `tolerance` as in Expander.
  RecalledDepth(const Difference<R>& d, const TouchingFeatures& f, const V3<R>& guess, R size, R tolerance)
      : d_(d), level_(rounding::feature_height * u<R> * size) {
    std::array<V3<R>, 3> corner[2];
    std::array<V3<R>, 1> far[2];
    for (std::size_t i = 0; i < 2; ++i)
      if (!detail::corners_of(body(i), f.corner[i], corner[i]) ||
          !detail::corners_of(body(i), {f.opposite[i]}, far[i]))
        return;
    for (std::size_t i = 0; i < 2; ++i) {
      const V3<R> along = i == 0 ? guess : V3<R>(d.at.b_to_a.transpose() * -guess);
      feature_[i] = on_core(
          body(i), [&](const auto& core) { return core.suggest(corner[i], corner[i][0], along, level_); });
    }
    const bool placed = feature_[0].kind == FeatureKind::face   ? on_face_of_a(corner[0])
                        : feature_[1].kind == FeatureKind::face ? on_face_of_b(corner[1])
                                                                : on_edges(guess);
    if (!placed || !(upper > 0)) return;
    outward = -n_;
    lower = upper - below_ - level_ / 4;
    proven = upper - lower <= tolerance && covers(to_a(far[1][0]) - far[0][0]);
  }

 private:
  const ConvexBody<R>& body(std::size_t i) const { return i == 0 ? d_.a : d_.b; }
  V3<R> to_a(const V3<R>& p) const { return d_.at.b_to_a * p + d_.at.offset; }
  V3<R> turned_to_b(const V3<R>& v) const { return d_.at.b_to_a.transpose() * v; }

  // The depth along n_ (A to B), and the support points that it lies between.
  void measure() {
    top_a_ = support_local<R>(d_.a, n_);
    local_b_ = support_local<R>(d_.b, turned_to_b(-n_));
    top_b_ = to_a(local_b_);
    upper = n_.dot(top_a_ - top_b_);
  }

  bool on_face_of_a(const std::array<V3<R>, 3>& corner) {
    n_ = feature_[0].c;
    measure();
    below_ = n_.dot(top_a_) - least(n_, corner);
    a = top_b_ + upper * n_;
    w = -upper * n_;
    radius_ = margin(0, a);
    return radius_ > 0;
  }

  bool on_face_of_b(const std::array<V3<R>, 3>& corner) {
    const V3<R>& out = feature_[1].c;
    n_ = -(d_.at.b_to_a * out);
    measure();
    // In B's frame, where the corners are exact: the face is level up to the rounding of its normal.
    below_ = out.dot(local_b_) - least(out, corner);
    a = top_a_;
    w = -upper * n_;
    radius_ = margin(1, turned_to_b(top_a_ + w - d_.at.offset));
    return radius_ > 0;
  }

  bool on_edges(const V3<R>& guess) {
    const Feature &fa = feature_[0], &fb = feature_[1];
    if (fa.kind != FeatureKind::edge || fb.kind != FeatureKind::edge) return false;
    const V3<R> ea = fa.e, eb = d_.at.b_to_a * fb.e;
    n_ = ea.cross(eb);
    const R sine_sq = n_.squaredNorm();
    if (!(sine_sq > R(tolerance::parallel_sine_sq))) return false;
    const R sine = std::sqrt(sine_sq);
    n_ *= (n_.dot(guess) < 0 ? R(-1) : R(1)) / sine;
    measure();
    const V3<R> pb = to_a(fb.p), rest = fa.p - pb - upper * n_;
    const R g = ea.dot(eb), p = rest.dot(ea), q = rest.dot(eb);
    const R along_a = (g * q - p) / sine_sq, along_b = (q - g * p) / sine_sq;
    radius_ = sine * std::min(std::min(along_a - fa.lo, fa.hi - along_a),
                              std::min(along_b - fb.lo, fb.hi - along_b));
    below_ = n_.dot(top_a_) - std::min(n_.dot(fa.p + fa.lo * ea), n_.dot(fa.p + fa.hi * ea)) +
             std::max(n_.dot(pb + fb.lo * eb), n_.dot(pb + fb.hi * eb)) - n_.dot(top_b_);
    a = fa.p + along_a * ea;
    w = pb + along_b * eb - a;
    return radius_ > 0;
  }

  static R least(const V3<R>& n, const std::array<V3<R>, 3>& p) {
    return std::min(std::min(n.dot(p[0]), n.dot(p[1])), n.dot(p[2]));
  }
  R margin(std::size_t i, const V3<R>& p) const {
    return on_core(body(i), [&](const auto& core) { return core.face_margin(feature_[i], p); });
  }

  bool covers(const V3<R>& q) const {
    const R far = q.dot(n_), off = (q - far * n_).squaredNorm(), d = upper;
    if (!(far > d + level_)) return false;
    const R t = (std::sqrt(off) + std::sqrt(off + far * far - d * d)) / (far - d);
    return radius_ - level_ >= d * t * (1 + rounding::formula * u<R>);
  }

  const Difference<R>& d_;
  R level_;
  Feature feature_[2];
  V3<R> n_, top_a_, local_b_, top_b_;  // support points; B's in its own frame and in A's
  R radius_ = 0, below_ = 0;
};

/// The numbers of the corners of the facet in `e` (Depth), for a later query. Unknown where they would prove
/// nothing: finding them takes as long as several support points.
template <class R, class D>
TouchingFeatures touching_features(const Difference<R>& d, const D& e) {
  TouchingFeatures f;
  if (!detail::has_corners(d.a) || !detail::has_corners(d.b) || !detail::may_prove<R>(e)) return f;
  const auto in_b = [&](const V3<R>& v) { return V3<R>(d.at.b_to_a.transpose() * v); };
  for (std::size_t k = 0; k < 3; ++k) {
    f.corner[0][k] = detail::corner_at<R>(d.a, e.corner[k].a);
    f.corner[1][k] = detail::corner_at<R>(d.b, in_b(e.corner[k].w + e.corner[k].a - d.at.offset));
  }
  f.opposite = {detail::corner_at<R>(d.a, support_local<R>(d.a, e.outward)),
                detail::corner_at<R>(d.b, support_local<R>(d.b, in_b(-e.outward)))};
  return f;
}

}  // namespace touchstone::narrow::filtered
