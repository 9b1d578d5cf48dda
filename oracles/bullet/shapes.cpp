#include "oracles/bullet/shapes.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>

#include <algorithm>
#include <cmath>

#include "oracles/abi/height_field.h"

namespace touchstone::bullet_adapter {
namespace {

btScalar scalar(double x) { return static_cast<btScalar>(x); }
btVector3 vector(const double* v) { return {scalar(v[0]), scalar(v[1]), scalar(v[2])}; }

std::unique_ptr<btCollisionShape> make_hull(const ts_shape& asked, std::optional<double> margin) {
  auto hull = std::make_unique<btConvexHullShape>();
  if (margin) hull->setMargin(scalar(*margin));
  for (std::size_t i = 0; i < asked.vertex_count; ++i)
    hull->addPoint(vector(asked.vertices + 3 * i), /*recalculateLocalAabb=*/false);
  hull->recalcLocalAabb();
  return hull;
}

// The hull of the box's corners; the margin is the radius.
std::unique_ptr<btCollisionShape> make_rounded_box(const ts_shape& asked) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(scalar(asked.size[3]));
  const btVector3 h = vector(asked.size);
  for (const btScalar x : {-h.x(), h.x()})
    for (const btScalar y : {-h.y(), h.y()})
      for (const btScalar z : {-h.z(), h.z()}) hull->addPoint({x, y, z}, /*recalculateLocalAabb=*/false);
  hull->recalcLocalAabb();
  return hull;
}

std::unique_ptr<btCollisionShape> make_plane(const ts_shape& asked) {
  const Vec3 n(asked.size[0], asked.size[1], asked.size[2]);
  const double length = n.stableNorm();
  const Vec3 unit = n / length;
  return std::make_unique<btStaticPlaneShape>(vector(unit.data()), scalar(asked.size[3] / length));
}

// Bullet puts the middle between the limits of the heights at the origin, so these are opposite numbers here.
// It computes the vertices that `out` gets.
std::unique_ptr<btCollisionShape> make_height_field(const ts_shape& asked, const kit::HeightField& field,
                                                    Shape& out) {
  btScalar highest = 0;
  for (std::size_t i = 0; i < asked.vertex_count; ++i) {
    out.heights.push_back(scalar(asked.vertices[3 * i + 2]));
    highest = std::max(highest, std::abs(out.heights.back()));
  }
  const btVector3 scaling(scalar(field.cell[0]), scalar(field.cell[1]), 1);
  const auto place = [](std::size_t i, std::size_t n) {
    return -static_cast<btScalar>(n - 1) / 2 + static_cast<btScalar>(i);
  };
  for (std::size_t i = 0; i < asked.vertex_count; ++i)
    out.mesh_vertices.insert(out.mesh_vertices.end(),
                             {place(i % field.columns, field.columns) * scaling.x(),
                              place(i / field.columns, field.rows) * scaling.y(), out.heights[i]});
  auto shape = std::make_unique<btHeightfieldTerrainShape>(
      static_cast<int>(field.columns), static_cast<int>(field.rows), out.heights.data(), -highest, highest,
      /*upAxis=*/2, /*flipQuadEdges=*/true);
  shape->setFlipTriangleWinding(true);
  shape->setLocalScaling(scaling);
  return shape;
}

std::unique_ptr<btCollisionShape> make_mesh(const ts_shape& asked, Shape& out) {
  const auto field = kit::height_field_of({asked.vertices, 3 * asked.vertex_count},
                                          {asked.triangles, 3 * asked.triangle_count});
  if (field) return make_height_field(asked, *field, out);
  for (std::size_t i = 0; i < 3 * asked.vertex_count; ++i)
    out.mesh_vertices.push_back(scalar(asked.vertices[i]));
  out.mesh_indices.assign(asked.triangles, asked.triangles + 3 * asked.triangle_count);
  out.mesh = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(asked.triangle_count), out.mesh_indices.data(), static_cast<int>(3 * sizeof(int)),
      static_cast<int>(asked.vertex_count), out.mesh_vertices.data(), static_cast<int>(3 * sizeof(btScalar)));
  return std::make_unique<btBvhTriangleMeshShape>(out.mesh.get(), /*useQuantizedAabbCompression=*/true);
}

struct Size {
  double v[4] = {};
};

