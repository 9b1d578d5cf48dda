// Contact manifold in double or float, in fixed storage. Reference: the face (three points or more) of one
// body that supports it along the normal. Incident: what the other body has beyond the reference's plane and
// within its border; exactly of a polytope (beyond_face.h), of a round body by its outline, clipped against
// the reference (core/narrow/outline.h). Each point keeps its own depth. Chords of the incident body lie
// inside it, so every point lies within its depth of both bodies, halfway between the incident body and the
// plane. A face tilted by a few ulp therefore stays complete and does not flicker. Without a face: overlap or
// crossing of two edges, or the deepest vertex; and where faces or edges are parallel up to a small angle,
// what they have in common (nearly_parallel.h).
//
// Ids name features: a corner of A, a corner of B, or an edge of A that crosses an edge of B. They do not
// depend on which body is the reference or where its outline starts; both change with an ulp when faces lie
// on each other.
#pragma once

#include "core/narrow/filtered/beyond_face.h"
#include "core/narrow/filtered/nearly_parallel.h"
#include "core/narrow/filtered/query.h"
#include "core/narrow/flat_rims.h"
#include "core/narrow/outline.h"
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

template <class R>
struct PatchPlane {
  V3<R> n, x, y, origin;  // A's frame
  explicit PatchPlane(const V3<R>& normal) : n(normal), x(normal.unitOrthogonal()), y(normal.cross(x)) {}
};

/// Corners of `c` at most `limit` below its support plane, into `out`, which is empty. `at`: of c in A's
/// frame; null: c is A. `support`: a support point of c along sign · n, both in its own frame.
template <class R>
class FeatureCorners {
 public:
  FeatureCorners(const ConvexBody<R>& c, const Relative<R>* at, const PatchPlane<R>& plane, R sign,
                 const V3<R>& support, R limit, R tolerance, Corners<R>& out)
      : c_(c), placed_(at), plane_(plane), support_(support), out_(out) {
    const V3<R> d = sign * plane.n;
    at_.d = at ? V3<R>(at->b_to_a.transpose() * d) : d;
    at_.top = at_.d.dot(support);
    at_.limit = limit;
    at_.tolerance = tolerance;
  }

  /// Their outline in convex order; the others into `inside`, if that is not null.
  void collect(Corners<R>* inside = nullptr) {
    const bool ordered = on_core(c_, [&](const auto& core) { return core.face_corners(at_, *this); });
    if (ordered && out_.size >= 4) {
      if (outline::turn(out_[0], out_[1], out_[2]) < 0) std::reverse(out_.begin(), out_.end());
      return;
    }
    if (out_.size == 0 && !out_.overflow) add_certain(support_, 0);
    if (inside && out_.size > 3) *inside = out_;
    outline::convex_order(out_, at_.tolerance);
    if (!inside) return;
    const auto is_drawn = [&](const Corner<R>& c) {
      return std::ranges::any_of(out_, [&](const Corner<R>& o) { return o.id == c.id; });
    };
    inside->size =
        static_cast<int>(std::remove_if(inside->begin(), inside->end(), is_drawn) - inside->begin());
  }

  void add(const V3<R>& p, std::uint32_t id) {
    if (at_.top - at_.d.dot(p) <= at_.limit) add_certain(p, id);
  }
  void add_certain(const V3<R>& p, std::uint32_t id) { out_.add(flat(p, id)); }
  // Keeps their outline. If it has more corners than fit, every other one is kept: 36 corners of a circle
  // still cover 99.5 % of its area.
  void add_many(const V3<R>& p, std::uint32_t id) {
    add(p, id);
    if (out_.size < Corners<R>::capacity) return;
    outline::convex_order(out_, at_.tolerance);
    if (2 * out_.size <= Corners<R>::capacity) return;
    for (int k = 0; 2 * k < out_.size; ++k) out_[k] = out_[2 * k];
    out_.size = (out_.size + 1) / 2;
  }

