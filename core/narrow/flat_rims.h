// Contacts of cylinders and cones beyond their polygons. Where a flat round face (the cap of a cylinder, the
// base of a cone) supports its body, the outline is a polygon inscribed in the rim (rim.h). Where the other
// body's outline cuts it, that loses up to half a percent of the radius, and of a small piece most of the
// area. Here are the points that it loses: where the rim itself crosses the other outline, corners of that
// between the rim and its polygon, and points on short arcs.
#pragma once

#include <algorithm>
#include <optional>

#include "core/narrow/outline.h"
#include "core/shape/cone.h"
#include "core/shape/cylinder.h"
#include "core/shape/rim.h"

namespace touchstone::narrow::outline {

/// A rim in the plane of a contact.
template <class R>
struct Circle {
  R x, y, radius;
};

/// The rim that bounds the face of a core along at.d, if all of it is within at.limit of the support plane:
/// its centre, and its radius.
template <class R>
using RimOfCore = std::optional<std::pair<V3<R>, R>>;

template <class R>
RimOfCore<R> rim_at(R z, R radius, const convex::FaceQuery<R>& at) {
  const bool is_flat = radius > 0 && at.top - at.d[2] * z + radius * convex::flat_length(at.d) <= at.limit;
  return is_flat ? RimOfCore<R>({V3<R>(0, 0, z), radius}) : std::nullopt;
}
template <class R>
RimOfCore<R> flat_rim(const convex::CylinderCore<R>& c, const convex::FaceQuery<R>& at) {
  return rim_at<R>(convex::toward(c.half_height, at.d[2]), c.radius, at);
}
template <class R>
RimOfCore<R> flat_rim(const convex::ConeCore<R>& c, const convex::FaceQuery<R>& at) {
  return rim_at<R>(-c.half_height, c.radius, at);
}
template <class C, class R>
RimOfCore<R> flat_rim(const C&, const convex::FaceQuery<R>&) {
  return std::nullopt;
}

/// A point that is as near as `near` to the rim of a core, on it; any other as it is.
template <class R>
V3<R> on_rim(R z, R radius, const V3<R>& p, R near) {
  const R flat = convex::flat_length(p);
  if (!(flat > 0) || abs(flat - radius) > near || abs(p[2] - z) > near) return p;
  return {p[0] * (radius / flat), p[1] * (radius / flat), z};
}
template <class R>
V3<R> snapped_to_rim(const convex::CylinderCore<R>& c, const V3<R>& p, R near) {
  return on_rim<R>(convex::toward(c.half_height, p[2]), c.radius, p, near);
}
template <class R>
V3<R> snapped_to_rim(const convex::ConeCore<R>& c, const V3<R>& p, R near) {
  return on_rim<R>(-c.half_height, c.radius, p, near);
}
template <class C, class R>
V3<R> snapped_to_rim(const C&, const V3<R>& p, R) {
  return p;
}

/// The radius of a core at the straight lines on its side: of a cylinder. 0: it has edges there, or none.
template <class R>
R side_radius(const convex::CylinderCore<R>& c) {
  return c.radius;
}
template <template <class> class C, class R>
R side_radius(const C<R>&) {
  return 0;
}

namespace detail {

/// Cosine of the arcs that have four corners of the polygon inside at least: longer ones are left alone.
inline constexpr double short_arc_cosine = 0.55;
/// An arc is halved so often: what eight chords lose of its segment is 1/64. Tested by: tests/core "a cut rim
/// covers its contact".
inline constexpr int arc_halvings = 3;
/// Chords of rims that are shorter than this · the radius are points.
inline constexpr double least_chord = 0x1p-10;
/// Edge number of a rim in the id of a crossing.
inline constexpr std::uint32_t rim_edge = 0x7e00u;

template <class R>
class CutRim {
 public:
  CutRim(const Circle<R>& c, bool is_a, R tolerance, Corners<R>& out)
      : c_(c), is_a_(is_a), tolerance_(tolerance), out_(out) {}

  /// `w`: a polygon or a segment.
  void by(const Corners<R>& w) {
    const int edges = w.size == 2 ? 1 : w.size;
    for (int i = 0; i < edges; ++i) cross(w[i], w[(i + 1) % w.size]);
    // Corners between the rim and the edges of its polygon, and those on the rim.
    for (const Corner<R>& c : w) {
      const R d = distance(c);
      if (!(d > inner_share * c_.radius) || d > c_.radius + tolerance_) continue;
      const Corner<R> corner{c.x, c.y, 0, c.id | (is_a_ ? of_b : of_a), 0};
      out_.add(corner);
      if (d >= c_.radius - tolerance_) crossings_.add(corner);
    }
    if (w.size > 2) add_arcs([&](const Corner<R>& p) { return holds(w, p, tolerance_); });
  }
  /// `other`: of a second rim. Each of the two adds its own arc, one of them the crossings.
  void by(const Circle<R>& other) {
    const R dx = other.x - c_.x, dy = other.y - c_.y, sq = dx * dx + dy * dy;
    if (!(sq > 0)) return;
    const R along = (c_.radius * c_.radius - other.radius * other.radius + sq) / (2 * sq),
            across_sq = c_.radius * c_.radius / sq - along * along;
    if (!(across_sq > 0)) return;
    const R across = sqrt(across_sq);
    std::uint32_t number = 0;
    for (const R s : {R(-across), across})
      add_crossing({c_.x + along * dx - s * dy, c_.y + along * dy + s * dx, 0,
                    crossing | rim_edge << 15 | (rim_edge + number++), 0});
    add_arcs([&](const Corner<R>& p) {
      const R x = p.x - other.x, y = p.y - other.y;
      return x * x + y * y <= other.radius * other.radius;
    });
  }

