// The variant of all shapes.
#pragma once

#include <string_view>
#include <variant>

#include "core/math/aabb.h"
#include "core/shape/box.h"
#include "core/shape/capsule.h"
#include "core/shape/cone.h"
#include "core/shape/cylinder.h"
#include "core/shape/ellipsoid.h"
#include "core/shape/half_space.h"
#include "core/shape/hull.h"
#include "core/shape/rounded_box.h"
#include "core/shape/sphere.h"
#include "core/shape/triangle_mesh.h"

namespace touchstone {

using Shape =
    std::variant<Sphere, Box, Capsule, Cylinder, Cone, Ellipsoid, Hull, HalfSpace, TriangleMesh, RoundedBox>;

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
  rounded_box
};
inline constexpr int shape_kind_count = static_cast<int>(std::variant_size_v<Shape>);

/// Bounded and convex: neither a half-space nor a mesh.
constexpr bool is_convex(ShapeKind k) { return k != ShapeKind::half_space && k != ShapeKind::mesh; }

inline ShapeKind kind_of(const Shape& s) { return static_cast<ShapeKind>(s.index()); }
std::string_view type_name(ShapeKind k);
inline std::string_view type_name(const Shape& s) { return type_name(kind_of(s)); }
/// A shape of that kind with every field at its default.
Shape shape_of_kind(ShapeKind k);

/// Calls f(field_name, value_reference, Domain) for each field of the shape, in the order of its table.
template <class S, class F>
  requires requires { S::fields(); }
void for_each_field(S& shape, F&& f) {
  std::apply([&](const auto&... field) { (f(field.name, shape.*field.member, field.domain), ...); },
             std::remove_const_t<S>::fields());
}

/// Largest distance of a point of the shape from the body's origin, rounded up a little; infinity for a
/// half-space.
double bounding_radius(const Shape& s);

/// Half the largest extent along the body axes; the size of the shape in the scale L. Zero for a half-space.
double extent(const Shape& s);

/// Throws InputError naming the field when a number is not finite or outside its domain, or an index is out
/// of range.
void validate(const Shape& s);

}  // namespace touchstone
