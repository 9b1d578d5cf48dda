// Outlines of supporting faces in the plane of a contact: convex polygons, segments and points,
// counter-clockwise about the plane's normal; their convex order, and how one is cut by another (Sutherland,
// Hodgman 1974). Both manifolds are made of them: in doubles (filtered/patch.h) and in extended precision
// (manifold.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/math/wide.h"
#include "core/shape/feature.h"

namespace touchstone::narrow::outline {

/// A corner in the plane's coordinates, `below` the body's own support plane.
template <class R>
struct Corner {
  R x, y, below;
  std::uint32_t id;
  std::uint32_t edge;  // during clipping: the edge from here to the next corner
};

/// Items in place, at most n, in double and float; allocated in extended precision, which must answer for
/// faces of any size.
template <class R, class T, std::size_t n>
using Items = std::conditional_t<convex::is_hardware<R>, std::array<T, n>, std::vector<T>>;

/// Room for `count` items. Those in place are not initialised.
template <class T>
void make_room(std::vector<T>& items, int count) {
  items.resize(static_cast<std::size_t>(count));
}
template <class T, std::size_t n>
void make_room(std::array<T, n>&, int) {}

/// Copies only the corners in use.
template <class R>
class Corners {
 public:
  /// In double and float; for the intersection of two rims.
  static constexpr int capacity = convex::face_capacity;
  int size = 0;
  bool overflow = false;
  Corners() {}
  Corners(const Corners& o) { *this = o; }
  Corners& operator=(const Corners& o) {
    size = o.size;
    overflow = o.overflow;
    if constexpr (convex::is_hardware<R>)
      std::copy(o.begin(), o.end(), c_.begin());
    else
      c_.assign(o.begin(), o.end());
    return *this;
  }
  void add(const Corner<R>& x) {
    if constexpr (!convex::is_hardware<R>) {
      if (size == static_cast<int>(c_.size())) c_.emplace_back();
    } else if (size == capacity) {
      overflow = true;
      return;
    }
    c_[static_cast<std::size_t>(size++)] = x;
  }
  Corner<R>& operator[](int i) { return c_[static_cast<std::size_t>(i)]; }
  const Corner<R>& operator[](int i) const { return c_[static_cast<std::size_t>(i)]; }
  Corner<R>* begin() { return c_.data(); }
  Corner<R>* end() { return c_.data() + size; }
  const Corner<R>* begin() const { return c_.data(); }
  const Corner<R>* end() const { return c_.data() + size; }

