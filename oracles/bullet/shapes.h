// Shapes and poses of the C ABI as Bullet's own types.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/pose.h"
#include "core/math/roundoff.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::bullet_adapter {

inline constexpr bool is_double = sizeof(btScalar) == 8;
inline constexpr double unit_roundoff = is_double ? double_roundoff : float_roundoff;

/// Bullet's margin around a hull, a cone or a smaller cylinder.
inline const std::vector<std::string> held_by_margin{"rounded_box", "padded_cylinder", "padded_cone",
                                                     "padded_hull"};

/// A btCollisionShape and the arrays that it points into.
struct Shape {
  int kind = 0;  // ts_shape_kind
  std::vector<btScalar> mesh_vertices;
  std::vector<int> mesh_indices;
  std::vector<btScalar> heights;  // of a mesh that is a height field
  std::unique_ptr<btTriangleIndexVertexArray> mesh;
  std::unique_ptr<btCollisionShape> shape;  // null: Bullet has no such shape, e.g. no ellipsoid
  bool is_convex() const { return shape && shape->isConvex(); }

  /// Margins as Bullet documents them (btCollisionMargin.h, btBoxShape.h, btConvexHullShape.h): for boxes and
  /// cylinders the margin lies inside and rounds the edges wherever GJK is used; for hulls, cones and
  /// triangles it lies outside.
  double inside_margin() const;
  double outside_margin() const;
};

/// Shapes use half extents and z axes. A margin other than Bullet's default is set before a hull gets its
/// points, because the hull's cached AABB keeps the margin that it was computed with.
std::unique_ptr<Shape> make_shape(const ts_shape& asked, std::optional<double> margin);

/// As a user would write it: a unit quaternion in Bullet's scalar type, which Bullet converts to a matrix.
btTransform make_transform(const Pose& pose);

inline Vec3 vec3(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

/// Report what Bullet holds, in the ABI's conventions.
void report_shape(int index, const Shape& held, const ts_received& to);
void report_body(int index, const btTransform& held, const ts_received& to);

}  // namespace touchstone::bullet_adapter
