// Contact manifold in fixed storage. Reference: the face (three points or more) of one body that supports it
// along the normal. Incident: the corners of the other body beyond the reference's plane, in convex order,
// clipped against the reference (Sutherland, Hodgman 1974). Each point keeps its own depth. Chords of the
// incident body lie inside it, so every point lies within its depth of both bodies, halfway between the
// incident body and the plane. A face tilted by a few ulp therefore stays complete and does not flicker.
// Without a face: overlap or crossing of two edges, or the deepest vertex.
//
// Ids name features: a corner of A, a corner of B, or an edge of A that crosses an edge of B. They do not
// depend on which body is the reference or where its outline starts; both change with an ulp when faces lie
// on each other.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/narrow/filtered/query.h"
#include "core/narrow/result.h"
#include "core/shape/convex_body.h"

namespace touchstone::narrow::filtered {

template <class R>
struct PatchPoint {
  V3<R> p;  // A's frame
  R depth;
  std::uint32_t id;
};

template <class R>
struct Patch {
  static constexpr int capacity = static_cast<int>(Manifold::capacity);
  std::array<PatchPoint<R>, capacity> point;
  int size = 0;
};

namespace detail {

/// A corner of a supporting feature in the plane's coordinates, `below` the body's own support plane.
template <class R>
struct Corner {
  R x, y, below;
  std::uint32_t id;
  std::uint32_t edge;  // during clipping: the edge from here to the next corner
};

/// Capacity for the intersection of two rims. Copies only the corners in use.
template <class R>
class Corners {
 public:
  static constexpr int capacity = convex::face_capacity;
  int size = 0;
  bool overflow = false;
  Corners() {}
  Corners(const Corners& o) { *this = o; }
  Corners& operator=(const Corners& o) {
    size = o.size;
    overflow = o.overflow;
    std::copy(o.begin(), o.end(), c_.begin());
    return *this;
  }
  void add(const Corner<R>& x) {
    if (size < capacity)
      c_[static_cast<std::size_t>(size++)] = x;
    else
      overflow = true;
  }
  Corner<R>& operator[](int i) { return c_[static_cast<std::size_t>(i)]; }
  const Corner<R>& operator[](int i) const { return c_[static_cast<std::size_t>(i)]; }
  Corner<R>* begin() { return c_.data(); }
  Corner<R>* end() { return c_.data() + size; }
  const Corner<R>* begin() const { return c_.data(); }
  const Corner<R>* end() const { return c_.data() + size; }

