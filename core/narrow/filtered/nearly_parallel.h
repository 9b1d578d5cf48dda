// Contact of faces and edges that are parallel up to a small angle. The normal of least depth is then often
// across two edges, or leans a little towards one end, and the support features along it are a point,
// although the bodies overlap by nearly the same depth along a whole face or line. Here, the features are the
// corners within a share of the depth of each support plane. Chords between corners of a body lie inside it,
// so the depth between two chords is one that the bodies have there.
#pragma once

#include "core/narrow/outline.h"

namespace touchstone::narrow::filtered::detail {

using outline::Corner;
using outline::Corners;

/// A point in the plane of a contact, and how far the surfaces of A and B are below their support planes
/// there.
template <class R>
struct Spot {
  R x, y, below_a, below_b;
  std::uint32_t id;
};

template <class R>
struct Spots {
  std::array<Spot<R>, static_cast<std::size_t>(Corners<R>::capacity)> spot;
  int size = 0;
  void add(const Spot<R>& s) {
    if (size < Corners<R>::capacity) spot[static_cast<std::size_t>(size++)] = s;
  }
};

/// How far the chords from the outline's first corner to the others are below the support plane at a point
/// inside the outline, up to rounding.
template <class R>
R below_at(const Corners<R>& outline, R x, R y) {
  const Corner<R> p{x, y, 0, 0, 0};
  const Corner<R>& a = outline[0];
  for (int k = 1; k + 1 < outline.size; ++k) {
    const Corner<R>&b = outline[k], &c = outline[k + 1];
    // The last fan triangle takes what rounding leaves outside the others.
    if (k + 2 < outline.size && outline::turn(a, c, p) > 0) continue;
    const R whole = outline::turn(a, b, c);
    if (!(whole > 0)) continue;
    const R to_a = std::clamp<R>(outline::turn(b, c, p) / whole, 0, 1);
    const R to_c = std::clamp<R>(outline::turn(a, b, p) / whole, 0, 1 - to_a);
    return to_a * a.below + (1 - to_a - to_c) * b.below + to_c * c.below;
  }
  R most = 0;
  for (const Corner<R>& c : outline) most = std::max(most, c.below);
  return most;
}

/// The tips of a window: points in it, to within rounding, that are beyond a corner. Edges of a needle end
/// where rounding lets their lines cross.
template <class R>
class Tips {
 public:
  explicit Tips(const Corners<R>& window) : window_(window) {
    for (int i = 0; i < window.size; ++i) {
      const auto next = towards(i, (i + 1) % window.size);
      const auto last = towards(i, (i + window.size - 1) % window.size);
      inwards_[static_cast<std::size_t>(i)] = {next[0] + last[0], next[1] + last[1]};
    }
  }
  /// The corner that the point is beyond; null: it is beyond none.
  const Corner<R>* corner_before(const Corner<R>& p) const {
    for (int i = 0; i < window_.size; ++i) {
      const Corner<R>& w = window_[i];
      const auto& in = inwards_[static_cast<std::size_t>(i)];
      if (in[0] * (p.x - w.x) + in[1] * (p.y - w.y) < 0) return &w;
    }
    return nullptr;
  }

 private:
  std::array<R, 2> towards(int from, int to) const {
    const R x = window_[to].x - window_[from].x, y = window_[to].y - window_[from].y;
    const R length = sqrt(x * x + y * y);
    return {x / length, y / length};
  }
  const Corners<R>& window_;
  std::array<std::array<R, 2>, static_cast<std::size_t>(Corners<R>::capacity)> inwards_;
};

/// `window`, a polygon, and the part of `subject` inside it.
template <class R>
Spots<R> face_spots(const Corners<R>& window, Corners<R> subject, bool window_is_a, R tolerance) {
  outline::clip(subject, window, tolerance, window_is_a);
  Spots<R> r;
  if (subject.overflow) return r;
  const Tips<R> tips(window);
  for (Corner<R> c : subject) {
    const Corner<R>* const corner = tips.corner_before(c);
    if (corner) {
      c.x = corner->x;
      c.y = corner->y;
    }
    const R of_window = corner ? corner->below : below_at(window, c.x, c.y);
    r.add({c.x, c.y, window_is_a ? of_window : c.below, window_is_a ? c.below : of_window, c.id});
  }
  return r;
}

/// Two edges, rounded with these radii, at most one of which is 0: the ends of what they have in common along
/// A. `beside` is the largest distance of the two across the plane. A ball's surface `s` beside
/// its centre is s²/(r + √(r² − s²)) below its top.
template <class R>
Spots<R> edge_spots(Corners<R> a, const Corners<R>& b, R radius_a, R radius_b, R beside) {
  Spots<R> r;
  if (a[1].id < a[0].id) std::swap(a[0], a[1]);  // the first end keeps its id
  const std::uint32_t id = outline::id_of_edges(a, b);
  const outline::EdgePair<R> e(a, b);
  const R radius = std::max(radius_a, radius_b);
  if (!(radius > beside) || !e.is_collinear(beside)) return r;
  const auto along = [&](const Corner<R>& p) {
    return R((e.dx * (p.x - a[0].x) + e.dy * (p.y - a[0].y)) / e.length);
  };
  const R t0 = along(b[0]), t1 = along(b[1]);
  const R lo = std::max<R>(std::min(t0, t1), 0), hi = std::min(std::max(t0, t1), e.length);
  if (!(lo < hi)) return r;
  for (const R t : {lo, hi}) {
    const R of_a = t / e.length, of_b = (t - t0) / (t1 - t0), s = e.s0 + (e.s1 - e.s0) * of_b;
    const R drop = s * s / (radius + std::sqrt(radius * radius - s * s));
    const R below_a = a[0].below + (a[1].below - a[0].below) * of_a,
            below_b = b[0].below + (b[1].below - b[0].below) * of_b;
    // The point is on the line of the smaller ball.
    const bool on_b = radius_a > radius_b;
    const R shift = on_b ? s : R(0);
    r.add({a[0].x + (e.dx * t - e.dy * shift) / e.length, a[0].y + (e.dy * t + e.dx * shift) / e.length,
           below_a + (on_b ? drop : R(0)), below_b + (on_b ? R(0) : drop),
           t == lo ? id : id | outline::of_a});
  }
  return r;
}

/// The features of A and B within some depth of their support planes: polygons, edges or points.
template <class R>
Spots<R> nearly_parallel_spots(const Corners<R>& a, const Corners<R>& b, R radius_a, R radius_b, R tolerance,
                               R beside) {
  if (a.overflow || b.overflow || a.size < 2 || b.size < 2) return {};
  if (a.size >= 3) return face_spots(a, b, true, tolerance);
  if (b.size >= 3) return face_spots(b, a, false, tolerance);
  return edge_spots(a, b, radius_a, radius_b, beside);
}

}  // namespace touchstone::narrow::filtered::detail
