// A scene is data: shapes, bodies that place them, and a script of steps. Every number is an IEEE double and
// denotes itself exactly (truth.md §1).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/pose.h"
#include "core/shape/shape.h"

namespace touchstone {

struct Body {
  std::string name;  // for display; may be empty
  int shape = 0;     // index into Scene::shapes
  Pose pose;
  std::optional<Motion> motion;  // over one step, t in [0,1]
  bool is_static = false;
  int group = -1;  // bodies of the same group >= 0 (geoms of one link) are never paired
  bool operator==(const Body&) const = default;
};

/// One step of a script. Scripts drive broad phases; every `query` asks for the full set of candidate pairs.
struct Step {
  enum class Op : std::uint8_t { insert, move, remove, query };
  Op op = Op::query;
  int body = -1;             // for insert, move, remove
  std::optional<Pose> pose;  // for insert (if absent, the body's own pose) and move
  bool operator==(const Step&) const = default;
};

using BodyPair = std::pair<int, int>;  // first < second

struct Scene {
  std::string name;
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<BodyPair> ignored;  // pairs that the user filters out; first < second, sorted
  std::vector<Step> script;       // empty: insert every body, then query once
  /// The length that questions about a margin refer to, in the scene's unit; any sign. Other questions ignore
  /// it.
  double margin = 0;
  const Shape& shape_of(int body) const {
    return shapes[static_cast<std::size_t>(bodies[static_cast<std::size_t>(body)].shape)];
  }
  bool operator==(const Scene&) const = default;
};

/// Throws InputError; the place is given as in the JSON form ("bodies[3].pose.rotation"). A quaternion must
/// be finite and not zero; a mesh or half-space body is static or has no motion; a script removes or moves
/// only inserted bodies.
void validate(const Scene& scene);

/// Order-dependent hash of every number in the scene, a margin of 0 and names excluded.
std::uint64_t hash(const Scene& scene);

/// True when both bodies are of the same group or the pair is listed in `ignored`.
bool is_filtered(const Scene& scene, int a, int b);

/// The script, or "insert all, query" when it is empty.
std::vector<Step> effective_script(const Scene& scene);

/// L of docs/truth.md §2: the largest of both shapes' lengths, the coordinates of positions and vertices, and
/// the distance between the positions. For a half-space, the distance of its plane counts. With motion, L
/// covers the whole step. The scene's margin counts as a length.
double scale_of_pair(const Scene& scene, int a, int b);

/// A scene of two bodies, a and b of `scene`, renumbered 0 and 1, with its margin and without a script.
Scene extract_pair(const Scene& scene, int a, int b);

}  // namespace touchstone