 private:
  Items<R, Corner<R>, convex::face_capacity> c_;
};

template <class R>
R turn(const Corner<R>& a, const Corner<R>& b, const Corner<R>& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// By x, and by y where the first or the last points have the same x within the tolerance: the chain below
/// begins and ends at a corner.
template <class R>
void sort_for_chain(Corners<R>& p, R tolerance) {
  std::sort(p.begin(), p.end(), [](const Corner<R>& a, const Corner<R>& b) {
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.id < b.id);
  });
  const auto upwards = [](const Corner<R>& a, const Corner<R>& b) {
    return a.y != b.y ? a.y < b.y : (a.x != b.x ? a.x < b.x : a.id < b.id);
  };
  const R first = p[0].x + tolerance, last = p[p.size - 1].x - tolerance;
  std::sort(p.begin(), std::find_if(p.begin(), p.end(), [&](const Corner<R>& c) { return c.x > first; }),
            upwards);
  std::sort(std::find_if(p.begin(), p.end(), [&](const Corner<R>& c) { return c.x >= last; }), p.end(),
            upwards);
}

/// Andrew's monotone chain, counter-clockwise; points on edges (within tolerance) are dropped.
template <class R>
void convex_order(Corners<R>& p, R tolerance) {
  if (p.size < 2) return;
  sort_for_chain(p, tolerance);
  if (p.size == 2) {
    if (abs(p[0].x - p[1].x) + abs(p[0].y - p[1].y) <= tolerance) p.size = 1;
    return;
  }
  Corners<R> h;
  Items<R, int, 2 * Corners<R>::capacity + 2> chain;
  make_room(chain, 2 * p.size + 2);
  int n = 0;
  const auto push = [&](int i, int floor) {
    while (n >= floor + 2) {
      const Corner<R>&a = p[chain[static_cast<std::size_t>(n - 2)]],
            &b = p[chain[static_cast<std::size_t>(n - 1)]], &c = p[i];
      const R length = abs(c.x - a.x) + abs(c.y - a.y);
      if (turn(a, b, c) > tolerance * length) break;
      --n;
    }
    chain[static_cast<std::size_t>(n++)] = i;
  };
  for (int i = 0; i < p.size; ++i) push(i, 0);
  const int lower = n - 1;
  for (int i = p.size - 2; i >= 0; --i) push(i, lower);
  if (n > 1) --n;
  for (int i = 0; i < n; ++i) h.add(p[chain[static_cast<std::size_t>(i)]]);
  if (h.size == 2 && abs(h[0].x - h[1].x) + abs(h[0].y - h[1].y) <= tolerance) h.size = 1;
  h.overflow = p.overflow;
  p = h;
}

// 0 is reserved for a point that belongs to no feature.
inline constexpr std::uint32_t of_a = 0x20000000u, of_b = 0x80000000u, crossing = 0x40000000u,
                               on_window = 0x10000u;

/// Independent of the order of the ends; 15 bits, without collisions among the corners of a box or a rim.
inline std::uint32_t edge_id(std::uint32_t a, std::uint32_t b) {
  return (std::min(a, b) * 181 + std::max(a, b)) & 0x7fffu;
}

/// Id of the point where two edges cross, of A and of B.
template <class R>
std::uint32_t id_of_edges(const Corners<R>& a, const Corners<R>& b) {
  return crossing | edge_id(a[0].id, a[1].id) << 15 | edge_id(b[0].id, b[1].id);
}

/// The id of the same point with A and B exchanged.
inline std::uint32_t mirrored_id(std::uint32_t id) {
  constexpr std::uint32_t edge = 0x7fffu;
  if (id & crossing) return crossing | (id & edge) << 15 | (id >> 15 & edge);
  const std::uint32_t corner = id & ~(of_a | of_b);
  return corner | (id & of_a ? of_b : 0u) | (id & of_b ? of_a : 0u);
}

/// Id of the point that the edge of the incident outline and edge i of the window share.
template <class R>
std::uint32_t crossing_id(std::uint32_t edge, const Corners<R>& window, int i, bool window_is_a) {
  const int next = (i + 1) % window.size;
  if (edge & on_window) {
    // The outline runs along another edge of the window: the point is their common corner.
    const bool before = static_cast<int>(edge & 0xffffu) == (i + window.size - 1) % window.size;
    return window[before ? i : next].id | (window_is_a ? of_a : of_b);
  }
  const std::uint32_t own = edge_id(window[i].id, window[next].id);
  return crossing | (window_is_a ? (own << 15 | edge) : (edge << 15 | own));
}

/// The part of `subject` inside `window`, a polygon. Lengths up to `tolerance` are 0.
template <class R>
void clip(Corners<R>& subject, const Corners<R>& window, R tolerance, bool window_is_a) {
  for (int k = 0; k < subject.size; ++k)
    subject[k].edge = edge_id(subject[k].id, subject[(k + 1) % subject.size].id);
  for (Corner<R>& c : subject) c.id |= window_is_a ? of_b : of_a;
  for (int i = 0; i < window.size && subject.size > 0; ++i) {
    const Corner<R>&w0 = window[i], &w1 = window[(i + 1) % window.size];
    const R ex = w1.x - w0.x, ey = w1.y - w0.y, length = sqrt(ex * ex + ey * ey);
    // Distances from the window's edge; in doubles times its length, which spares a division for each corner.
    const R unit = convex::is_hardware<R> ? R(1) : length, zero = tolerance * (length / unit);
    Items<R, R, Corners<R>::capacity> side;
    make_room(side, subject.size);
    bool cuts = false;
    for (int k = 0; k < subject.size; ++k) {
      const R s = (ex * (subject[k].y - w0.y) - ey * (subject[k].x - w0.x)) / unit;
      side[static_cast<std::size_t>(k)] = abs(s) <= zero ? R(0) : s;
      cuts |= !(s >= -zero);
    }
    if (!cuts) continue;
    Corners<R> out;
    const std::uint32_t along = on_window | static_cast<std::uint32_t>(i);
    for (int k = 0; k < subject.size; ++k) {
      const int next = (k + 1) % subject.size;
      const Corner<R>&p = subject[k], &q = subject[next];
      const R sp = side[static_cast<std::size_t>(k)], sq = side[static_cast<std::size_t>(next)];
      if (sp >= 0) {
        out.add(p);
        if (sp == 0 && sq < 0) out[out.size - 1].edge = along;
      }
      if (sp * sq < 0 && !(subject.size == 2 && k == 1)) {
        const R t = sp / (sp - sq);
        out.add({p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, p.below + (q.below - p.below) * t,
                 crossing_id(p.edge, window, i, window_is_a), sp > 0 ? along : p.edge});
      }
    }
    subject = out;
  }
}

/// Whether the corner is in `window`, a polygon, to within the tolerance.
template <class R>
bool holds(const Corners<R>& window, const Corner<R>& c, R tolerance) {
  for (int i = 0; i < window.size; ++i) {
    const Corner<R>&w0 = window[i], &w1 = window[(i + 1) % window.size];
    const R ex = w1.x - w0.x, ey = w1.y - w0.y;
    if (turn(w0, w1, c) < -tolerance * (abs(ex) + abs(ey))) return false;
  }
  return true;
}

/// Where a segment crosses the boundary of a window: the shares of its length at which it enters and leaves,
/// and the window's edges there; -1: it does not.
template <class R>
struct Crossings {
  R enters = 0, leaves = 1;
  int entrance = -1, exit = -1;
};

/// Lengths up to `tolerance` are 0: a segment that ends on the boundary, or runs along it, does not cross it.
template <class R>
Crossings<R> crossings_of(const Corner<R>& from, const Corner<R>& to, const Corners<R>& window, R tolerance) {
  Crossings<R> c;
  for (int i = 0; i < window.size; ++i) {
    const Corner<R>&w0 = window[i], &w1 = window[(i + 1) % window.size];
    const R zero = tolerance * (abs(w1.x - w0.x) + abs(w1.y - w0.y)), s = turn(w0, w1, from),
            t = turn(w0, w1, to);
    if (s >= -zero && t >= -zero) continue;
    if ((s < -zero && t <= zero) || (t < -zero && s <= zero)) return {};
    const R share = s / (s - t);
    if (s < 0 && share > c.enters) {
      c.enters = share;
      c.entrance = i;
    } else if (s > 0 && share < c.leaves) {
      c.leaves = share;
      c.exit = i;
    }
  }
  return c.enters < c.leaves ? c : Crossings<R>{};
}

/// Two segments, of two corners each: b as seen from a.
template <class R>
struct EdgePair {
  const Corners<R>&a, &b;
  R dx, dy, length;  // of a
  R s0, s1;          // distances of b's ends from a's line, to its left

