#include "oracles/fcl/shapes.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>

#include <stdexcept>
#include <vector>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::fcl_adapter {
namespace {

using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

std::vector<fcl::Vector3d> vertices_of(const ts_shape& s) {
  std::vector<fcl::Vector3d> v;
  for (std::size_t i = 0; i < s.vertex_count; ++i)
    v.emplace_back(s.vertices[3 * i], s.vertices[3 * i + 1], s.vertices[3 * i + 2]);
  return v;
}

Geometry make_hull(const ts_shape& s) {
  auto faces = std::make_shared<std::vector<int>>();
  for (std::size_t i = 0; i < s.triangle_count; ++i)
    faces->insert(faces->end(), {3, s.triangles[3 * i], s.triangles[3 * i + 1], s.triangles[3 * i + 2]});
  return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<fcl::Vector3d>>(vertices_of(s)),
                                        static_cast<int>(s.triangle_count), faces);
}

Geometry make_mesh(const ts_shape& s) {
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < s.triangle_count; ++i) {
    const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(s.triangles[3 * i + k]); };
    triangles.emplace_back(corner(0), corner(1), corner(2));
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->beginModel(static_cast<int>(s.triangle_count), static_cast<int>(s.vertex_count));
  mesh->addSubModel(vertices_of(s), triangles);
  if (mesh->endModel() != fcl::BVH_OK) throw std::runtime_error("fcl::BVHModel::endModel failed");
  return mesh;
}

struct Size {
  double v[4] = {};
};

Size size_of(int kind, const fcl::CollisionGeometryd& g) {
  switch (kind) {
    case TS_SPHERE:
      return {{static_cast<const fcl::Sphered&>(g).radius}};
    case TS_BOX: {
      const auto& side = static_cast<const fcl::Boxd&>(g).side;
      return {{side[0] / 2, side[1] / 2, side[2] / 2}};
    }
    case TS_CAPSULE: {
      const auto& c = static_cast<const fcl::Capsuled&>(g);
      return {{c.radius, c.lz / 2}};
    }
    case TS_CYLINDER: {
      const auto& c = static_cast<const fcl::Cylinderd&>(g);
      return {{c.radius, c.lz / 2}};
    }
    case TS_CONE: {
      const auto& c = static_cast<const fcl::Coned&>(g);
      return {{c.radius, c.lz / 2}};
    }
    case TS_ELLIPSOID: {
      const auto& radii = static_cast<const fcl::Ellipsoidd&>(g).radii;
      return {{radii[0], radii[1], radii[2]}};
    }
    case TS_HALF_SPACE: {
      const auto& h = static_cast<const fcl::Halfspaced&>(g);
      return {{h.n[0], h.n[1], h.n[2], h.d}};
    }
    default:
      return {};
  }
}

}  // namespace

Geometry make_geometry(const ts_shape& s) {
  switch (kit::core_of(s.kind).kind) {
    case TS_SPHERE:
      return std::make_shared<fcl::Sphered>(s.size[0]);
    case TS_BOX:
      return std::make_shared<fcl::Boxd>(2 * s.size[0], 2 * s.size[1], 2 * s.size[2]);
    case TS_CAPSULE:
      return std::make_shared<fcl::Capsuled>(s.size[0], 2 * s.size[1]);
    case TS_CYLINDER:
      return std::make_shared<fcl::Cylinderd>(s.size[0], 2 * s.size[1]);
    case TS_CONE:
      return std::make_shared<fcl::Coned>(s.size[0], 2 * s.size[1]);
    case TS_ELLIPSOID:
      return std::make_shared<fcl::Ellipsoidd>(s.size[0], s.size[1], s.size[2]);
    case TS_HULL:
      return make_hull(s);
    case TS_HALF_SPACE:
      return std::make_shared<fcl::Halfspaced>(fcl::Vector3d(s.size[0], s.size[1], s.size[2]), s.size[3]);
    case TS_MESH:
      return make_mesh(s);
    default:
      kit::no_such_shape("FCL");
  }
}

fcl::Transform3d make_transform(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = rotation_matrix(pose.rotation);
  t.translation() = pose.translation;
  return t;
}

void report_shape(int index, const ts_shape& asked, const fcl::CollisionGeometryd& held,
                  const ts_received& to) {
  const double* vertices = nullptr;
  const kit::Core core = kit::core_of(asked.kind);
  if (core.kind == TS_HULL) vertices = static_cast<const fcl::Convexd&>(held).getVertices().front().data();
  if (asked.kind == TS_MESH) vertices = static_cast<const Mesh&>(held).vertices[0].data();
  Size size = size_of(core.kind, held);
  if (core.ball >= 0) size.v[core.ball] = core.radius_of(asked);
  to.shape(to.ctx, index, size.v, vertices, asked.vertex_count);
}

void report_body(int index, const fcl::Transform3d& held, const ts_received& to) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = held.linear();
  to.body(to.ctx, index, rows.data(), held.translation().data());
}

}  // namespace touchstone::fcl_adapter
