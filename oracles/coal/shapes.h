// Shapes and poses of the C ABI as the types of Coal 3.0.
#pragma once

#include <coal/collision_object.h>
#include <coal/math/transform.h>

#include <memory>

#include "core/math/pose.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::coal_adapter {

using Geometry = std::shared_ptr<coal::CollisionGeometry>;

/// Coal takes full side lengths and full heights; its cone has its apex at +h, as ours does, and its half
/// space is solid where n.x <= d. A hull gets all vertices and its triangles. Throws kit::Unsupported for a
/// flat hull, which has no triangles.
Geometry make_geometry(const ts_shape& shape);

coal::Transform3s make_transform(const Pose& pose);

/// Report what Coal holds, in the ABI's conventions.
void report_shape(int index, const ts_shape& asked, const coal::CollisionGeometry& held,
                  const ts_received& to);
void report_body(int index, const coal::Transform3s& held, const ts_received& to);

}  // namespace touchstone::coal_adapter
