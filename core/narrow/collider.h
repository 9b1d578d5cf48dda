// A shape prepared for queries: what they need of it besides its fields is computed once, for any number of
// poses. A query about a bare shape prepares what it needs itself; its answer is the same.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <tuple>

#include "core/narrow/mesh_tree.h"
#include "core/shape/convex_body.h"
#include "core/shape/hull_graph.h"

namespace touchstone {

class Collider;
struct SolidParts;  // core/narrow/solid.h

/// A half-space in doubles: n·x <= offset with a unit normal n. `length`: of the normal as given, which both
/// have been divided by.
struct UnitHalfSpace {
  Vec3 normal;
  double offset, length;
};

/// A shape, and its collider if it has one.
struct ShapeRef {
  const Shape* shape = nullptr;
  const Collider* collider = nullptr;  // of `shape`, or null

  ShapeRef() = default;
  ShapeRef(const Shape& s) : shape(&s) {}  // implicit: wherever a shape is asked for, a prepared one will do
  ShapeRef(Shape&&) = delete;
  explicit ShapeRef(const Collider& c);

  /// Precondition: a bounded convex shape. R: float, double or Wide.
  template <class R>
  ConvexBody<R> body() const;
  /// Precondition: a half-space.
  UnitHalfSpace half_space() const;
  /// Null: not a mesh, or not prepared.
  const MeshTree* tree() const;
  /// As touchstone::bounding_radius().
  double bounding_radius() const;
};

/// A shape in a pose, as overlap(), distance() and contact() take it.
struct PlacedShape : ShapeRef {
  Pose pose;

  PlacedShape() = default;
  PlacedShape(const Shape* s, const Pose& p) : ShapeRef(*s), pose(p) {}
  PlacedShape(const Collider& c, const Pose& p) : ShapeRef(c), pose(p) {}
};

/// The same with a motion, as time_of_impact() takes it.
struct MovingShape : PlacedShape {
  Motion motion;

  MovingShape() = default;
  MovingShape(const Shape* s, const Pose& p, const Motion& m) : PlacedShape(s, p), motion(m) {}
  MovingShape(const Collider& c, const Pose& p, const Motion& m) : PlacedShape(c, p), motion(m) {}
};

class Collider {
 public:
  /// For `least_graph`: no hull gets a graph. For colliders that serve a few queries.
  static constexpr std::size_t no_graph = static_cast<std::size_t>(-1);

  /// Refers to the shape, which outlives the collider, in place and unchanged. Hulls with at least
  /// `least_graph` vertices get a graph (hull_graph.h), meshes a tree (mesh_tree.h), solid meshes both
  /// (solid.h).
  explicit Collider(const Shape& shape, std::size_t least_graph = hull_graph_least);

  PlacedShape at(const Pose& pose) const { return {*this, pose}; }
  MovingShape at(const Pose& pose, const Motion& motion) const { return {*this, pose, motion}; }

  const Shape& shape() const { return *shape_; }
  template <class R>
  const ConvexBody<R>& body() const {
    return std::get<ConvexBody<R>>(bodies_);
  }
  const UnitHalfSpace& half_space() const { return half_space_; }
  /// Null: not a solid mesh.
  const SolidParts* solid() const { return solid_.get(); }
  const MeshTree* tree() const { return kind_of(*shape_) == ShapeKind::mesh ? &tree_ : nullptr; }
  /// A mesh's vertices that belong to a triangle.
  std::span<const Vec3> used_vertices() const;
  double bounding_radius() const { return bounding_radius_; }
  /// Of a bounded shape: the largest number that is a length (core/narrow/unit_scale.h); of a mesh, the
  /// largest coordinate of its triangles.
  double largest_length() const { return largest_length_; }

 private:
  const Shape* shape_;
  std::unique_ptr<const HullGraph> graph_;  // in place: the bodies refer to it
  std::tuple<ConvexBody<float>, ConvexBody<double>, ConvexBody<Wide>> bodies_;  // of a bounded convex shape
  UnitHalfSpace half_space_{};
  MeshTree tree_;
  std::vector<Vec3> used_;  // empty: every vertex
  std::shared_ptr<const SolidParts> solid_;
  double bounding_radius_ = 0, largest_length_ = 0;
};

UnitHalfSpace unit_half_space(const HalfSpace& h);

inline ShapeRef::ShapeRef(const Collider& c) : shape(&c.shape()), collider(&c) {}

template <class R>
ConvexBody<R> ShapeRef::body() const {
  return collider ? collider->body<R>() : convex_body<R>(*shape);
}

inline UnitHalfSpace ShapeRef::half_space() const {
  return collider ? collider->half_space() : unit_half_space(*std::get_if<HalfSpace>(shape));
}

inline const MeshTree* ShapeRef::tree() const { return collider ? collider->tree() : nullptr; }

inline double ShapeRef::bounding_radius() const {
  return collider ? collider->bounding_radius() : touchstone::bounding_radius(*shape);
}

}  // namespace touchstone