 private:
  /// Cosine of half the angle between two corners, rounded down.
  static constexpr double inner_share = 0.995;

  R distance(const Corner<R>& p) const {
    const R x = p.x - c_.x, y = p.y - c_.y;
    return sqrt(x * x + y * y);
  }

  void cross(const Corner<R>& p, const Corner<R>& q) {
    const R dx = q.x - p.x, dy = q.y - p.y, x = p.x - c_.x, y = p.y - c_.y;
    const R sq = dx * dx + dy * dy, half = x * dx + y * dy;
    const R square = half * half - sq * (x * x + y * y - c_.radius * c_.radius);
    // Where the edge touches the rim, rounding decides whether it crosses it.
    const R touching = static_cast<R>(least_chord) * c_.radius;
    if (!(4 * square > sq * touching * touching)) return;
    const R root = sqrt(square);
    const std::uint32_t own = edge_id(p.id, q.id);
    std::uint32_t number = 0;
    for (const R t : {R((-half - root) / sq), R((-half + root) / sq)}) {
      const std::uint32_t rim = rim_edge + number++;
      if (t > 0 && t < 1)
        add_crossing(
            {p.x + t * dx, p.y + t * dy, 0, crossing | (is_a_ ? rim << 15 | own : own << 15 | rim), 0});
    }
  }
  void add_crossing(const Corner<R>& p) {
    crossings_.add(p);
    out_.add(p);
  }

  // Grows with the angle of the point about the centre.
  R order(const Corner<R>& p) const {
    const R x = p.x - c_.x, y = p.y - c_.y, share = x / (abs(x) + abs(y));
    return y >= 0 ? R(1 - share) : R(3 + share);
  }

  template <class Inside>
  void add_arcs(const Inside& is_inside) {
    std::sort(crossings_.begin(), crossings_.end(),
              [&](const Corner<R>& p, const Corner<R>& q) { return order(p) < order(q); });
    for (int k = 0; k < crossings_.size; ++k) {
      const Corner<R>&p = crossings_[k], &q = crossings_[(k + 1) % crossings_.size];
      const R px = p.x - c_.x, py = p.y - c_.y, qx = q.x - c_.x, qy = q.y - c_.y;
      const bool is_short = px * qy - py * qx > 0 &&
                            px * qx + py * qy > static_cast<R>(short_arc_cosine) * c_.radius * c_.radius;
      const R x = qx - px, y = qy - py, least = static_cast<R>(least_chord) * c_.radius;
      if (is_short && x * x + y * y > least * least && is_inside(middle(p, q))) halve(p, q, arc_halvings);
    }
  }
  Corner<R> middle(const Corner<R>& p, const Corner<R>& q) const {
    const R x = p.x + q.x - 2 * c_.x, y = p.y + q.y - 2 * c_.y, k = c_.radius / sqrt(x * x + y * y);
    return {c_.x + k * x, c_.y + k * y, 0, 0, 0};
  }
  void halve(const Corner<R>& p, const Corner<R>& q, int times) {
    if (times == 0) return;
    const Corner<R> m = middle(p, q);
    out_.add(m);
    halve(p, m, times - 1);
    halve(m, q, times - 1);
  }

  Circle<R> c_;
  bool is_a_;
  R tolerance_;
  Corners<R>& out_;
  Corners<R> crossings_;
};

}  // namespace detail

/// Adds to `region`, the intersection of two supporting faces, what it loses at their rims; the crossings of
/// the inscribed polygons go. In convex order, with no more corners than a whole rim, unless a corner lies
/// below the faces. The outlines have two corners at least.
template <class R>
void complete_rims(const Corners<R>& a, const std::optional<Circle<R>>& rim_a, const Corners<R>& b,
                   const std::optional<Circle<R>>& rim_b, R tolerance, Corners<R>& region) {
  Corners<R> all;
  if (rim_a && rim_b) {
    detail::CutRim<R>(*rim_a, true, tolerance, all).by(*rim_b);
    Corners<R> of_second;
    detail::CutRim<R>(*rim_b, false, tolerance, of_second).by(*rim_a);
    for (const Corner<R>& c : of_second)
      if (c.id == 0) all.add(c);
  } else {
    detail::CutRim<R>(rim_a ? *rim_a : *rim_b, rim_a.has_value(), tolerance, all).by(rim_a ? b : a);
  }
  if (all.size == 0) return;
  bool is_flat = true;
  for (const Corner<R>& c : region) {
    is_flat &= c.below <= tolerance;
    if (!(c.id & crossing) || c.below > tolerance) all.add(c);
  }
  if (is_flat) {
    // Of the corners that the region had, every other one, from the last.
    for (int k = all.size - 1; k >= 0 && all.size > convex::rim_corners; k -= 2) {
      std::copy(all.begin() + k + 1, all.end(), all.begin() + k);
      --all.size;
    }
    convex_order(all, tolerance);
  }
  region = all;
}

}  // namespace touchstone::narrow::outline
