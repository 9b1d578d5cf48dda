// Recorded scenes (format cdh-scene 1: scene.txt + frames.npy + frames.csv): simulations and robots, one pose
// a body and frame. A body may carry several shapes ("geoms"); here every geom is a body of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "scenarios/import/npy.h"

namespace touchstone {

struct RealGeom {
  int shape = 0;
  Pose in_body;
};

struct RealBody {
  std::string name;
  bool is_static = false;
  Pose pose;  // of a static body
  std::vector<RealGeom> geoms;
};

struct RealFrame {
  int segment = 0;    // frames are consecutive in time only within one segment
  std::string label;  // "settling", "path", "random", …
};

/// Scenes made from a frame have one Body a geom: pose = body ∘ geom in double arithmetic, group = the
/// recorded body's index when it has more than one geom, `ignored` carried over to all geoms of the two
/// bodies.
struct RealScene {
  std::string name;
  std::vector<Shape> shapes;
  std::vector<RealBody> bodies;   // moving ones first, as many as poses.shape[1]
  std::vector<BodyPair> ignored;  // of bodies
  Npy3 poses;                     // frames × moving bodies × (7: position, quaternion; 13: and velocities)
  std::vector<RealFrame> frames;

  int frame_count() const { return static_cast<int>(frames.size()); }
  bool has_velocities() const { return poses.shape[2] == 13; }
  /// Frames f and f+1 belong to one segment.
  bool is_followed(int f) const;

  Scene frame(int f) const;
  /// With velocities in the data: motion = recorded velocity · 1/60 s, for every frame. Without: the
  /// displacement and the shortest rotation to the next frame, and no motion at the last frame of a segment.
  /// A geom away from its body's origin moves on the chord of its arc.
  Scene frame_with_motion(int f) const;
  /// Insert all bodies at frame `first`, query; then for each frame to `last` move every moving body and
  /// query. Between segments the bodies jump.
  Scene script(int first, int last) const;
};

inline constexpr double real_scene_time_step = 1.0 / 60;  // of the recordings that have velocities

/// Throws InputError "file:line: reason".
RealScene load_real_scene(const std::filesystem::path& directory);

/// Parts of load_real_scene: scene.txt without frames (poses and frames stay empty).
struct RealSceneText {
  RealScene scene;
  int moving = 0, frames = 0, columns = 0;
};
RealSceneText read_real_scene_text(const std::filesystem::path& file);

}  // namespace touchstone
