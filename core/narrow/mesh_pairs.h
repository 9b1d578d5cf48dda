// The pairs of triangles of two meshes that can decide a query: a descent through both trees, in doubles and
// in A's frame. B's boxes keep the axes of B's frame, so the rotation between the frames serves all of them.
// A pair is left out only if its bounds, rounding included, prove that it does not matter.
#pragma once

#include <vector>

#include "core/narrow/collider.h"
#include "core/narrow/mesh_tree.h"
#include "core/narrow/triangle_pair.h"

namespace touchstone::narrow {

/// The tree of a mesh: its collider's, or one built here.
class TreeOf {
 public:
  explicit TreeOf(const ShapeRef& mesh);
  TreeOf(const TreeOf&) = delete;
  TreeOf& operator=(const TreeOf&) = delete;
  const MeshTree& operator*() const { return *tree_; }
  const MeshTree* operator->() const { return tree_; }

 private:
  MeshTree own_;
  const MeshTree* tree_;
};

/// Two meshes, B's frame in A's: x_a = rotation·x_b + offset, rounded as by filtered::relative() or better.
struct MeshScene {
  TreeOf tree_a, tree_b;
  const TriangleMesh &a, &b;
  Mat3 rotation;
  Vec3 offset;
  double reach_a, reach_b;  // bounding radii about the origins of the frames
  /// By how much a corner of B, computed in A's frame, may be off relative to A.
  double displacement;

  /// Precondition: both are meshes.
  MeshScene(const ShapeRef& a, const ShapeRef& b, const Mat3& rotation, const Vec3& offset);
  double size() const { return reach_a + reach_b + offset.norm(); }
  /// About the largest of its lengths, finite. in_range(): squares of areas are neither too small nor too
  /// large.
  double largest_length() const;
  bool in_range() const;
};

enum class PairsWanted {
  verdict,  // until two triangles certainly meet; else those that might
  nearest,  // those that may have the least gap: the nearest, or the deepest
  meeting   // all that might meet
};

/// Bounds of the gap for the computed corners, `displacement` not included.
struct TrianglePair {
  double lo, hi;
  std::int32_t a, b;
  Vec3 point_a, point_b, normal;  // A's frame; set if hi is finite and positive
};

struct TrianglePairs {
  bool certainly_meet = false;      // some pair does; ends a `verdict`
  std::vector<TrianglePair> pairs;  // ascending by (lo, a, b)
  /// The gap of the computed meshes is at least this, pairs left out included.
  double lo = 0;
};

/// `keep`: pairs whose gap may exceed the least by up to this length are kept too; negative: pairs that could
/// improve the least gap by no more than -keep are left out.
TrianglePairs triangle_pairs(const MeshScene& scene, PairsWanted wanted, double keep);

/// The corners in A's frame.
Triangle triangle_of_a(const MeshScene& scene, std::int32_t triangle);
Triangle triangle_of_b(const MeshScene& scene, std::int32_t triangle);

}  // namespace touchstone::narrow
