// FCL's two solvers as shipped, on prepared collision objects.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "tests/bench/narrow_cases.h"

namespace touchstone::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry make_geometry(const Shape& s) {
  if (const auto* x = std::get_if<Sphere>(&s)) return std::make_shared<fcl::Sphered>(x->radius);
  if (const auto* x = std::get_if<Box>(&s)) return std::make_shared<fcl::Boxd>(Vec3(2 * x->half_extents));
  if (const auto* x = std::get_if<Capsule>(&s))
    return std::make_shared<fcl::Capsuled>(x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Cylinder>(&s))
    return std::make_shared<fcl::Cylinderd>(x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Cone>(&s))
    return std::make_shared<fcl::Coned>(x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Ellipsoid>(&s)) return std::make_shared<fcl::Ellipsoidd>(x->semi_axes);
  const auto& h = std::get<Hull>(s);
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& f : h.faces) faces->insert(faces->end(), {3, f[0], f[1], f[2]});
  return std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<fcl::Vector3d>>(h.vertices),
                                        static_cast<int>(h.faces.size()), faces);
}

fcl::Transform3d make_transform(const Pose& pose) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = rotation_matrix(pose.rotation);
  t.translation() = pose.translation;
  return t;
}

class Fcl final : public NarrowContestant {
 public:
  Fcl(Task task, fcl::GJKSolverType solver, const std::vector<PairCase>& cases) : task_(task) {
    for (const PairCase& c : cases)
      pairs_.push_back(
          {{make_geometry(c.a), make_transform(c.pose_a)}, {make_geometry(c.b), make_transform(c.pose_b)}});
    collide_.gjk_solver_type = solver;
    collide_.enable_contact = task == Task::contact;
    collide_.num_max_contacts = task == Task::contact ? 16 : 1;
    distance_.gjk_solver_type = solver;
    distance_.enable_nearest_points = true;
  }
  void ask(std::size_t i, Found& out) override {
    const Pair& p = pairs_[i];
    if (task_ == Task::distance) {
      fcl::DistanceResultd r;
      out.gap = fcl::distance(&p.a, &p.b, distance_, r);
      if (out.gap < 0) out.gap = 0;  // unsigned: contact is 0 or −1
      return;
    }
    fcl::CollisionResultd r;
    fcl::collide(&p.a, &p.b, collide_, r);
    out.overlap = r.isCollision();
    out.points = static_cast<int>(r.numContacts());
    if (task_ != Task::contact || r.numContacts() == 0) return;
    double depth = -HUGE_VAL;
    for (std::size_t k = 0; k < r.numContacts(); ++k)
      if (const auto& c = r.getContact(k); c.penetration_depth > depth) {
        depth = c.penetration_depth;
        out.normal = c.normal;
      }
    out.gap = -depth;
  }

 private:
  struct Pair {
    fcl::CollisionObjectd a, b;
  };
  Task task_;
  std::vector<Pair> pairs_;
  fcl::CollisionRequestd collide_;
  fcl::DistanceRequestd distance_;
};

}  // namespace

NarrowContestantPtr make_narrow_fcl_libccd(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  return std::make_unique<Fcl>(task, fcl::GST_LIBCCD, cases);
}
NarrowContestantPtr make_narrow_fcl_indep(Task task, const PairKind&, const std::vector<PairCase>& cases) {
  return std::make_unique<Fcl>(task, fcl::GST_INDEP, cases);
}

}  // namespace touchstone::bench
