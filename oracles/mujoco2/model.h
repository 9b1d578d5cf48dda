// A scene as a MuJoCo model, written in MJCF and compiled by MuJoCo: a geom for each body, on a body with a
// free joint, so that no pair is filtered out; planes belong to the world. MuJoCo takes half extents and half
// heights, axis z, quaternions with w first, and keeps the vertices of meshes as floats, in their own frame
// of inertia.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::mujoco2 {

struct DeleteModel {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
};
struct DeleteData {
  void operator()(mjData* d) const { mj_deleteData(d); }
};

class World {
 public:
  /// Throws kit::Unsupported if MuJoCo's compiler refuses the scene.
  World(const ts_scene& scene, const ts_received& received);

  /// Whether MuJoCo has such a shape, and so a geom for the body.
  bool has_geom(int body) const { return geoms_[static_cast<std::size_t>(body)] >= 0; }
  std::size_t bodies() const { return geoms_.size(); }
  bool has_all() const {
    return std::ranges::all_of(geoms_, [](int geom) { return geom >= 0; });
  }
  int type(int body) const { return model_->geom_type[geoms_[static_cast<std::size_t>(body)]]; }

  /// Runs mj_collision at the scene's poses.
  void collide();
  /// The same with a margin for the body's contacts. MuJoCo takes the larger one of two geoms' margins.
  void collide_within(int body, double margin);
  const mjContact* begin() const { return data_->contact; }
  const mjContact* end() const { return data_->contact + data_->ncon; }
  /// The body that holds a geom.
  int body_of(int geom) const { return bodies_[static_cast<std::size_t>(geom)]; }

 private:
  void place_bodies(const ts_scene& scene);
  void report(const ts_scene& scene, const ts_received& received) const;

  std::unique_ptr<mjModel, DeleteModel> model_;
  std::unique_ptr<mjData, DeleteData> data_;
  std::vector<int> geoms_, bodies_;  // geom of each body, -1 if it has none; body of each geom
};

}  // namespace touchstone::mujoco2