  EdgePair(const Corners<R>& first, const Corners<R>& second)
      : a(first),
        b(second),
        dx(a[1].x - a[0].x),
        dy(a[1].y - a[0].y),
        length(sqrt(dx * dx + dy * dy)),
        s0((dx * (b[0].y - a[0].y) - dy * (b[0].x - a[0].x)) / length),
        s1((dx * (b[1].y - a[0].y) - dy * (b[1].x - a[0].x)) / length) {}

  bool is_collinear(R tolerance) const { return abs(s0) <= tolerance && abs(s1) <= tolerance; }

  /// The interval that collinear segments have in common; empty if there is none.
  Corners<R> common(std::uint32_t id) const {
    const auto along = [&](const Corner<R>& p) {
      return R((dx * (p.x - a[0].x) + dy * (p.y - a[0].y)) / length);
    };
    Corners<R> r;
    const R t0 = along(b[0]), t1 = along(b[1]);
    const R lo = std::max<R>(std::min(t0, t1), 0), hi = std::min(std::max(t0, t1), length);
    if (!(lo <= hi)) return r;
    for (const R t : {lo, hi})
      r.add({a[0].x + dx * (t / length), a[0].y + dy * (t / length), 0, t == lo ? id : id | of_a, 0});
    return r;
  }
};

}  // namespace touchstone::narrow::outline