  /// Whether these corners, and all that edges from them reach within the limit, lie inside `window`.
  bool stay_inside(const Corners<R>& window) const {
    const R along = on_core(c_, [&](const auto& core) { return core.edge_reach(at_); });
    const R reach = std::min<R>(along, 2 * c_.reach) + at_.tolerance;
    for (int i = 0; i < window.size; ++i) {
      const Corner<R>&w0 = window[i], &w1 = window[(i + 1) % window.size];
      const R ex = w1.x - w0.x, ey = w1.y - w0.y, least = reach * reach * (ex * ex + ey * ey);
      for (const Corner<R>& c : out_)
        if (const R s = outline::turn(w0, w1, c); !(s > 0 && s * s >= least)) return false;
    }
    return true;
  }
  /// The rim within the limit, if that is what bounds the face.
  std::optional<outline::Circle<R>> rim() const {
    const auto found = on_core(c_, [&](const auto& core) { return outline::flat_rim(core, at_); });
    if (!found) return std::nullopt;
    const Corner<R> centre = flat(found->first, 0);
    return outline::Circle<R>{centre.x, centre.y, found->second};
  }
  bool is_polytope() const {
    return on_core(c_, [](const auto& core) { return core.is_polytope; });
  }
  /// f(part, leaves) for each edge from these corners; leaves: it goes on beyond the limit.
  template <class F>
  void for_each_edge(const F& f) const {
    Edges<F> edges{*this, f, {}};
    on_core(c_, [&](const auto& core) { core.edges_within(at_, edges); });
  }

 private:
  template <class F>
  struct Edges {
    const FeatureCorners& of;
    const F& show;
    Corner<R> begin;

    void from(const V3<R>& p, std::uint32_t id) { begin = of.flat(p, id); }
    void to(const V3<R>& p, std::uint32_t id, R share) {
      const Corner<R> other = of.flat(p, id);
      const Corner<R> end{begin.x + share * (other.x - begin.x), begin.y + share * (other.y - begin.y),
                          begin.below + share * (other.below - begin.below), id, 0};
      show(EdgePart<R>{begin, end, outline::edge_id(begin.id, id)}, share < 1);
    }
  };

  Corner<R> flat(const V3<R>& p, std::uint32_t id) const {
    const V3<R> q = (placed_ ? V3<R>(placed_->b_to_a * p + placed_->offset) : p) - plane_.origin;
    return {plane_.x.dot(q), plane_.y.dot(q), std::max<R>(0, at_.top - at_.d.dot(p)), id, 0};
  }

  const ConvexBody<R>& c_;
  const Relative<R>* placed_;
  const PatchPlane<R>& plane_;
  const V3<R>& support_;
  convex::FaceQuery<R> at_;
  Corners<R>& out_;
};

template <class R, class F>
void drop(Corners<R>& corners, const F& is_one) {
  corners.size = static_cast<int>(std::remove_if(corners.begin(), corners.end(), is_one) - corners.begin());
}

