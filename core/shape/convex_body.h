// A bounded convex shape as core ⊕ ball: sphere = point ⊕ ball, capsule = segment ⊕ ball, rounded box = box ⊕
// ball; the others are their own core with radius 0. Searches see only the cores, so a shallow contact of
// rounded shapes is a distance between cores, which is well conditioned, instead of a depth.
//
// Each core is a struct in the file of its shape, for R = float, double and Wide. `Core` is the only list of
// them; on_core() calls a function with the core at hand.
#pragma once

#include <concepts>
#include <span>
#include <stdexcept>
#include <variant>

#include "core/shape/shape.h"

namespace touchstone {

namespace convex {

template <class R>
using Core = std::variant<PointCore<R>, SegmentCore<R>, BoxCore<R>, CylinderCore<R>, ConeCore<R>,
                          EllipsoidCore<R>, VerticesCore<R>>;

namespace detail {

/// Takes the corners of a face, as an archetype for the concept below.
template <class R>
struct AnyCorners {
  void add(const V3<R>&, std::uint32_t) {}          // ignored if it is too far below the plane
  void add_certain(const V3<R>&, std::uint32_t) {}  // known to be near enough
  void add_many(const V3<R>&, std::uint32_t) {}     // as add(); there may be more than face_capacity
};

/// Takes edges that begin near a support plane, likewise.
template <class R>
struct AnyEdges {
  void from(const V3<R>&, std::uint32_t) {}
  void to(const V3<R>&, std::uint32_t, R) {}
};

}  // namespace detail

/// What a core provides. Directions are in its own frame, of any length unless stated otherwise.
template <class C, class R>
concept CoreModule = std::is_trivially_copyable_v<C> &&
    requires(const C& c, C& changed, const V3<R>& d, R x, Feature<R>& f, const std::array<V3<R>, 3>& three,
             const FaceQuery<R>& face, detail::AnyCorners<R>& corners, detail::AnyEdges<R>& edges) {
  // All its support points are corners.
  { C::is_polytope } -> std::convertible_to<bool>;
  { C::symmetry } -> std::convertible_to<Symmetry>;
  // Units of rounding by which two support values are compared.
  { C::support_rounding } -> std::convertible_to<int>;
  // A point farthest along d. -0 counts as negative.
  { c.support(d) } -> std::same_as<V3<R>>;
  // Derivative of the support point with respect to a unit direction, where it exists.
  { c.support_derivative(d) } -> std::same_as<M3<R>>;
  // Bounds, up to rounding: of the distance from the origin, of the coordinates, and of the distance from
  // an axis (unit) through the origin.
  { c.reach() } -> std::same_as<R>;
  { c.extent() } -> std::same_as<R>;
  { c.reach_off_axis(d) } -> std::same_as<R>;
  // The axis of (approximate) revolution, or -1.
  { c.round_axis() } -> std::same_as<int>;
  changed.scale(x);

  // The exact support point that a rounded one stands for.
  { c.snap(d) } -> std::same_as<V3<R>>;
  // The feature suggested by three support points of a facet with normal d. The second argument is the
  // core's point of the origin's foot; points within x are the same. A guess that is verified afterwards.
  { c.suggest(three, d, d, x) } -> std::same_as<Feature<R>>;
  // The feature's support point along a unit direction, which lies on its circle if it has one.
  { c.locate(f, d) } -> std::same_as<FeaturePoint<R>>;
  // Replaces a rim by its disc if the direction suggests it.
  { c.use_disc(f, d) } -> std::same_as<bool>;
  // Replaces an edge by the feature at its low or high end.
  c.shorten(f, true);
  // How far a face extends around its point, in its plane: zero or negative when the point is not on it.
  { c.face_margin(f, d) } -> std::same_as<R>;
  // Corners of the supporting face; true: in convex order, either way round.
  { c.face_corners(face, corners) } -> std::same_as<bool>;
  // The edges from those corners, to others of them or farther from the plane, each as edge_within() shows
  // it.
  c.edges_within(face, edges);
  // A bound, up to rounding, of the lengths of what of those edges is within the limit.
  { c.edge_reach(face) } -> std::same_as<R>;
} &&(C::is_polytope ||
     requires(const C& c, const Feature<R>& f, const FeaturePoint<R>& at, const V3<R>& d, R x,
              const Tangents<R>& tangents, const Cap<R>& cap, TangentForm<R>& form) {
       // The derivative of the support point, as a form over two tangents.
       c.add_second_derivative(at, d, d, form);
       // Curvature that the support function is proven to have in a cap (local_depth.h). The numbers: the
       // parameter on an edge, and the share of an edge's length that is left to the proof by its length,
       // where the core cannot have all of both; edge_share() is that share or 1.
       c.add_curvature(f, x, tangents, cap, x, form);
       { c.edge_share(f, x) } -> std::same_as<R>;
     }) &&
    (C::symmetry != Symmetry::axis ||
     requires(const C& c) { c.for_each_slant([](R, R) {}); });  // see ConeCore

namespace detail {

template <class R, class... C>
constexpr bool check_cores(const std::variant<C...>*) {
  static_assert((CoreModule<C, R> && ...), "a core lacks a part; see CoreModule");
  return true;
}
static_assert(check_cores<float>(static_cast<const Core<float>*>(nullptr)));
static_assert(check_cores<double>(static_cast<const Core<double>*>(nullptr)));
static_assert(check_cores<Wide>(static_cast<const Core<Wide>*>(nullptr)));

}  // namespace detail
}  // namespace convex

template <class R>
struct ConvexBody {
  convex::Core<R> core;
  R radius = 0;  // of the ball
  R reach = 0;   // of the core about the body's origin, rounded
  R extent = 0;  // bound on the largest coordinate of a point of the body

