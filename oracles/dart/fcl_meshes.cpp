#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionGroup.hpp>

#include "oracles/dart/shapes.h"

namespace touchstone::dart_adapter {
namespace {

namespace collision = dart::collision;
using Mesh = ::fcl::BVHModel<collision::fcl::OBBRSS>;

// A group that lets its objects be read.
class ReadableGroup : public collision::FCLCollisionGroup {
 public:
  using FCLCollisionGroup::FCLCollisionGroup;
  using FCLCollisionGroup::getFCLCollisionManager;
};

}  // namespace

bool report_fcl_mesh(int index, const collision::CollisionDetectorPtr& detector,
                     const dart::dynamics::SimpleFrame& frame, const ts_received& to) {
  ReadableGroup group(detector);
  group.addShapeFrame(&frame);
  std::vector<collision::fcl::CollisionObject*> objects;
  group.getFCLCollisionManager()->getObjects(objects);
  if (objects.empty() || objects[0]->getObjectType() != ::fcl::OT_BVH) return false;
  const auto* mesh = static_cast<const Mesh*>(objects[0]->collisionGeometry().get());
  std::vector<double> vertices;
  for (int i = 0; i < mesh->num_vertices; ++i)
    vertices.insert(vertices.end(), mesh->vertices[i].data(), mesh->vertices[i].data() + 3);
  std::vector<std::int32_t> triangles;
  for (int i = 0; i < mesh->num_tris; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      triangles.push_back(static_cast<std::int32_t>(mesh->tri_indices[i][k]));
  ts_shape held{};
  held.kind = TS_MESH;
  held.vertices = vertices.data();
  held.vertex_count = vertices.size() / 3;
  held.triangles = triangles.data();
  held.triangle_count = triangles.size() / 3;
  kit::report_other_shape(to, index, held);
  return true;
}

}  // namespace touchstone::dart_adapter
