// A scene's shapes and bodies as DART's users write them: one Shape each, held by SimpleFrames at the bodies'
// poses. DART takes full side lengths, heights and diameters, axis z.
#pragma once

#include <dart/collision/CollisionDetector.hpp>
#include <dart/dynamics/Shape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <string>
#include <vector>

#include "oracles/abi/plugin_kit.h"

namespace touchstone::dart_adapter {

enum class Backend { own, fcl, fcl_mesh, bullet, ode };

/// The kinds that the back end takes, by their names in a card.
std::vector<std::string> shapes_of(Backend backend);

/// Whether the back end takes the shape, of positive sizes; for another it prints an error and answers for a
/// ball, or not at all.
bool takes(Backend backend, const ts_shape& s);

/// Null if the back end does not take the shape.
dart::dynamics::ShapePtr make_shape(Backend backend, const ts_shape& s);

dart::dynamics::SimpleFramePtr make_frame(const dart::dynamics::ShapePtr& shape, const ts_pose& pose);

/// The pose that the back end holds for the frame.
void report_body(int index, Backend backend, const dart::dynamics::SimpleFrame& frame, const ts_received& to);

/// The sizes of a shape as Bullet holds them, which Debian builds for floats.
void report_floats(int index, const ts_shape& s, const ts_received& to);

/// With FCL, DART replaces some shapes by meshes, made of floats. Reports the mesh that the detector holds
/// for the frame's shape, if it holds one.
bool report_fcl_mesh(int index, const dart::collision::CollisionDetectorPtr& detector,
                     const dart::dynamics::SimpleFrame& frame, const ts_received& to);

}  // namespace touchstone::dart_adapter
