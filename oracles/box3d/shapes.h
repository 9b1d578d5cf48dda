// Shapes and poses of the C ABI as Box3D's own types: floats (positions are doubles in a library built with
// BOX3D_DOUBLE_PRECISION), half widths, capsules by the ends of their segment.
#pragma once

#include <box3d/collision.h>

#include <memory>
#include <variant>
#include <vector>

#include "core/math/pose.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::box3d_adapter {

struct DestroyHull {
  void operator()(b3HullData* hull) const { b3DestroyHull(hull); }
};
using HullPtr = std::unique_ptr<b3HullData, DestroyHull>;

/// A box is a hull that stores its arrays itself.
using Shape = std::variant<b3Sphere, b3Capsule, b3BoxHull, HullPtr>;

/// Throws kit::Unsupported for a shape that Box3D does not have: its cylinders and cones are hulls with a
/// number of sides, which is another shape; its hulls have at most B3_MAX_HULL_VERTICES vertices and are
/// never flat; its meshes collide as parts of a static body only.
Shape make_shape(const ts_shape& shape);

/// Null for spheres and capsules.
const b3HullData* hull_of(const Shape& shape);

/// The points and the radius that stand for the shape in distance and cast queries.
struct Proxy {
  std::vector<b3Vec3> points;
  float radius = 0;
  b3ShapeProxy view() const { return {points.data(), static_cast<int>(points.size()), radius}; }
};
Proxy make_proxy(const Shape& shape);

b3WorldTransform make_transform(const Pose& pose);

inline Vec3 to_vec3(const b3Vec3& v) { return {v.x, v.y, v.z}; }
/// The rotation of a quaternion that need not be unit, by the formula that Box3D applies to it.
Mat3 rotation_of(const b3Quat& q);

/// Report what Box3D holds, in the ABI's conventions.
void report_shape(int index, const ts_shape& asked, const Shape& held, const ts_received& to);
void report_body(int index, const b3WorldTransform& held, const ts_received& to);

}  // namespace touchstone::box3d_adapter
