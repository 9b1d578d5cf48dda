// The same set given as another shape, or nearly the same: what vanishes was bound to a routine for the shape
// as given.
#include <cmath>
#include <numbers>

#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"

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

// One body given as a sphere or a box of its extent; the gap stays as it is.
template <class Make>
std::optional<Case> replaced(const Case& c, bool second, Make&& make) {
  const auto before = true_pair(c);
  if (!before) return std::nullopt;
  const int of = second ? before->b : before->a;
  const double size = extent(c.scene.shape_of(of));
  Shape shape = make(size > 0 && std::isfinite(size) ? size : before->size);
  if (shape == c.scene.shape_of(of)) return std::nullopt;
  Case r = c;
  r.scene.shapes.push_back(std::move(shape));
  r.scene.bodies[static_cast<std::size_t>(of)].shape = static_cast<int>(r.scene.shapes.size()) - 1;
  return with_gap(r, before->gap);
}
Shape a_sphere(double size) { return Sphere{size}; }
Shape a_cube(double size) { return Box{Vec3::Constant(size)}; }

}  // namespace

std::optional<Case> a_as_sphere(const Case& c) { return replaced(c, false, a_sphere); }
std::optional<Case> b_as_sphere(const Case& c) { return replaced(c, true, a_sphere); }
std::optional<Case> a_as_cube(const Case& c) { return replaced(c, false, a_cube); }
std::optional<Case> b_as_cube(const Case& c) { return replaced(c, true, a_cube); }

namespace {

// Two cubes of side 2 in place of the bodies, the second above a face of the first.
std::optional<Case> as_cubes(const Case& c, double height) {
  const auto pair = pair_of(c);
  if (!pair || c.scene.bodies.size() != 2 || !c.scene.script.empty()) return std::nullopt;
  if (is_motion_question(c.queries[0].question)) return std::nullopt;
  Case r = c;
  r.scene.shapes = {Box{Vec3::Ones()}};
  for (Body& b : r.scene.bodies) {
    b.shape = 0;
    b.pose = {};
  }
  r.scene.bodies[static_cast<std::size_t>(pair->second)].pose.translation.x() = height;
  return r;
}

}  // namespace

std::optional<Case> as_touching_cubes(const Case& c) { return as_cubes(c, 2); }
std::optional<Case> as_pressed_cubes(const Case& c) { return as_cubes(c, std::nextafter(2, 0)); }

std::optional<Case> own_shapes(const Case& c) {
  if (c.scene.bodies.size() <= c.scene.shapes.size()) return std::nullopt;
  Case r = c;
  r.scene.shapes.clear();
  for (std::size_t i = 0; i < c.scene.bodies.size(); ++i) {
    r.scene.shapes.push_back(c.scene.shape_of(static_cast<int>(i)));
    r.scene.bodies[i].shape = static_cast<int>(i);
  }
  return r;
}

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
