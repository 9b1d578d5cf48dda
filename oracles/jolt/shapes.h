// Shapes and poses of the C ABI as Jolt's own types: floats, half extents, round shapes that stand on y.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/Shape/Shape.h>

#include <vector>

#include "core/math/pose.h"
#include "oracles/abi/touchstone_engine.h"

namespace touchstone::jolt_adapter {

struct Setting {
  const char* name;
  bool tuned;  // convex radius 0 and tolerances 1e-7
  float tolerance() const;
};

/// A shape and how far its rounded corners, edges or rim may fall short, and a hull's points stick out, as
/// Jolt documents it: mConvexRadius, mMaxErrorConvexRadius, mHullTolerance.
struct Held {
  JPH::RefConst<JPH::Shape> shape;
  double claim = 0;
};

/// Throws kit::Unsupported for a shape that the adapter does not make, or that Jolt refuses.
Held make_shape(const ts_shape& shape, const Setting& setting);

/// True for shapes whose axis is z here and y in Jolt: their bodies are turned by a quarter about x.
inline bool stands_on_z(int kind) { return kind == TS_CAPSULE || kind == TS_CYLINDER || kind == TS_CONE; }

struct Placed {
  JPH::Quat rotation;  // of Jolt's shape
  JPH::RVec3 translation;
};
Placed make_placed(const ts_pose& pose, int kind);

inline Vec3 to_vec3(JPH::Vec3Arg v) { return {v.GetX(), v.GetY(), v.GetZ()}; }

/// Report what Jolt holds, in the ABI's conventions.
void report_shape(int index, const ts_shape& asked, const ts_received& to);
void report_body(int index, const Placed& held, int kind, const ts_received& to);

}  // namespace touchstone::jolt_adapter
