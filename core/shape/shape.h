// The variant of all shapes.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/math/aabb.h"
#include "core/shape/box.h"
#include "core/shape/capsule.h"
#include "core/shape/cone.h"
#include "core/shape/cylinder.h"
#include "core/shape/ellipsoid.h"
#include "core/shape/half_space.h"
#include "core/shape/hull.h"
#include "core/shape/padded.h"
#include "core/shape/rounded_box.h"
#include "core/shape/solid_mesh.h"
#include "core/shape/sphere.h"
#include "core/shape/triangle_mesh.h"

namespace touchstone {

using Shape =
    std::variant<Sphere, Box, Capsule, Cylinder, Cone, Ellipsoid, Hull, HalfSpace, TriangleMesh, RoundedBox,
                 SolidMesh, Padded<Cylinder>, Padded<Cone>, Padded<Ellipsoid>, Padded<Hull>>;

/// Index of a shape type in the variant. The numbers are part of the C ABI (oracles/abi/touchstone_engine.h).
enum class ShapeKind : int {
  sphere,
  box,
  capsule,
  cylinder,
  cone,
  ellipsoid,
  hull,
  half_space,
  mesh,
  rounded_box,
  solid_mesh,
  padded_cylinder,
  padded_cone,
  padded_ellipsoid,
  padded_hull
};
inline constexpr int shape_kind_count = static_cast<int>(std::variant_size_v<Shape>);
static_assert(static_cast<int>(ShapeKind::padded_hull) + 1 == shape_kind_count,
              "ShapeKind names every shape");

inline ShapeKind kind_of(const Shape& s) { return static_cast<ShapeKind>(s.index()); }

/// The exceptions are named here and nowhere else: a half-space is not bounded, meshes need not be convex.
/// Every other alternative of Shape is bounded and convex.
template <class S>
inline constexpr bool is_bounded_shape = !std::is_same_v<S, HalfSpace>;
template <class S>
inline constexpr bool has_triangles = std::is_base_of_v<TriangleMesh, S>;
template <class S>
inline constexpr bool is_convex_shape = is_bounded_shape<S> && !has_triangles<S>;

/// What every shape states about itself; core/broad and core/world ask for the bounds.
template <class S>
concept ShapeModule = requires(const S& s, const Vec3& d) {
  { S::type } -> std::convertible_to<std::string_view>;
  S::fields();
  { s == s } -> std::convertible_to<bool>;
  // Largest distance of a point from the body's origin; infinite if it is not bounded. A few roundings.
  { s.bounding_radius() } -> std::same_as<double>;
  // Half the largest extent along the body axes; 0 if it is not bounded.
  { s.extent() } -> std::same_as<double>;
  // Values of d·x on the shape, computed in the scalar of d with at most eight roundings, each of a partial
  // result of at most coordinate_sum().
  { s.extent_along(d) } -> std::same_as<Interval<double>>;
  { s.template extent_along<Wide>(WideVec()) } -> std::same_as<Interval<Wide>>;
  { s.coordinate_sum() } -> std::same_as<Wide>;
  { s.inner_radii() } -> std::same_as<InnerRadii>;
};

/// What a bounded convex shape states besides: it is a convex core (core/shape/convex_body.h lists them and
/// what they provide) and all points within a radius of it.
template <class S>
concept ConvexShape = ShapeModule<S> && requires(const S& s) {
  s.template core<float>();
  s.template core<double>();
  s.template core<Wide>();
  { S::has_ball } -> std::convertible_to<bool>;
  { s.ball_radius() } -> std::same_as<double>;
  // Whether rotations about the origin leave it as it is.
  { s.is_ball() } -> std::same_as<bool>;
};

namespace detail {

/// One value for each alternative of Shape: of(type_identity<S>).
template <class F>
constexpr auto per_shape(F of) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return std::array{of(std::type_identity<std::variant_alternative_t<i, Shape>>())...};
  }
  (std::make_index_sequence<std::variant_size_v<Shape>>());
}

template <class S>
constexpr bool is_complete_shape() {
  static_assert(ShapeModule<S>, "a shape lacks a part of its file; see ShapeModule");
  static_assert(
      ConvexShape<S> == is_convex_shape<S>,
      "a convex shape has core(), has_ball, ball_radius() and is_ball(); the others have none of them");
  return true;
}
inline constexpr auto complete_shapes =
    per_shape([]<class S>(std::type_identity<S>) { return is_complete_shape<S>(); });

inline constexpr auto bounded_shapes =
    per_shape([]<class S>(std::type_identity<S>) { return is_bounded_shape<S>; });
inline constexpr auto convex_shapes =
    per_shape([]<class S>(std::type_identity<S>) { return is_convex_shape<S>; });

}  // namespace detail

constexpr bool is_bounded(ShapeKind k) { return detail::bounded_shapes[static_cast<std::size_t>(k)]; }

/// Bounded and convex. The other kinds, half-space and both meshes, are static: their bodies do not move.
constexpr bool is_convex(ShapeKind k) { return detail::convex_shapes[static_cast<std::size_t>(k)]; }

/// Given by triangles: a surface, or the solid inside one.
constexpr bool is_mesh(ShapeKind k) { return k == ShapeKind::mesh || k == ShapeKind::solid_mesh; }
inline bool is_mesh(const Shape& s) { return is_mesh(kind_of(s)); }

std::string_view type_name(ShapeKind k);
inline std::string_view type_name(const Shape& s) { return type_name(kind_of(s)); }
/// A shape of that kind with every field at its default.
Shape shape_of_kind(ShapeKind k);

/// Calls f(field_name, value_reference, Domain) for each field of the shape, in the order of its table.
template <class S, class F>
requires requires { S::fields(); }
void for_each_field(S& shape, F&& f) {
  std::apply([&](const auto&... field) { (f(field.name, field.of(shape), field.domain), ...); },
             std::remove_const_t<S>::fields());
}

/// Largest distance of a point of the shape from the body's origin, rounded up a little; infinity for a
/// half-space.
double bounding_radius(const Shape& s);

/// Half the largest extent along the body axes; the size of the shape in the scale L. Zero for a half-space.
double extent(const Shape& s);

/// A hull, or the core of a padded one; null for other shapes.
const Hull* hull_if(const Shape& s);
Hull* hull_if(Shape& s);

/// The points within `padding` of the shape, as a shape: a sphere's or capsule's radius, a rounded box's and
/// a half-space's offset grow by it (rounded once; a half-space's by |normal| times it), a box becomes a
/// rounded box, the other convex shapes padded ones. Empty for meshes. Precondition: padding >= 0.
std::optional<Shape> padded(const Shape& s, double padding);

/// The vertices of a hull, padded or not, or mesh; null for other shapes.
const std::vector<Vec3>* vertices_if(const Shape& s);

/// The triangles of a mesh, or of a solid mesh's surface; null for other shapes.
const TriangleMesh* triangles_if(const Shape& s);

/// Throws InputError naming the field when a number is not finite or outside its domain, an index is out of
/// range, or the triangles of a solid mesh do not enclose a solid.
void validate(const Shape& s);

}  // namespace touchstone