  ConvexBody() = default;
  template <class C>
  requires convex::CoreModule<C, R>
  explicit ConvexBody(const C& c, R ball = 0)
      : core(c), radius(ball), reach(c.reach()), extent(c.extent() + ball) {}

  /// By a power of two, which is exact.
  void scale(R unit) {
    std::visit([&](auto& c) { c.scale(unit); }, core);
    radius *= unit;
    reach *= unit;
    extent *= unit;
  }
};

namespace convex::detail {

// A chain of comparisons with constants, which compilers turn into a switch. std::visit does the same behind
// a call, which costs a search in double up to a tenth.
template <std::size_t i, class V, class F>
[[gnu::always_inline]] inline decltype(auto) visit_from(V& core, F&& f) {
  if constexpr (i + 1 == std::variant_size_v<std::remove_const_t<V>>) {
    return f(*std::get_if<i>(&core));
  } else {
    if (core.index() == i) return f(*std::get_if<i>(&core));
    return visit_from<i + 1>(core, f);
  }
}

}  // namespace convex::detail

/// f(core), which returns the same type for every core.
template <class R, class F>
[[gnu::always_inline]] inline decltype(auto) on_core(const ConvexBody<R>& b, F&& f) {
  return convex::detail::visit_from<0>(b.core, f);
}

/// Precondition: a bounded convex shape. The body refers to a hull's vertices and graph; the graph, if any,
/// belongs to that hull.
template <class R>
ConvexBody<R> convex_body(const Shape& shape, [[maybe_unused]] const HullGraph* graph = nullptr) {
  return std::visit(
      [&]<class S>(const S& s) -> ConvexBody<R> {
        if constexpr (requires { s.template core<R>(graph); })
          return ConvexBody<R>(s.template core<R>(graph), static_cast<R>(s.ball_radius()));
        else if constexpr (is_convex_shape<S>)
          return ConvexBody<R>(s.template core<R>(), static_cast<R>(s.ball_radius()));
        else
          throw std::invalid_argument("not a bounded convex shape");
      },
      shape);
}

/// The convex hull of a few points, which outlive it.
template <class R>
ConvexBody<R> body_of_vertices(std::span<const Vec3> vertices) {
  return ConvexBody<R>(convex::VerticesCore<R>(vertices));
}

/// A core point farthest along d.
template <class R>
V3<R> support_local(const ConvexBody<R>& b, const V3<R>& d) {
  return on_core(b, [&](const auto& c) { return c.support(d); });
}

template <class R>
M3<R> support_derivative(const ConvexBody<R>& b, const V3<R>& d) {
  return on_core(b, [&](const auto& c) { return c.support_derivative(d); });
}

template <class R>
bool is_polytope(const ConvexBody<R>& b) {
  return on_core(b, [](const auto& c) { return c.is_polytope; });
}

template <class R>
bool is_curved(const ConvexBody<R>& b) {
  return !is_polytope(b);
}

template <class R>
convex::Symmetry symmetry(const ConvexBody<R>& b) {
  return on_core(b, [](const auto& c) { return c.symmetry; });
}

/// A bounded convex shape without a ball whose core is a polytope, whatever its sizes.
template <class S>
inline constexpr bool is_polytope_shape = [] {
  if constexpr (is_convex_shape<S>)
    return !S::has_ball && decltype(std::declval<const S&>().template core<double>())::is_polytope;
  else
    return false;
}();

}  // namespace touchstone