Size size_of(const Shape& s) {
  switch (s.kind) {
    case TS_SPHERE:
      return {{static_cast<const btSphereShape&>(*s.shape).getRadius()}};
    case TS_BOX: {
      const btVector3 h = static_cast<const btBoxShape&>(*s.shape).getHalfExtentsWithMargin();
      return {{h.x(), h.y(), h.z()}};
    }
    case TS_CAPSULE: {
      const auto& c = static_cast<const btCapsuleShape&>(*s.shape);
      return {{c.getRadius(), c.getHalfHeight()}};
    }
    case TS_CYLINDER: {
      const auto& c = static_cast<const btCylinderShape&>(*s.shape);
      return {{c.getRadius(), c.getHalfExtentsWithMargin().z()}};
    }
    case TS_CONE: {
      const auto& c = static_cast<const btConeShape&>(*s.shape);
      return {{c.getRadius(), static_cast<double>(c.getHeight()) / 2}};
    }
    case TS_ROUNDED_BOX: {
      const auto& hull = static_cast<const btConvexHullShape&>(*s.shape);
      const btVector3& h = hull.getUnscaledPoints()[hull.getNumPoints() - 1];
      return {{h.x(), h.y(), h.z(), hull.getMargin()}};
    }
    case TS_PADDED_CYLINDER: {
      const auto& c = static_cast<const btCylinderShape&>(*s.shape);
      const btVector3& core = c.getImplicitShapeDimensions();
      return {{core.x(), core.z(), c.getMargin()}};
    }
    case TS_PADDED_CONE: {
      const auto& c = static_cast<const btConeShape&>(*s.shape);
      return {{c.getRadius(), static_cast<double>(c.getHeight()) / 2, c.getMargin()}};
    }
    case TS_PADDED_HULL:
      return {{s.shape->getMargin()}};
    case TS_HALF_SPACE: {
      const auto& p = static_cast<const btStaticPlaneShape&>(*s.shape);
      const btVector3& n = p.getPlaneNormal();
      return {{n.x(), n.y(), n.z(), p.getPlaneConstant()}};
    }
    default:
      return {};
  }
}

std::vector<double> vertices_of(const Shape& s) {
  std::vector<double> out;
  if (s.kind == TS_MESH) out.assign(s.mesh_vertices.begin(), s.mesh_vertices.end());
  if (s.kind != TS_HULL && s.kind != TS_PADDED_HULL) return out;
  const auto& hull = static_cast<const btConvexHullShape&>(*s.shape);
  for (int i = 0; i < hull.getNumPoints(); ++i) {
    const btVector3& p = hull.getUnscaledPoints()[i];
    out.insert(out.end(), {p.x(), p.y(), p.z()});
  }
  return out;
}

}  // namespace

double Shape::inside_margin() const { return kind == TS_BOX || kind == TS_CYLINDER ? shape->getMargin() : 0; }

double Shape::outside_margin() const {
  return kind == TS_HULL || kind == TS_CONE || kind == TS_MESH ? shape->getMargin() : 0;
}

std::unique_ptr<Shape> make_shape(const ts_shape& asked, std::optional<double> margin) {
  auto out = std::make_unique<Shape>();
  out->kind = asked.kind;
  const btScalar r = scalar(asked.size[0]), h = scalar(asked.size[1]);
  switch (asked.kind) {
    case TS_SPHERE:
      out->shape = std::make_unique<btSphereShape>(r);
      return out;
    case TS_CAPSULE:
      out->shape = std::make_unique<btCapsuleShapeZ>(r, 2 * h);
      return out;
    case TS_BOX:
      out->shape = std::make_unique<btBoxShape>(vector(asked.size));
      break;
    case TS_CYLINDER:
      out->shape = std::make_unique<btCylinderShapeZ>(btVector3(r, r, h));
      break;
    case TS_CONE:
      out->shape = std::make_unique<btConeShapeZ>(r, 2 * h);
      break;
    case TS_HULL:
      out->shape = make_hull(asked, margin);
      break;
    case TS_HALF_SPACE:
      out->shape = make_plane(asked);
      break;
    case TS_MESH:
      out->shape = make_mesh(asked, *out);
      break;
    // A padding is the margin, whatever margin the engine's setting has.
    case TS_ROUNDED_BOX:
      out->shape = make_rounded_box(asked);
      return out;
    case TS_PADDED_CYLINDER: {
      const btScalar padding = scalar(asked.size[2]);
      out->shape = std::make_unique<btCylinderShapeZ>(btVector3(r + padding, r + padding, h + padding));
      out->shape->setMargin(padding);
      return out;
    }
    case TS_PADDED_CONE:
      out->shape = std::make_unique<btConeShapeZ>(r, 2 * h);
      out->shape->setMargin(scalar(asked.size[2]));
      return out;
    case TS_PADDED_HULL:
      out->shape = make_hull(asked, asked.size[0]);
      return out;
    default:
      return out;
  }
  // The margin of a sphere or capsule is its radius, which setMargin does not change.
  if (margin) out->shape->setMargin(scalar(*margin));
  return out;
}

btTransform make_transform(const Pose& pose) {
  const Quat q = normalized(pose.rotation);
  return btTransform(btQuaternion(scalar(q.x), scalar(q.y), scalar(q.z), scalar(q.w)),
                     vector(pose.translation.data()));
}

void report_shape(int index, const Shape& held, const ts_received& to) {
  if (!held.shape) return;
  const std::vector<double> vertices = vertices_of(held);
  to.shape(to.ctx, index, size_of(held).v, vertices.data(), vertices.size() / 3);
}

void report_body(int index, const btTransform& held, const ts_received& to) {
  double matrix[9];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) matrix[3 * r + c] = held.getBasis()[r][c];
  const Vec3 translation = vec3(held.getOrigin());
  to.body(to.ctx, index, matrix, translation.data());
}

}  // namespace touchstone::bullet_adapter
