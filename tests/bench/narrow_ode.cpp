// ODE's dCollide on placeable geoms. It has no distance query, no cone and no ellipsoid.
#include <ode/ode.h>

#include "tests/bench/narrow_cases.h"

namespace touchstone::bench {
namespace {

// dCreateConvex keeps the arrays.
struct HullArrays {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

dGeomID make_hull(const Hull& h, HullArrays& arrays) {
  for (const Vec3& v : h.vertices) arrays.points.insert(arrays.points.end(), v.data(), v.data() + 3);
  for (const auto& f : h.faces) {
    const auto at = [&](int k) -> const Vec3& { return h.vertices[static_cast<std::size_t>(k)]; };
    const Vec3 n = (at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0])).normalized();
    arrays.planes.insert(arrays.planes.end(), {n.x(), n.y(), n.z(), n.dot(at(f[0]))});
    arrays.polygons.insert(arrays.polygons.end(), {3u, static_cast<unsigned>(f[0]),
                                                   static_cast<unsigned>(f[1]), static_cast<unsigned>(f[2])});
  }
  return dCreateConvex(nullptr, arrays.planes.data(), static_cast<unsigned>(h.faces.size()),
                       arrays.points.data(), static_cast<unsigned>(h.vertices.size()),
                       arrays.polygons.data());
}

dGeomID make_geom(const Shape& s, const Pose& pose, HullArrays& arrays) {
  dGeomID g = nullptr;
  if (const auto* x = std::get_if<Sphere>(&s)) g = dCreateSphere(nullptr, x->radius);
  if (const auto* x = std::get_if<Box>(&s)) {
    const Vec3 e = 2 * x->half_extents;
    g = dCreateBox(nullptr, e.x(), e.y(), e.z());
  }
  if (const auto* x = std::get_if<Capsule>(&s)) g = dCreateCapsule(nullptr, x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Cylinder>(&s)) g = dCreateCylinder(nullptr, x->radius, 2 * x->half_height);
  if (const auto* x = std::get_if<Hull>(&s)) g = make_hull(*x, arrays);
  const Quat q = normalized(pose.rotation);
  const dQuaternion dq = {q.w, q.x, q.y, q.z};
  dGeomSetQuaternion(g, dq);
  dGeomSetPosition(g, pose.translation.x(), pose.translation.y(), pose.translation.z());
  return g;
}

class Ode final : public NarrowContestant {
 public:
  Ode(Task task, const std::vector<PairCase>& cases) : task_(task), arrays_(2 * cases.size()) {
    dInitODE2(0);
    for (std::size_t i = 0; i < cases.size(); ++i)
      pairs_.push_back({make_geom(cases[i].a, cases[i].pose_a, arrays_[2 * i]),
                        make_geom(cases[i].b, cases[i].pose_b, arrays_[2 * i + 1])});
  }
  ~Ode() override {
    for (const auto& p : pairs_) {
      dGeomDestroy(p[0]);
      dGeomDestroy(p[1]);
    }
    dCloseODE();
  }
  void ask(std::size_t i, Found& out) override {
    dContactGeom c[16];
    const int flags = task_ == Task::overlap ? 1 : 16;
    const int n = dCollide(pairs_[i][0], pairs_[i][1], flags, c, sizeof(dContactGeom));
    out.overlap = n > 0;
    out.points = n;
    if (n == 0) return;
    int best = 0;
    for (int k = 1; k < n; ++k)
      if (c[k].depth > c[best].depth) best = k;
    out.gap = -c[best].depth;
    out.normal = -Vec3(c[best].normal[0], c[best].normal[1], c[best].normal[2]);
  }

 private:
  Task task_;
  std::vector<HullArrays> arrays_;
  std::vector<std::array<dGeomID, 2>> pairs_;
};

bool knows(ShapeKind k) {
  return k == ShapeKind::sphere || k == ShapeKind::box || k == ShapeKind::capsule ||
         k == ShapeKind::cylinder || k == ShapeKind::hull;
}

}  // namespace

NarrowContestantPtr make_narrow_ode(Task task, const PairKind& kind, const std::vector<PairCase>& cases) {
  if (task == Task::distance || !knows(kind.a) || !knows(kind.b)) return nullptr;
  return std::make_unique<Ode>(task, cases);
}

}  // namespace touchstone::bench
