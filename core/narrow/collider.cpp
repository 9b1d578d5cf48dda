#include "core/narrow/collider.h"

#include "core/narrow/mesh.h"
#include "core/narrow/solid.h"
#include "core/narrow/unit_scale.h"

namespace touchstone {

UnitHalfSpace unit_half_space(const HalfSpace& h) {
  const double length = h.normal.norm();
  return {h.normal / length, h.offset / length, length};
}

Collider::Collider(const Shape& shape, std::size_t least_graph)
    : shape_(&shape), bounding_radius_(touchstone::bounding_radius(shape)) {
  if (const auto* hull = hull_if(shape)) {
    HullGraph graph = build_hull_graph(*hull, least_graph);
    if (graph) graph_ = std::make_unique<const HullGraph>(std::move(graph));
  }
  if (is_convex(kind_of(shape)))
    bodies_ = {convex_body<float>(shape, graph_.get()), convex_body<double>(shape, graph_.get()),
               convex_body<Wide>(shape, graph_.get())};
  if (const auto* plane = std::get_if<HalfSpace>(&shape)) half_space_ = unit_half_space(*plane);
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
    tree_ = build_mesh_tree(*mesh);
    used_ = narrow::used_vertices(*mesh);
    if (used_.size() == mesh->vertices.size()) used_ = {};
  }
  if (const auto* solid = std::get_if<SolidMesh>(&shape)) solid_ = std::make_shared<const SolidParts>(*solid);
  if (!is_bounded(kind_of(shape))) return;
  largest_length_ = tree_.nodes.empty() ? narrow::largest_length(shape)
                                        : std::max(tree_.nodes.front().lo.cwiseAbs().maxCoeff(),
                                                   tree_.nodes.front().hi.cwiseAbs().maxCoeff());
}

std::span<const Vec3> Collider::used_vertices() const {
  const auto* mesh = std::get_if<TriangleMesh>(shape_);
  if (!mesh) return {};
  return used_.empty() && !tree_.nodes.empty() ? std::span<const Vec3>(mesh->vertices) : used_;
}

}  // namespace touchstone
