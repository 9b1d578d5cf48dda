// Two meshes and a list of poses for each (obj1.obj, obj2.obj, frames.csv), rotations as printed matrices.
#pragma once

#include <filesystem>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone {

struct FclFrame {
  double time = 0;
  Placement a, b;  // the printed matrix, a rotation only to its six decimals
};

struct FclMotion {
  std::string name;
  TriangleMesh mesh_a, mesh_b;
  std::vector<FclFrame> frames;
  int frame_count() const { return static_cast<int>(frames.size()); }
  /// Two static mesh bodies at frame f, rotations by the quaternion nearest to the printed matrix.
  Scene frame(int f) const;
};

/// Throws InputError "file:line: reason".
FclMotion load_fcl_motion(const std::filesystem::path& directory);

/// The unit quaternion of a matrix that is a rotation up to rounding (Shepperd 1978: largest component
/// first).
Quat quaternion_of(const Mat3& rotation);

}  // namespace touchstone
