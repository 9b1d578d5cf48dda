// What a polytope has beyond the plane of another body's face, within the prism over that face, which is the
// window: its own corners there, the places where its edges cross the sides of the prism, and those where the
// corners of the face lie inside it. Seen in a side of the prism, the polytope is a polygon, whose corners
// are the crossings; where it leaves the limit, it has the border of the polytope's section there.
#pragma once

#include "core/narrow/outline.h"

namespace touchstone::narrow::filtered::detail {

using outline::Corner;
using outline::Corners;

/// An edge, as far as it is within the limit.
template <class R>
struct EdgePart {
  Corner<R> from, to;
  std::uint32_t id;
};

template <class R>
class BeyondFace {
 public:
  /// `surface`: what is not higher than this below the support plane is on the face's plane. window: a
  /// polygon.
  BeyondFace(const Corners<R>& window, bool window_is_a, R surface, R tolerance)
      : window_(window), is_a_(window_is_a), surface_(surface), tolerance_(tolerance) {}

  /// `leaves`: it goes on beyond the limit.
  void add_edge(const EdgePart<R>& e, bool leaves) {
    if (leaves) section_.add(e.to);
    if (size_ < capacity) edge_[static_cast<std::size_t>(size_++)] = e;
  }

  bool has_edges() const { return size_ > 0; }

  /// Adds crossings and corners of the window to `out`. After all edges.
  void show(Corners<R>& out) {
    if (is_inside()) return;
    outline::convex_order(section_, tolerance_);
    for (int i = 0; i < window_.size; ++i) show_side(i, out);
  }

 private:
  // Enough for a hull with 64 vertices.
  static constexpr int capacity = 192;

  // A point in a side of the prism: `along` it, in units of its length.
  struct Point {
    R along, below;
    std::uint32_t id;
    bool is_crossing;  // of an edge
  };

  bool is_inside() const {
    for (int k = 0; k < size_; ++k) {
      const EdgePart<R>& e = edge_[static_cast<std::size_t>(k)];
      if (!outline::holds(window_, e.from, tolerance_) || !outline::holds(window_, e.to, tolerance_))
        return false;
    }
    return true;
  }

  void show_side(int side, Corners<R>& out) {
    const Corner<R>&w0 = window_[side], &w1 = window_[(side + 1) % window_.size];
    x_ = w1.x - w0.x;
    y_ = w1.y - w0.y;
    origin_ = &w0;
    const R length = abs(x_) + abs(y_);
    zero_ = tolerance_ * length;
    near_ = tolerance_ / length;
    points_ = 0;
    for (int k = 0; k < size_; ++k) {
      const EdgePart<R>& e = edge_[static_cast<std::size_t>(k)];
      cross(e.from, e.to, outline::crossing_id(e.id, window_, side, is_a_), true);
    }
    for (int k = 0; k < section_.size; ++k) cross(section_[k], section_[(k + 1) % section_.size], 0, false);
    keep_deepest();
    for (int k = 0; k < points_; ++k) {
      const Point& p = point_[static_cast<std::size_t>(k)];
      if (p.is_crossing && p.along >= -near_ && p.along <= 1 + near_ && p.below < surface_)
        out.add({w0.x + p.along * x_, w0.y + p.along * y_, p.below, p.id, 0});
    }
    const R below = below_corner();
    if (below < surface_) out.add({w0.x, w0.y, below, w0.id | (is_a_ ? outline::of_a : outline::of_b), 0});
  }

  // A segment that ends on the side, or runs along it, does not cross it; its end there is one of the
  // polygon's corners.
  void cross(const Corner<R>& p, const Corner<R>& q, std::uint32_t id, bool is_crossing) {
    const R s = x_ * (p.y - origin_->y) - y_ * (p.x - origin_->x),
            t = x_ * (q.y - origin_->y) - y_ * (q.x - origin_->x);
    const bool begins = abs(s) <= zero_, ends = abs(t) <= zero_;
    if (begins) add_point(p, 0, false);
    if (ends) add_point(q, 0, false);
    if (begins || ends || (s < 0) == (t < 0)) return;
    const R share = s / (s - t);
    add_point(
        {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y), p.below + share * (q.below - p.below), 0, 0},
        id, is_crossing);
  }

  void add_point(const Corner<R>& at, std::uint32_t id, bool is_crossing) {
    if (points_ == capacity) return;
    const R x = at.x - origin_->x, y = at.y - origin_->y;
    point_[static_cast<std::size_t>(points_++)] = {(x * x_ + y * y_) / (x_ * x_ + y_ * y_), at.below, id,
                                                   is_crossing};
  }

  static R chord(const Point& p, const Point& q, R along) {
    return p.below + (along - p.along) / (q.along - p.along) * (q.below - p.below);
  }

  // Keeps the polygon's corners from end to end along its deep side (Andrew's monotone chain, 1979).
  void keep_deepest() {
    std::sort(point_.begin(), point_.begin() + points_, [](const Point& p, const Point& q) {
      return p.along != q.along ? p.along < q.along : p.below < q.below;
    });
    int kept = 0;
    for (int k = 0; k < points_; ++k) {
      const Point p = point_[static_cast<std::size_t>(k)];
      const auto last = [&](int i) -> const Point& { return point_[static_cast<std::size_t>(kept - i)]; };
      if (kept > 0 && p.along <= last(1).along + near_) {
        if (p.below >= last(1).below) continue;
        --kept;
      }
      while (kept >= 2 && !(last(1).below < chord(last(2), p, last(1).along) - tolerance_)) --kept;
      point_[static_cast<std::size_t>(kept++)] = p;
    }
    points_ = kept;
  }

  // How far below the support plane the polygon is at the side's first corner; infinite beside it.
  R below_corner() const {
    for (int k = 0; k + 1 < points_; ++k) {
      const Point &p = point_[static_cast<std::size_t>(k)], &q = point_[static_cast<std::size_t>(k + 1)];
      if (p.along <= 0 && q.along > 0) return chord(p, q, 0);
    }
    return std::numeric_limits<R>::infinity();
  }

  const Corners<R>& window_;
  bool is_a_;
  R surface_, tolerance_;
  Corners<R> section_;  // where edges leave the limit: in convex order, the polytope's section there
  std::array<EdgePart<R>, static_cast<std::size_t>(capacity)> edge_;
  int size_ = 0;
  // Of one side:
  R x_ = 0, y_ = 0, zero_ = 0, near_ = 0;
  const Corner<R>* origin_ = nullptr;
  std::array<Point, static_cast<std::size_t>(capacity)> point_;
  int points_ = 0;
};

}  // namespace touchstone::narrow::filtered::detail