 private:
  std::array<Corner<R>, capacity> c_;
};

template <class R>
struct PatchPlane {
  V3<R> n, x, y, origin;  // A's frame
  explicit PatchPlane(const V3<R>& normal) : n(normal), x(normal.unitOrthogonal()), y(normal.cross(x)) {}
};

template <class R>
R turn(const Corner<R>& a, const Corner<R>& b, const Corner<R>& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Andrew's monotone chain, counter-clockwise; points on edges (within tolerance) are dropped.
template <class R>
void convex_order(Corners<R>& p, R tolerance) {
  if (p.size < 2) return;
  std::sort(p.begin(), p.end(), [](const Corner<R>& a, const Corner<R>& b) {
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.id < b.id);
  });
  Corners<R> h;
  std::array<int, 2 * Corners<R>::capacity + 2> chain;
  int n = 0;
  const auto push = [&](int i, int floor) {
    while (n >= floor + 2) {
      const Corner<R>&a = p[chain[static_cast<std::size_t>(n - 2)]],
            &b = p[chain[static_cast<std::size_t>(n - 1)]], &c = p[i];
      const R length = std::abs(c.x - a.x) + std::abs(c.y - a.y);
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
  if (h.size == 2 && std::abs(h[0].x - h[1].x) + std::abs(h[0].y - h[1].y) <= tolerance) h.size = 1;
  h.overflow = p.overflow;
  p = h;
}

/// Corners of `c` at most `limit` below its support plane along d (in its own frame, unit).
template <class R>
class FeatureCorners {
 public:
  FeatureCorners(const ConvexBody<R>& c, const M3<R>& to_a, const V3<R>& offset, const PatchPlane<R>& plane,
                 R sign, R limit, R tolerance)
      : c_(c), to_a_(to_a), offset_(offset), plane_(plane) {
    at_.d = to_a.transpose() * (sign * plane.n);
    at_.top = at_.d.dot(support_local<R>(c, at_.d));
    at_.limit = limit;
    at_.tolerance = tolerance;
  }

  const Corners<R>& collect() {
    const bool ordered = on_core(c_, [&](const auto& core) { return core.face_corners(at_, *this); });
    if (ordered && out_.size >= 4) {
      if (turn(out_[0], out_[1], out_[2]) < 0) std::reverse(out_.begin(), out_.end());
      return out_;
    }
    if (out_.size == 0 && !out_.overflow) add_certain(support_local<R>(c_, at_.d), 0);
    convex_order(out_, at_.tolerance);
    return out_;
  }

  void add(const V3<R>& p, std::uint32_t id) {
    if (at_.top - at_.d.dot(p) <= at_.limit) add_certain(p, id);
  }
  void add_certain(const V3<R>& p, std::uint32_t id) {
    const V3<R> q = to_a_ * p + offset_ - plane_.origin;
    out_.add({plane_.x.dot(q), plane_.y.dot(q), std::max<R>(0, at_.top - at_.d.dot(p)), id, 0});
  }
  // Keeps their outline. If it has more corners than fit, every other one is kept: 36 corners of a circle
  // still cover 99.5 % of its area.
  void add_many(const V3<R>& p, std::uint32_t id) {
    add(p, id);
    if (out_.size < Corners<R>::capacity) return;
    convex_order(out_, at_.tolerance);
    if (2 * out_.size <= Corners<R>::capacity) return;
    for (int k = 0; 2 * k < out_.size; ++k) out_[k] = out_[2 * k];
    out_.size = (out_.size + 1) / 2;
  }

 private:
  const ConvexBody<R>& c_;
  const M3<R>& to_a_;
  const V3<R>& offset_;
  const PatchPlane<R>& plane_;
  convex::FaceQuery<R> at_;
  Corners<R> out_;
};

// 0 is reserved for a point that belongs to no feature.
inline constexpr std::uint32_t of_a = 0x20000000u, of_b = 0x80000000u, crossing = 0x40000000u,
                               on_window = 0x10000u;

/// Independent of the order of the ends; 15 bits, without collisions among the corners of a box or a rim.
inline std::uint32_t edge_id(std::uint32_t a, std::uint32_t b) {
  return (std::min(a, b) * 181 + std::max(a, b)) & 0x7fffu;
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

template <class R>
void clip(Corners<R>& subject, const Corners<R>& window, R tolerance, bool window_is_a) {
  for (int k = 0; k < subject.size; ++k)
    subject[k].edge = edge_id(subject[k].id, subject[(k + 1) % subject.size].id);
  for (Corner<R>& c : subject) c.id |= window_is_a ? of_b : of_a;
  for (int i = 0; i < window.size && subject.size > 0; ++i) {
    const Corner<R>&w0 = window[i], &w1 = window[(i + 1) % window.size];
    const R ex = w1.x - w0.x, ey = w1.y - w0.y, length = std::sqrt(ex * ex + ey * ey);
    std::array<R, Corners<R>::capacity> side;
    for (int k = 0; k < subject.size; ++k) {
      const R s = ex * (subject[k].y - w0.y) - ey * (subject[k].x - w0.x);
      side[static_cast<std::size_t>(k)] = std::abs(s) <= tolerance * length ? R(0) : s;
    }
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

/// Two edges: their common interval when they are collinear, otherwise their crossing.
template <class R>
Corners<R> cross_edges(Corners<R> a, const Corners<R>& b, R tolerance) {
  Corners<R> r;
  if (a[1].id < a[0].id) std::swap(a[0], a[1]);  // the first end keeps its id
  const std::uint32_t id = crossing | edge_id(a[0].id, a[1].id) << 15 | edge_id(b[0].id, b[1].id);
  const R dx = a[1].x - a[0].x, dy = a[1].y - a[0].y, length = std::sqrt(dx * dx + dy * dy);
  const R s0 = (dx * (b[0].y - a[0].y) - dy * (b[0].x - a[0].x)) / length,
          s1 = (dx * (b[1].y - a[0].y) - dy * (b[1].x - a[0].x)) / length;
  const auto along = [&](const Corner<R>& p) { return (dx * (p.x - a[0].x) + dy * (p.y - a[0].y)) / length; };
  if (std::abs(s0) <= tolerance && std::abs(s1) <= tolerance) {
    const R t0 = along(b[0]), t1 = along(b[1]);
    const R lo = std::max<R>(std::min(t0, t1), 0), hi = std::min(std::max(t0, t1), length);
    if (!(lo <= hi)) return r;
    for (const R t : {lo, hi})
      r.add({a[0].x + dx * (t / length), a[0].y + dy * (t / length), 0, t == lo ? id : id | of_a, 0});
    return r;
  }
  if (!(s0 * s1 <= 0)) return r;
  const R t = s0 / (s0 - s1);
  r.add({b[0].x + (b[1].x - b[0].x) * t, b[0].y + (b[1].y - b[0].y) * t, 0, id, 0});
  return r;
}

}  // namespace detail

/// Manifold of cores a, b (b at `at`; null: a half-space) along n (A's frame, unit, A to B), where `gap` <= 0
/// up to rounding is the gap of the rounded bodies along n. size 0: too many corners for the storage.
template <class R>
Patch<R> contact_patch(const ConvexBody<R>& a, const ConvexBody<R>* b, const Relative<R>& at, const V3<R>& n,
                       R gap, const V3<R>* middle) {
  using namespace detail;
  const R size = a.reach + a.radius + (b ? b->reach + b->radius + at.offset.norm() : 0);
  const R tolerance = 32 * u<R> * size, depth = std::max<R>(0, -gap);
  PatchPlane<R> plane(n);
  const V3<R> top = support_local<R>(a, n);
  plane.origin = top;
  const M3<R> identity = M3<R>::Identity();
  const V3<R> zero = V3<R>::Zero();
  const auto show_a = [&](R limit) {
    return FeatureCorners<R>(a, identity, zero, plane, 1, limit, tolerance).collect();
  };
  const auto show_b = [&](R limit) {
    return FeatureCorners<R>(*b, at.b_to_a, at.offset, plane, -1, limit, tolerance).collect();
  };
  Patch<R> patch;
  Corners<R> fa = show_a(tolerance), fb, region;
  bool by_a = true;
  if (!b) {
    region = show_a(depth + tolerance);
    by_a = false;
  } else if (fa.size >= 3) {
    region = show_b(depth + tolerance);
    clip(region, fa, tolerance, true);
  } else {
    fb = show_b(tolerance);
    if (fb.size >= 3) {
      region = show_a(depth + tolerance);
      by_a = false;
      clip(region, fb, tolerance, false);
    } else if (fa.size == 2 && fb.size == 2) {
      region = cross_edges(fa, fb, 4 * tolerance);
    }
  }
  if (region.overflow || fa.overflow || fb.overflow) return patch;
  if (region.size == 0 && middle) {
    patch.point[0] = {*middle, depth, 0};
    patch.size = 1;
    return patch;
  }
  // Height of A's support plane above plane.origin is the ball's radius.
  const int kept = std::min(region.size, Patch<R>::capacity);
  for (int i = 0; i < kept; ++i) {
    const Corner<R>& c = region[i * region.size / kept];
    const R d = -gap - c.below;
    const R height = a.radius + (gap + (by_a ? c.below : -c.below)) / 2;
    bool repeat = false;
    const V3<R> p = plane.origin + plane.x * c.x + plane.y * c.y + n * height;
    for (int k = 0; k < patch.size; ++k)
      repeat |= (patch.point[static_cast<std::size_t>(k)].p - p).norm() <= tolerance;
    if (!repeat) patch.point[static_cast<std::size_t>(patch.size++)] = {p, std::max<R>(0, d), c.id};
  }
  return patch;
}

}  // namespace touchstone::narrow::filtered
