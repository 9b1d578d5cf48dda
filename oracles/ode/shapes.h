// Scene shapes as ODE geometries, in doubles. ODE takes whole sides and heights, axis z, and has no cone,
// ellipsoid or distance.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::ode_adapter {

struct DestroyGeom {
  void operator()(dGeomID g) const { dGeomDestroy(g); }
};
using GeomPtr = std::unique_ptr<dxGeom, DestroyGeom>;

/// What a hull's geometries point to: ODE copies nothing.
struct Hull {
  std::vector<dReal> planes, points;  // n.x = d, 4 a plane; about `centre`
  std::vector<unsigned> polygons;     // 3, i, j, k
  Vec3 centre = Vec3::Zero();         // ODE wants its origin inside
};

/// The geometries of a scene's bodies, where they stand.
class World {
 public:
  World(const ts_scene& scene, const ts_received& received);
  const ts_scene& scene() const { return scene_; }
  const std::vector<GeomPtr>& geoms() const { return geoms_; }
  dxGeom* geom(int body) const { return geoms_[static_cast<std::size_t>(body)].get(); }
  int kind(int body) const { return scene_.shapes[scene_.bodies[body].shape].kind; }
  void put(int body, const ts_pose& pose) const;

 private:
  const ts_scene& scene_;
  std::vector<std::unique_ptr<Hull>> hulls_;  // one a shape, null where it is none
  std::vector<GeomPtr> geoms_;                // one a body; the body's number is its data
};

}  // namespace touchstone::ode_adapter