/// What a round body has beyond the plane of a face, inside the window, as far as its corners and the edge
/// through its support point represent it.
template <class R>
void clip_round(const FeatureCorners<R>& incident, Corners<R>& region, const Corners<R>& window,
                bool window_is_a, R tolerance, R surface) {
  Corners<R> ends, crossings;
  incident.for_each_edge([&](const EdgePart<R>& e, bool leaves) {
    if (leaves) ends.add(e.to);
    const auto c = outline::crossings_of(e.from, e.to, window, tolerance);
    for (const auto& [along, border] : {std::pair(c.enters, c.entrance), std::pair(c.leaves, c.exit)})
      if (border >= 0)
        crossings.add({e.from.x + along * (e.to.x - e.from.x), e.from.y + along * (e.to.y - e.from.y),
                       e.from.below + along * (e.to.below - e.from.below),
                       outline::crossing_id(e.id, window, border, window_is_a), 0});
  });
  if (crossings.size == 0) return outline::clip(region, window, tolerance, window_is_a);
  const Corners<R> corners = region;
  for (const Corner<R>& c : ends) region.add(c);
  outline::convex_order(region, tolerance);
  outline::clip(region, window, tolerance, window_is_a);
  // The outline crosses the border along edges, or between them, where the body is less deep. It may lead
  // around corners and over edges.
  drop(region, [](const Corner<R>& c) { return (c.id & outline::crossing) != 0; });
  for (Corner<R> c : corners) {
    c.id |= window_is_a ? outline::of_b : outline::of_a;
    const auto is_same = [&](const Corner<R>& r) { return r.id == c.id; };
    if (outline::holds(window, c, tolerance) && std::none_of(region.begin(), region.end(), is_same))
      region.add(c);
  }
  for (const Corner<R>& c : crossings) region.add(c);
  drop(region, [&](const Corner<R>& c) { return c.below >= surface; });
}

/// The nearest points of round cores that a ball keeps apart are known across the normal to the root of their
/// distance's error, in units of size. A support point that near is the foot itself, on the surface to
/// rounding. Tested by: tests/core "the deepest point of a manifold lies on a rim".
inline constexpr double foot_factor = 0x1p-26;

/// Two edges: their common interval when they are collinear, otherwise their crossing. The ends of `a` may be
/// exchanged.
template <class R>
Corners<R> cross_edges(Corners<R>& a, const Corners<R>& b, R tolerance) {
  if (a[1].id < a[0].id) std::swap(a[0], a[1]);  // the first end keeps its id
  const std::uint32_t id = outline::id_of_edges(a, b);
  const outline::EdgePair<R> e(a, b);
  if (e.is_collinear(tolerance)) return e.common(id);
  Corners<R> r;
  if (!(e.s0 * e.s1 <= 0)) return r;
  const R t = e.s0 / (e.s0 - e.s1);
  r.add({b[0].x + (b[1].x - b[0].x) * t, b[0].y + (b[1].y - b[0].y) * t, 0, id, 0});
  return r;
}

/// How an edge is rounded that two corners of the body's outline stand for.
template <class R>
R edge_radius(const ConvexBody<R>& c) {
  return c.radius + on_core(c, [](const auto& core) { return outline::side_radius(core); });
}

}  // namespace detail

