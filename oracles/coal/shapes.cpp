#include "oracles/coal/shapes.h"

#include <coal/BV/OBBRSS.h>
#include <coal/BVH/BVH_model.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::coal_adapter {
namespace {

std::vector<coal::Vec3s> vertices_of(const ts_shape& s) {
  std::vector<coal::Vec3s> all;
  for (std::size_t i = 0; i < s.vertex_count; ++i)
    all.push_back(kit::vec3(s.vertices + 3 * i).cast<coal::CoalScalar>());
  return all;
}

std::vector<coal::Triangle> triangles_of(const ts_shape& s) {
  const auto index = [](std::int32_t i) { return static_cast<coal::Triangle::index_type>(i); };
  std::vector<coal::Triangle> all;
  for (std::size_t i = 0; i < s.triangle_count; ++i) {
    const std::int32_t* t = s.triangles + 3 * i;
    all.emplace_back(index(t[0]), index(t[1]), index(t[2]));
  }
  return all;
}

Geometry make_hull(const ts_shape& s) {
  if (s.triangle_count == 0) throw kit::Unsupported("a flat hull has no faces for coal::Convex");
  auto points = std::make_shared<std::vector<coal::Vec3s>>(vertices_of(s));
  auto faces = std::make_shared<std::vector<coal::Triangle>>(triangles_of(s));
  const auto point_count = static_cast<unsigned>(points->size()),
             face_count = static_cast<unsigned>(faces->size());
  return std::make_shared<coal::Convex<coal::Triangle>>(points, point_count, faces, face_count);
}

Geometry make_mesh(const ts_shape& s) {
  auto mesh = std::make_shared<coal::BVHModel<coal::OBBRSS>>();
  mesh->beginModel(static_cast<unsigned>(s.triangle_count), static_cast<unsigned>(s.vertex_count));
  mesh->addSubModel(vertices_of(s), triangles_of(s));
  if (mesh->endModel() != 0) throw std::runtime_error("coal::BVHModel::endModel reports a failure");
  return mesh;
}

}  // namespace

Geometry make_geometry(const ts_shape& s) {
  const auto z = [&](int i) { return static_cast<coal::CoalScalar>(s.size[i]); };
  switch (s.kind) {
    case TS_SPHERE:
      return std::make_shared<coal::Sphere>(z(0));
    case TS_BOX:
      return std::make_shared<coal::Box>(2 * z(0), 2 * z(1), 2 * z(2));
    case TS_CAPSULE:
      return std::make_shared<coal::Capsule>(z(0), 2 * z(1));
    case TS_CYLINDER:
      return std::make_shared<coal::Cylinder>(z(0), 2 * z(1));
    case TS_CONE:
      return std::make_shared<coal::Cone>(z(0), 2 * z(1));
    case TS_ELLIPSOID:
      return std::make_shared<coal::Ellipsoid>(z(0), z(1), z(2));
    case TS_HALF_SPACE:
      return std::make_shared<coal::Halfspace>(z(0), z(1), z(2), z(3));
    case TS_HULL:
      return make_hull(s);
    case TS_MESH:
      return make_mesh(s);
    default:
      kit::no_such_shape("Coal");
  }
}

coal::Transform3s make_transform(const Pose& pose) {
  const coal::Matrix3s rotation = rotation_matrix(pose.rotation).cast<coal::CoalScalar>();
  const coal::Vec3s translation = pose.translation.cast<coal::CoalScalar>();
  return coal::Transform3s(rotation, translation);
}

// In doubles, Coal holds what it was given, but for a half space's unit normal and offset.
void report_shape(int index, const ts_shape& asked, const coal::CollisionGeometry& held,
                  const ts_received& to) {
  double size[4];
  for (int i = 0; i < 4; ++i) size[i] = static_cast<coal::CoalScalar>(asked.size[i]);
  if (asked.kind == TS_HALF_SPACE) {
    const auto& half_space = static_cast<const coal::Halfspace&>(held);
    const Vec3 normal = half_space.n.cast<double>();
    kit::store(normal, size);
    size[3] = half_space.d;
  }
  std::vector<double> numbers;
  for (const coal::Vec3s& v : vertices_of(asked))
    for (int k = 0; k < 3; ++k) numbers.push_back(v[k]);
  to.shape(to.ctx, index, size, numbers.data(), numbers.size() / 3);
}

void report_body(int index, const coal::Transform3s& held, const ts_received& to) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = held.getRotation().cast<double>();
  const Vec3 translation = held.getTranslation().cast<double>();
  to.body(to.ctx, index, rows.data(), translation.data());
}

}  // namespace touchstone::coal_adapter
