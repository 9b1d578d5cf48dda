// Shapes and poses of the C ABI as FCL's own types.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "core/math/pose.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::fcl_adapter {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// FCL has no padding: of a padded shape, the core. FCL takes full side lengths and full heights; its cone
/// has its origin at mid-height, as ours does. A hull gets all vertices and its triangles; a flat hull has no
/// faces, which FCL accepts silently.
Geometry make_geometry(const ts_shape& shape);

fcl::Transform3d make_transform(const Pose& pose);

/// Report what FCL holds, in the ABI's conventions.
void report_shape(int index, const ts_shape& asked, const fcl::CollisionGeometryd& held,
                  const ts_received& to);
void report_body(int index, const fcl::Transform3d& held, const ts_received& to);

}  // namespace touchstone::fcl_adapter
