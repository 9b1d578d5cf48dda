// Closed set of the points within `padding` of another convex shape, its core: cylinder, cone, ellipsoid or
// hull. Padded spheres, boxes and capsules are a sphere, a rounded box and a capsule: see padded() in
// core/shape/shape.h.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

#include "core/math/pose.h"
#include "core/shape/bounds.h"
#include "core/shape/cone.h"
#include "core/shape/cylinder.h"
#include "core/shape/ellipsoid.h"
#include "core/shape/field.h"
#include "core/shape/hull.h"

namespace touchstone {

namespace detail {

/// "padded_" and the name of the core.
template <class S>
inline constexpr auto padded_name = [] {
  constexpr std::string_view prefix = "padded_";
  std::array<char, prefix.size() + S::type.size()> name{};
  std::copy(S::type.begin(), S::type.end(), std::copy(prefix.begin(), prefix.end(), name.begin()));
  return name;
}();

}  // namespace detail

template <class S>
struct Padded {
  S inner;
  double padding = 0;
  static constexpr std::string_view type{detail::padded_name<S>.data(), detail::padded_name<S>.size()};
  static constexpr auto fields() {
    const auto of_inner = [](const auto&... f) { return std::tuple{InnerField{&Padded::inner, f}...}; };
    return std::tuple_cat(std::apply(of_inner, S::fields()),
                          std::tuple{Field{"padding", &Padded::padding, Domain::non_negative}});
  }

  /// A hull's takes its graph, too.
  template <class R, class... Graph>
  requires requires(const S& s, Graph... graph) { s.template core<R>(graph...); }
  auto core(Graph... graph) const { return inner.template core<R>(graph...); }
  static constexpr bool has_ball = true;
  double ball_radius() const { return padding; }
  bool is_ball() const { return inner.is_ball(); }
  double bounding_radius() const { return inner.bounding_radius() + padding; }
  double extent() const { return inner.extent() + padding; }
  template <class T>
  Interval<T> extent_along(const V3<T>& d) const {
    const Interval<T> x = inner.template extent_along<T>(d);
    return {x.lo - static_cast<T>(padding), x.hi + static_cast<T>(padding)};
  }
  Wide coordinate_sum() const { return inner.coordinate_sum() + padding; }
  InnerRadii inner_radii() const {
    const InnerRadii r = inner.inner_radii();
    return {r.anywhere + padding, r.about_origin + padding};
  }
  bool operator==(const Padded& o) const { return inner == o.inner && padding == o.padding; }
};

template <class S>
Vec3 support(const Padded<S>& p, const Vec3& d) {
  const double n = d.norm();
  const Vec3 ball = n > 0 ? Vec3(d * (p.padding / n)) : Vec3(p.padding, 0, 0);
  return ball + support(p.inner, d);
}

}  // namespace touchstone
