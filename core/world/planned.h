// Bodies as a plan presents them to contact queries, and the contact of two of them within the plan's error.
#pragma once

#include "core/narrow/collider.h"
#include "core/scene/scene.h"
#include "core/world/fidelity.h"

namespace touchstone {

/// A ball that contains the shape, in the body frame; infinite for a half-space. Not the smallest one.
struct BoundingBall {
  Vec3 middle = Vec3::Zero();
  double radius = 0;  // rounded up
};
BoundingBall bounding_ball(const Shape& shape);

/// Slack for centres that are rounded by 2^-48 of their coordinates, and for the products in balls_apart.
inline constexpr double ball_centre_slack = 0x1p-47, ball_product_slack = 0x1p-48;

/// True only when the balls are apart. Centres may be rounded by 2^-48 of their coordinates.
inline bool balls_apart(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  const double reach = radius_a + radius_b + ball_centre_slack * (a.lpNorm<1>() + b.lpNorm<1>());
  return (b - a).squaredNorm() > reach * reach * (1 + ball_product_slack);
}

/// A shape of a scene, or the simpler shape that replaces it, prepared for its queries. Refers to the scene
/// and the plan.
struct PlannedShape {
  Collider collider;
  const SimplerShape* simpler = nullptr;  // null: the shape is the scene's own
  BoundingBall ball;
  double size = 0;  // box_size
  const Shape& shape() const { return collider.shape(); }
  double reach() const { return collider.bounding_radius(); }
  double error() const { return simpler ? simpler->error : 0; }
};
std::vector<PlannedShape> planned_shapes(const Scene& scene, const Fidelity& fidelity);

struct PlannedBody {
  Pose pose;                     // of the shape used
  Vec3 centre_w = Vec3::Zero();  // centre of its ball, world frame
};
PlannedBody planned_body(const PlannedShape& shape, const Pose& body);

/// Contains the shape used, and half of the plan's margin around it. The plan chooses the kind of box.
Aabb planned_box(const Fidelity& fidelity, const PlannedShape& shape, const PlannedBody& body);

/// How a contact was decided. cheap: by the method's arithmetic alone; rest: by float64.
enum class DecidedBy { balls, cheap, rest };

/// Within fidelity.error of the truth about the original shapes; see Fidelity. `bound`, when given, receives
/// the proven error, including that of the shapes (0 for balls).
ContactAnswer planned_contact(const Fidelity& fidelity, const PlannedShape& a, const PlannedBody& at_a,
                              const PlannedShape& b, const PlannedBody& at_b, PairMemory* memory = nullptr,
                              DecidedBy* decided = nullptr, double* bound = nullptr);

/// A pair about the plan's margin.
struct PlannedNear {
  Outcome outcome = Outcome::answered;
  bool within = false;
  std::optional<double> gap;             // of a pair that is apart and within the margin
  std::optional<ContactAnswer> contact;  // of a pair that overlaps
};

/// Whether the gap is at most the margin, and unless the plan is for verdicts only, the gap or the contact.
/// Within fidelity.error, as planned_contact().
PlannedNear planned_near(const Fidelity& fidelity, const PlannedShape& a, const PlannedBody& at_a,
                         const PlannedShape& b, const PlannedBody& at_b, PairMemory* memory = nullptr,
                         DecidedBy* decided = nullptr, double* bound = nullptr);

}  // namespace touchstone
