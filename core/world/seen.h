// Bodies as contacts see them under a plan, and the contact of two of them within the plan's error.
#pragma once

#include "core/narrow/hull_graph.h"
#include "core/narrow/mesh_tree.h"
#include "core/scene/scene.h"
#include "core/world/fidelity.h"

namespace touchstone {

/// A ball that holds the shape, body frame; infinite for a half-space. Not the least one.
struct BoundingBall {
  Vec3 middle = Vec3::Zero();
  double radius = 0;  // rounded up
};
BoundingBall bounding_ball(const Shape& shape);

/// True only when the balls are apart; middles may be rounded by 2^-48 of their coordinates.
inline bool balls_apart(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  const double reach = radius_a + radius_b + 0x1p-47 * (a.lpNorm<1>() + b.lpNorm<1>());
  return (b - a).squaredNorm() > reach * reach * (1 + 0x1p-48);
}

/// A shape of a scene, or the simpler one in its place, with what its queries want. Points into the scene and
/// the plan.
struct SeenShape {
  const Shape* shape = nullptr;
  const SimplerShape* simpler = nullptr;
  MeshTree tree;    // empty but of a mesh
  HullGraph graph;  // empty but of a hull
  BoundingBall ball;
  double reach = 0, size = 0;  // bounding_radius, box_size
  double error() const { return simpler ? simpler->error : 0; }
};
std::vector<SeenShape> seen_shapes(const Scene& scene, const Fidelity& fidelity);

struct SeenBody {
  Pose pose;                     // of the seen shape
  Vec3 middle_w = Vec3::Zero();  // of its ball
};
SeenBody seen_body(const SeenShape& shape, const Pose& body);

/// Contains what is seen; of which kind is the plan's choice.
Aabb seen_box(const Fidelity& fidelity, const SeenShape& shape, const SeenBody& body);

/// How a contact was decided. cheap: by the method's arithmetic alone; rest: by float64.
enum class DecidedBy { balls, cheap, rest };

/// Within fidelity.error of the truth about the bodies' own shapes, as Fidelity says. `bound`, when given, is
/// the proven error, shapes' included (0 for balls).
ContactAnswer contact_seen(const Fidelity& fidelity, const SeenShape& a, const SeenBody& at_a,
                           const SeenShape& b, const SeenBody& at_b, PairMemory* memory = nullptr,
                           DecidedBy* decided = nullptr, double* bound = nullptr);

}  // namespace touchstone
