// Scene shapes as ODE geometries, in doubles. ODE takes full side lengths and heights, axis z, and has no
// cone, ellipsoid or distance query.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::ode_adapter {

static_assert(sizeof(dReal) == sizeof(double),
              "the adapter needs ODE in doubles: configure it with ODE_DOUBLE_PRECISION");

struct DestroyGeom {
  void operator()(dGeomID g) const { dGeomDestroy(g); }
};
using GeomPtr = std::unique_ptr<dxGeom, DestroyGeom>;

/// The arrays that a hull's geometries point to, because ODE does not copy them.
struct Hull {
  std::vector<dReal> planes, points;  // planes: 4 numbers each, n.x = d; points relative to `centre`
  std::vector<unsigned> polygons;     // 3, i, j, k
  Vec3 centre = Vec3::Zero();         // ODE needs the origin inside
};

/// The geometries of a scene's bodies, at their poses.
class World {
 public:
  World(const ts_scene& scene, const ts_received& received);
  const ts_scene& scene() const { return scene_; }
  const std::vector<GeomPtr>& geoms() const { return geoms_; }
  dxGeom* geom(int body) const { return geoms_[static_cast<std::size_t>(body)].get(); }
  int kind(int body) const { return scene_.shapes[scene_.bodies[body].shape].kind; }
  void put(int body, const ts_pose& pose) const;
  /// Throws Unsupported if a body has no size. Spheres of radius 0 are held nevertheless, for rays.
  void require_sizes() const;

 private:
  const ts_scene& scene_;
  std::vector<std::unique_ptr<Hull>> hulls_;  // one per shape, null if it is not a hull
  std::vector<GeomPtr> geoms_;                // one per body, with the body's number as data
};

}  // namespace touchstone::ode_adapter
