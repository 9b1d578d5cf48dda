// Recorded scenes (format cdh-scene 1: scene.txt + frames.npy + frames.csv) of simulations and robots, with
// one pose per body and frame. A recorded body may have several shapes ("geoms"); here every geom becomes its
// own body.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "scenarios/value/case.h"

namespace touchstone {

// NumPy arrays of format 1.0, little-endian doubles, C order, three axes: recorded poses.

struct Npy3 {
  std::array<std::size_t, 3> shape{};  // frames, bodies, columns
  std::vector<double> values;
  std::span<const double> row(std::size_t i, std::size_t j) const {
    return std::span(values).subspan((i * shape[1] + j) * shape[2], shape[2]);
  }
};

/// Throws InputError "file: reason" on another format, a file of the wrong length, or a value that is not
/// finite.
Npy3 load_npy3(const std::filesystem::path& file);

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

/// Scenes made from a frame have one Body per geom: pose = body ∘ geom in double arithmetic; group = the
/// recorded body's index when it has more than one geom; `ignored` applies to all geoms of the two bodies.
struct RealScene {
  std::string name;
  std::vector<Shape> shapes;
  std::vector<RealBody> bodies;   // the poses.shape[1] moving ones first
  std::vector<BodyPair> ignored;  // pairs of bodies
  Npy3 poses;                     // frames × moving bodies × (7: position, quaternion; 13: and velocities)
  std::vector<RealFrame> frames;

  int frame_count() const { return static_cast<int>(frames.size()); }
  bool has_velocities() const { return poses.shape[2] == 13; }
  /// True when frames f and f+1 belong to the same segment.
  bool is_followed(int f) const;

  Scene frame(int f) const;
  /// If the data has velocities: motion = recorded velocity · 1/60 s, for every frame. Otherwise: the
  /// displacement and the shortest rotation to the next frame, and no motion at the last frame of a segment.
  /// A geom away from its body's origin moves along the chord of its arc.
  Scene frame_with_motion(int f) const;
  /// Inserts all bodies at frame `first` and queries; then, for each frame up to `last`, moves every moving
  /// body and queries. Between segments the bodies jump.
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

namespace touchstone::fuzz {

// A recorded scene as cases: for each frame the whole scene (candidate pairs, contacts), and a pair case for
// each pair of bodies whose exact boxes overlap (overlap, distance, contact; time of impact when the
// recording moves).

/// "first:end:step" as in a Python range; empty: about five evenly spread frames. Throws InputError when it
/// is not a valid range.
std::vector<int> frames_from_text(const std::string& text, int frame_count);

std::vector<Case> real_scene_cases(const RealScene& scene, int frame);

}  // namespace touchstone::fuzz
