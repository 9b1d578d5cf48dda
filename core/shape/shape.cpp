#include "core/shape/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"

namespace touchstone {
namespace {

// Each bounding radius takes a few roundings; this factor covers them.
constexpr double rounding_factor = 1 + 8 * std::numeric_limits<double>::epsilon();

void check(std::string_view name, double v, Domain d) {
  if (!std::isfinite(v)) throw InputError(std::string(name), "is not finite (" + to_text(v) + ")");
  if (d == Domain::non_negative && v < 0)
    throw InputError(std::string(name), "is negative (" + to_text(v) + ")");
  if (d == Domain::positive && !(v > 0)) throw InputError(std::string(name), "must be > 0, is " + to_text(v));
}

void check(std::string_view name, const Vec3& v, Domain d) {
  for (int i = 0; i < 3; ++i) check(std::string(name) + "[" + std::to_string(i) + "]", v[i], d);
  if (d == Domain::nonzero_vector && v.isZero(0)) throw InputError(std::string(name), "is the zero vector");
}

void check(std::string_view name, const std::vector<Vec3>& v, Domain d) {
  if (v.empty()) throw InputError(std::string(name), "is empty");
  for (std::size_t i = 0; i < v.size(); ++i)
    check(std::string(name) + "[" + std::to_string(i) + "]", v[i], d);
}

void check(std::string_view name, const std::vector<std::array<int, 3>>& v, Domain) {
  if (v.empty()) throw InputError(std::string(name), "is empty");
}

}  // namespace

std::string_view type_name(ShapeKind k) {
  static constexpr auto names = detail::per_shape([]<class S>(std::type_identity<S>) { return S::type; });
  return names[static_cast<std::size_t>(k)];
}

Shape shape_of_kind(ShapeKind k) {
  static constexpr auto make = detail::per_shape(
      []<class S>(std::type_identity<S>) -> Shape (*)() { return [] { return Shape(S()); }; });
  return make[static_cast<std::size_t>(k)]();
}

double bounding_radius(const Shape& s) {
  return std::visit([](const auto& x) { return x.bounding_radius(); }, s) * rounding_factor;
}

double extent(const Shape& s) {
  return std::visit([](const auto& x) { return x.extent(); }, s);
}

const Hull* hull_if(const Shape& s) {
  const auto* outer = std::get_if<Padded<Hull>>(&s);
  return outer ? &outer->inner : std::get_if<Hull>(&s);
}

Hull* hull_if(Shape& s) {
  auto* outer = std::get_if<Padded<Hull>>(&s);
  return outer ? &outer->inner : std::get_if<Hull>(&s);
}

std::optional<Shape> padded(const Shape& s, double padding) {
  if (padding == 0) return s;
  return std::visit(
      [&]<class S>(const S& x) -> std::optional<Shape> {
        S larger = x;
        if constexpr (std::is_same_v<S, HalfSpace>)
          larger.offset += padding * x.normal.norm();
        else if constexpr (has_triangles<S>)
          return std::nullopt;
        else if constexpr (std::is_same_v<S, Box>)
          return RoundedBox{x.half_extents, padding};
        else if constexpr (!S::has_ball)
          return Padded<S>{x, padding};
        else if constexpr (requires { larger.padding; })
          larger.padding += padding;
        else
          larger.radius += padding;
        return larger;
      },
      s);
}

const std::vector<Vec3>* vertices_if(const Shape& s) {
  return std::visit(
      [](const auto& x) -> const std::vector<Vec3>* {
        if constexpr (requires { x.vertices; })
          return &x.vertices;
        else if constexpr (requires { x.inner.vertices; })
          return &x.inner.vertices;
        else
          return nullptr;
      },
      s);
}

const TriangleMesh* triangles_if(const Shape& s) {
  if (const auto* solid = std::get_if<SolidMesh>(&s)) return solid;
  return std::get_if<TriangleMesh>(&s);
}

void validate(const Shape& s) {
  std::visit(
      [](const auto& x) { for_each_field(x, [](auto name, const auto& v, Domain d) { check(name, v, d); }); },
      s);
  if (const TriangleMesh* m = triangles_if(s)) {
    const int n = static_cast<int>(m->vertices.size());
    for (std::size_t i = 0; i < m->triangles.size(); ++i)
      for (int k : m->triangles[i])
        if (k < 0 || k >= n)
          throw InputError("triangles[" + std::to_string(i) + "]",
                           "vertex index " + std::to_string(k) + " is outside 0.." + std::to_string(n - 1));
  }
  if (const auto* solid = std::get_if<SolidMesh>(&s))
    if (const auto flaw = flaw_of_solid(*solid)) throw InputError(flaw->place, flaw->reason);
}

}  // namespace touchstone
