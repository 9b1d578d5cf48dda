// The same set given as another shape, or nearly the same: what vanishes was bound to a routine for the shape
// as given.
#include <cmath>
#include <numbers>

#include "fuzz/causes/intervention.h"

namespace touchstone::fuzz {
namespace {

template <class From, class Make>
std::optional<Case> with_shapes(const Case& c, Make&& make) {
  Case r = c;
  bool any = false;
  for (Shape& shape : r.scene.shapes)
    if (const auto* from = std::get_if<From>(&shape)) {
      shape = make(*from);
      any = true;
    }
  if (!any) return std::nullopt;
  return r;
}

}  // namespace

std::optional<Case> box_as_hull(const Case& c) {
  return with_shapes<Box>(c, [](const Box& box) -> Shape {
    std::vector<Vec3> corners;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) corners.push_back(box.half_extents.cwiseProduct(Vec3(x, y, z)));
    return make_hull(std::move(corners));
  });
}

std::optional<Case> sphere_as_ellipsoid(const Case& c) {
  return with_shapes<Sphere>(c, [](const Sphere& s) -> Shape { return Ellipsoid{Vec3::Constant(s.radius)}; });
}

std::optional<Case> sphere_as_capsule(const Case& c) {
  return with_shapes<Sphere>(c, [](const Sphere& s) -> Shape { return Capsule{s.radius, 0}; });
}

std::optional<Case> cylinder_as_hull(const Case& c) {
  constexpr int sides = 64;
  return with_shapes<Cylinder>(c, [](const Cylinder& cylinder) -> Shape {
    std::vector<Vec3> rim;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      for (const double z : {-cylinder.half_height, cylinder.half_height})
        rim.emplace_back(cylinder.radius * std::cos(angle), cylinder.radius * std::sin(angle), z);
    }
    return make_hull(std::move(rim));
  });
}

}  // namespace touchstone::fuzz
