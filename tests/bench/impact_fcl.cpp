// FCL's conservative advancement with motions whose pivot is set, which its transform overload leaves
// uninitialised.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include "tests/bench/impact_cases.h"

namespace touchstone::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;
using Path = fcl::InterpMotion<double>;

Geometry make_geometry(const Shape& s) {
  if (const auto* x = std::get_if<Sphere>(&s)) return std::make_shared<fcl::Sphered>(x->radius);
  if (const auto* x = std::get_if<Box>(&s)) return std::make_shared<fcl::Boxd>(Vec3(2 * x->half_extents));
  if (const auto* x = std::get_if<Capsule>(&s))
    return std::make_shared<fcl::Capsuled>(x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Cylinder>(&s))
    return std::make_shared<fcl::Cylinderd>(x->radius, 2 * x->half_height);
  const auto& h = std::get<Hull>(s);
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& f : h.faces) faces->insert(faces->end(), {3, f[0], f[1], f[2]});
  return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<fcl::Vector3d>>(h.vertices),
                                        static_cast<int>(h.faces.size()), faces);
}

Path make_path(const Pose& pose, const Motion& m) {
  const Pose end = pose_at(pose, m, 1);
  return Path(rotation_matrix(pose.rotation), pose.translation, rotation_matrix(end.rotation),
              end.translation, Vec3::Zero());
}

class Fcl final : public ImpactContestant {
 public:
  explicit Fcl(const std::vector<MovingCase>& cases) {
    for (const MovingCase& c : cases)
      pairs_.push_back({make_geometry(c.a), make_geometry(c.b), make_path(c.pose_a, c.motion_a),
                        make_path(c.pose_b, c.motion_b)});
    request_.ccd_motion_type = fcl::CCDM_LINEAR;
    request_.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  }
  void ask(std::size_t i, FoundImpact& out) override {
    const Pair& p = pairs_[i];
    // A query leaves its motions at the time where it ended.
    const Path path_a = p.path_a, path_b = p.path_b;
    fcl::ContinuousCollisionResultd r;
    out.failed = fcl::continuousCollide(p.a.get(), &path_a, p.b.get(), &path_b, request_, r) < 0;
    out.t.reset();
    if (r.is_collide) out.t = r.time_of_contact;
  }

 private:
  struct Pair {
    Geometry a, b;
    Path path_a, path_b;
  };
  std::vector<Pair> pairs_;
  fcl::ContinuousCollisionRequestd request_;
};

}  // namespace

ImpactContestantPtr make_impact_fcl(const MovingKind& kind, Course course,
                                    const std::vector<MovingCase>& cases) {
  if (kind.a == ShapeKind::ellipsoid || course == Course::spin) return nullptr;
  return std::make_unique<Fcl>(cases);
}

}  // namespace touchstone::bench
