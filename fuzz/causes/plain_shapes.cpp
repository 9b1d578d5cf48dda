#include "fuzz/causes/plain_shapes.h"

#include <algorithm>
#include <optional>

#include "fuzz/judge/exact_map.h"

namespace touchstone::fuzz {
namespace {

const Shape& unit_sphere() {
  static const Shape s = Sphere{1};
  return s;
}
const Shape& unit_cube() {
  static const Shape s = Box{Vec3::Ones()};
  return s;
}

Shape unit_hull() {
  std::vector<Vec3> corners;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) corners.emplace_back(x, y, z);
  return make_hull(std::move(corners));
}

// In the plane x = 0: a square of two triangles, or one triangle.
std::optional<Shape> unit_mesh(const TriangleMesh& m) {
  if (m.triangles.size() == 1) return TriangleMesh{{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}}, {{0, 1, 2}}};
  if (m.triangles.size() == 2)
    return TriangleMesh{{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  return std::nullopt;
}

// A half-space is solid towards -x as the first shape, and towards +x as the second.
std::optional<Shape> unit_of(const Shape& s, bool is_first) {
  if (kind_of(s) == ShapeKind::half_space) return HalfSpace{Vec3(is_first ? 1 : -1, 0, 0), 0};
  if (const auto* m = std::get_if<TriangleMesh>(&s)) return unit_mesh(*m);
  if (const auto* h = hull_if(s)) {
    if (h->dimension != 3) return std::nullopt;
    const bool is_padded = kind_of(s) == ShapeKind::padded_hull;
    return is_padded ? Shape(Padded<Hull>{std::get<Hull>(unit_hull()), 1}) : unit_hull();
  }
  Shape r = s;
  change_numbers(r, [](auto& v, Domain) {
    if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
      v = v == 0 ? 0 : 1;
    else
      for (double& x : v) x = x == 0 ? 0 : 1;
  });
  return r;
}

double reach(const Shape& s) {
  if (kind_of(s) == ShapeKind::half_space || kind_of(s) == ShapeKind::mesh) return 0;
  return std::visit([](const auto& x) { return x.template extent_along<double>(Vec3::UnitX()).hi; }, s);
}

PlainPair pair_of_shapes(const Shape& first, const Shape& second) {
  return {first, second, reach(first), reach(second), false};
}

}  // namespace

std::vector<PlainPair> common_pairs() {
  const Shape &sphere = unit_sphere(), &cube = unit_cube();
  return {{sphere, sphere}, {cube, cube}, {sphere, cube}, {cube, sphere}};
}

std::vector<PlainPair> own_pairs(const Shape& a, const Shape& b) {
  // In the order of their kinds, so that (a, b) and (b, a) have the same list.
  std::vector<Shape> own{a, b};
  std::ranges::stable_sort(own, {}, kind_of);
  std::vector<PlainPair> all;
  const auto add = [&](const Shape& first, const Shape& second) {
    const auto x = unit_of(first, true), y = unit_of(second, false);
    if (!x || !y) return;
    const auto is_common = [](const Shape& s) { return s == unit_sphere() || s == unit_cube(); };
    if (is_common(*x) && is_common(*y)) return;
    all.push_back(pair_of_shapes(*x, *y));
  };
  for (const Shape& s : own)
    for (const Shape* other : {&unit_sphere(), &unit_cube()}) {
      add(s, *other);
      add(*other, s);
    }
  add(own[0], own[1]);
  if (own[0] != own[1]) add(own[1], own[0]);
  return all;
}

}  // namespace touchstone::fuzz