/// Manifold of cores a, b (b at `at`; null: a half-space) along n (A's frame, unit, A to B), where `gap` is
/// the gap of the rounded bodies along n, at most `margin` up to rounding: what is no farther apart along n
/// than the margin, with negative depths of what is apart. size 0: too many corners for the storage.
template <class R>
Patch<R> contact_patch(const ConvexBody<R>& a, const ConvexBody<R>* b, const Relative<R>& at, const V3<R>& n,
                       R gap, R margin, const V3<R>* middle) {
  using namespace detail;
  const R size = a.reach + a.radius + (b ? b->reach + b->radius + at.offset.norm() : 0);
  const R tolerance = rounding::corner_distance * u<R> * size;
  // How far B would reach into A if it were nearer by the margin; the depth of the deepest point.
  const R depth = std::max<R>(0, margin - gap), deepest = std::max<R>(-margin, -gap);
  PatchPlane<R> plane(n);
  const V3<R> top_a = support_local<R>(a, n);
  const V3<R> top_b = b ? support_local<R>(*b, V3<R>(at.b_to_a.transpose() * -n)) : top_a;
  plane.origin = top_a;
  Corners<R> fa, fb, region;
  const auto of_a = [&](R limit, Corners<R>& out) {
    return FeatureCorners<R>(a, nullptr, plane, 1, top_a, limit, tolerance, out);
  };
  const auto of_b = [&](R limit, Corners<R>& out) {
    return FeatureCorners<R>(*b, &at, plane, -1, top_b, limit, tolerance, out);
  };
  const auto show_a = [&](R limit, Corners<R>& out) { of_a(limit, out).collect(); };
  const auto show_b = [&](R limit, Corners<R>& out) { of_b(limit, out).collect(); };
  // Collects the outline in `region`; the result: corners that are deeper than what it spans.
  const auto collect = [&](FeatureCorners<R> incident) {
    Corners<R> inside;
    incident.collect(&inside);
    drop(inside, [&](const Corner<R>& c) { return !(c.below < below_at(region, c.x, c.y) - tolerance); });
    // A hull's graph gives them in another order.
    std::sort(inside.begin(), inside.end(),
              [](const Corner<R>& c, const Corner<R>& d) { return c.id < d.id; });
    return inside;
  };
  const auto add_as = [&](const Corners<R>& corners, std::uint32_t side) {
    for (Corner<R> c : corners) {
      c.id |= side;
      region.add(c);
    }
  };
  // Without what is on the surface.
  const R surface = std::max<R>(depth, 2 * tolerance) - tolerance;
  // The part of the other body beyond the plane of a face, as far as the face goes.
  const auto clipped = [&](const FeatureCorners<R>& incident, const Corners<R>& window, bool window_is_a) {
    const std::uint32_t side = window_is_a ? outline::of_b : outline::of_a;
    Corners<R> deep = collect(incident);
    const auto is_outside = [&](const Corner<R>& c) { return !outline::holds(window, c, tolerance); };
    if (incident.stay_inside(window)) {
      for (Corner<R>& c : region) c.id |= side;
      return add_as(deep, side);
    }
    drop(deep, is_outside);
    BeyondFace<R> beyond(window, window_is_a, surface, tolerance);
    if (incident.is_polytope())
      incident.for_each_edge([&](const EdgePart<R>& e, bool leaves) { beyond.add_edge(e, leaves); });
    if (beyond.has_edges()) {
      drop(region, is_outside);
      for (Corner<R>& c : region) c.id |= side;
      add_as(deep, side);
      return beyond.show(region);
    }
    // A round body, or one corner.
    clip_round(incident, region, window, window_is_a, tolerance, surface);
    add_as(deep, side);
  };
  Patch<R> patch;
  show_a(tolerance, fa);
  bool by_a = true;
  if (!b) {
    const Corners<R> deep = collect(of_a(depth + tolerance, region));
    for (Corner<R>& c : region) c.id |= outline::of_a;
    add_as(deep, outline::of_a);
    by_a = false;
  } else if (fa.size >= 3) {
    clipped(of_b(depth + tolerance, region), fa, true);
  } else {
    show_b(tolerance, fb);
    if (fb.size >= 3) {
      by_a = false;
      clipped(of_a(depth + tolerance, region), fb, false);
    } else if (fa.size == 2 && fb.size == 2) {
      region = cross_edges(fa, fb, 4 * tolerance);
    }
  }
  if (b) {
    Corners<R> none;
    const auto rim_a = of_a(tolerance, none).rim(), rim_b = of_b(tolerance, none).rim();
    if (rim_a || rim_b) {
      if (fb.size == 0) show_b(tolerance, fb);
      if (fa.size > 1 && fb.size > 1) outline::complete_rims(fa, rim_a, fb, rim_b, tolerance, region);
    }
  }
  if (region.overflow || fa.overflow || fb.overflow) return patch;
  // The number of the point; an earlier one if that is not farther away than `same`.
  const auto add = [&](R x, R y, R below_a, R below_b, std::uint32_t id, R same) {
    const R height = a.radius + (gap + below_b - below_a) / 2;
    const V3<R> p = plane.origin + plane.x * x + plane.y * y + n * height;
    const R d = -gap - below_a - below_b;
    for (int k = 0; k < patch.size; ++k)
      if ((patch.point[static_cast<std::size_t>(k)].p - p).squaredNorm() <= same * same) return k;
    patch.point[static_cast<std::size_t>(patch.size)] = {p, std::max<R>(-margin, d), id};
    return patch.size++;
  };
  // Height of A's support plane above plane.origin is the ball's radius.
  const int kept = std::min(region.size, Patch<R>::capacity);
  for (int i = 0; i < kept; ++i) {
    const Corner<R>& c = region[i * region.size / kept];
    add(c.x, c.y, by_a ? R(0) : c.below, by_a ? c.below : R(0), c.id, tolerance);
  }
  // Without a region the deepest point alone; and corners that represent a rim may all be less deep than the
  // rim between them.
  const auto less_deep = [&](const PatchPoint<R>& p) { return p.depth < deepest - tolerance; };
  // Of the body with the smaller ball, on whose surface a lateral error counts most.
  const auto middle_on_foot = [&] {
    if (!b || a.radius + b->radius == 0) return *middle;
    const V3<R> foot = a.radius < b->radius
                           ? V3<R>(top_a + n * (a.radius + gap / 2))
                           : V3<R>(at.b_to_a * top_b + at.offset - n * (b->radius + gap / 2));
    const R same = static_cast<R>(foot_factor) * size;
    if ((foot - *middle).squaredNorm() <= same * same) return foot;
    // Elsewhere on the rim.
    const auto on_core_of = [&](const ConvexBody<R>& c, const V3<R>& p) {
      return on_core(c, [&](const auto& core) { return outline::snapped_to_rim(core, p, same); });
    };
    if (a.radius < b->radius) {
      const V3<R> rise = n * (a.radius + gap / 2);
      return V3<R>(on_core_of(a, V3<R>(*middle - rise)) + rise);
    }
    const V3<R> rise = at.offset - n * (b->radius + gap / 2);
    return V3<R>(at.b_to_a * on_core_of(*b, V3<R>(at.b_to_a.transpose() * (*middle - rise))) + rise);
  };
  if (middle && std::all_of(patch.point.begin(), patch.point.begin() + patch.size, less_deep) &&
      patch.size < Patch<R>::capacity)
    patch.point[static_cast<std::size_t>(patch.size++)] = {middle_on_foot(), deepest, 0};
  // Not of the distance between the bodies, with which it would change as they move.
  const R own_size = a.reach + a.radius + (b ? b->reach + b->radius : 0);
  const R near = std::min<R>(depth / 2, static_cast<R>(tolerance::manifold_region_factor) * own_size);
  const bool has_face = !b || fa.size >= 3 || fb.size >= 3;
  if (has_face || patch.size > 1 || near <= tolerance) return patch;
  Corners<R> near_a, near_b;
  show_a(near, near_a);
  show_b(near, near_b);
  const R beside = static_cast<R>(tolerance::manifold_beside_factor) * own_size;
  const Spots<R> spots =
      nearly_parallel_spots(near_a, near_b, edge_radius(a), edge_radius(*b), tolerance, beside);
  const R same = static_cast<R>(tolerance::manifold_same_factor) * own_size;
  // The first point is the deepest. It stays if it is a corner of the region, or if none of them is as deep.
  bool keeps_first = true;
  bool is_corner = patch.size == 0;
  for (int i = 0; i < std::min(spots.size, Patch<R>::capacity - 1); ++i) {
    const Spot<R>& s = spots.spot[static_cast<std::size_t>(i)];
    if (!(s.below_a + s.below_b < depth)) continue;
    keeps_first &= s.below_a + s.below_b > tolerance;
    if (add(s.x, s.y, s.below_a, s.below_b, s.id, same) > 0) continue;
    is_corner = true;
    if (patch.point[0].id == 0) patch.point[0].id = s.id;
  }
  if (!keeps_first && !is_corner && patch.size > 2) {
    patch.point[0] = patch.point[static_cast<std::size_t>(patch.size - 1)];
    --patch.size;
  }
  return patch;
}

}  // namespace touchstone::narrow::filtered
