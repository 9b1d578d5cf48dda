#include "scenarios/random/random_shape.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace touchstone::fuzz {
namespace {

// Cosine above which a direction counts as a half-space's own normal when a random pair is placed: a coarse
// choice of where to put a body that no judgement depends on. Tested by: tests/fuzz "the
// default mix is not trivial".
constexpr double parallel_cosine = 1 - 0x1p-30;

double size(Rng& rng, double scale) { return rng.uniform(0.3, 1.2) * scale; }

Vec3 sizes(Rng& rng, double scale) {
  const double x = size(rng, scale), y = size(rng, scale), z = size(rng, scale);
  return {x, y, z};
}

Shape random_hull(Rng& rng, double scale) {
  const Vec3 axes = sizes(rng, scale);
  // One in sixteen is flat: a triangle or a planar polygon is a legitimate hull.
  const bool flat = rng.below(16) == 0;
  const std::size_t n = flat ? 3 + rng.below(3) : 4 + rng.below(rng.chance(0.8) ? 12 : 60);
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 p = rng.unit_vector().cwiseProduct(axes);
    if (flat) p.z() = 0;
    v.push_back(p);
  }
  return make_hull(std::move(v));
}

// A bumpy height field with 3×3 vertices and 8 triangles, with convex and reflex inner edges.
Shape random_mesh(Rng& rng, double scale) {
  TriangleMesh m;
  const double cell = size(rng, scale);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m.vertices.push_back({(i - 1) * cell, (j - 1) * cell, rng.uniform(-0.3, 0.3) * cell});
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j, b = a + 3, c = a + 1, d = a + 4;
      m.triangles.push_back({a, b, d});
      m.triangles.push_back({a, d, c});
    }
  return m;
}

}  // namespace

Shape random_shape(Rng& rng, ShapeKind kind, double scale) {
  const double a = size(rng, scale), b = size(rng, scale);
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{a};
    case ShapeKind::box:
      return Box{sizes(rng, scale)};
    case ShapeKind::capsule:
      return Capsule{a / 2, b};
    case ShapeKind::cylinder:
      return Cylinder{a, b};
    case ShapeKind::cone:
      return Cone{a, b};
    case ShapeKind::ellipsoid:
      return Ellipsoid{sizes(rng, scale)};
    case ShapeKind::hull:
      return random_hull(rng, scale);
    case ShapeKind::half_space:
      return HalfSpace{rng.vector(0.5, 2), rng.uniform(-1, 1) * scale};
    case ShapeKind::mesh:
      return random_mesh(rng, scale);
    case ShapeKind::rounded_box:
      return RoundedBox{sizes(rng, scale), a / 4};
    case ShapeKind::solid_mesh:
      return random_solid(rng, scale);
    case ShapeKind::padded_cylinder:
      return Padded<Cylinder>{{a, b}, size(rng, scale) / 4};
    case ShapeKind::padded_cone:
      return Padded<Cone>{{a, b}, size(rng, scale) / 4};
    case ShapeKind::padded_ellipsoid:
      return Padded<Ellipsoid>{{sizes(rng, scale)}, a / 4};
    case ShapeKind::padded_hull:
      return Padded<Hull>{std::get<Hull>(random_hull(rng, scale)), a / 4};
  }
  return Sphere{a};
}

namespace {

thread_local std::vector<ShapeKind> only_kinds;  // empty: all

}  // namespace

OnlyKinds::OnlyKinds(std::span<const ShapeKind> kinds) : before_(kinds.begin(), kinds.end()) {
  if (std::ranges::none_of(kinds, is_convex)) before_.clear();
  std::swap(before_, only_kinds);
}
OnlyKinds::~OnlyKinds() { std::swap(before_, only_kinds); }

bool may_draw(ShapeKind kind) {
  return only_kinds.empty() || std::ranges::find(only_kinds, kind) != only_kinds.end();
}

ShapeKind random_convex_kind(Rng& rng) {
  if (only_kinds.empty()) return common_convex_kinds[rng.below(common_convex_kinds.size())];
  std::vector<ShapeKind> convex;
  std::ranges::copy_if(only_kinds, std::back_inserter(convex), is_convex);
  return convex[rng.below(convex.size())];
}

double support_value(const Shape& shape, const Vec3& n) {
  return std::visit(
      [&](const auto& s) -> double {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, HalfSpace>) {
          const double along = n.normalized().dot(s.normal.normalized());
          return along > parallel_cosine ? s.offset / s.normal.norm()
                                         : std::numeric_limits<double>::infinity();
        } else if constexpr (has_triangles<S>) {
          double h = -std::numeric_limits<double>::infinity();
          for (const Vec3& v : s.vertices) h = std::max(h, v.dot(n));
          return h;
        } else {
          return support(s, n).dot(n);
        }
      },
      shape);
}

}  // namespace touchstone::fuzz
