// Fragments of source that the reproducers of several engines need.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "core/scene/scene.h"
#include "oracles/reproducer/engine_source.h"

namespace touchstone::fuzz {

/// The text with each @NAME@ replaced. Throws std::logic_error if the text does not contain the name.
std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values);

/// The double as a literal that round-trips; "INFINITY" and "NAN" from <cmath>.
std::string literal(double x);
std::string literals(const Vec3& v);  // "x, y, z"
/// "{{r00, r01, r02, r10, ..., r22}, {x, y, z}}": rotation by rows, translation.
std::string pose_literal(const Pose& p);

/// In JavaScript: "[x, y, z]". fmt prints the shortest text that reads back as the same double, as JavaScript
/// does.
std::string js_array(const Vec3& v);
/// In JavaScript: the translation of A over the step, as seen from B.
std::string js_relative_translation(const EngineQuestion& q);

/// JavaScript: `unit(body)`, the body's quaternion with length 1.
inline constexpr std::string_view js_unit = R"(function unit({ quaternion: q }) {
  const most = Math.max(...q.map(Math.abs)), n = Math.hypot(...q.map((c) => c / most));
  return q.map((c) => c / most / n);
}
)";
/// JavaScript: `turn(body)`, the same for an engine whose capsules, cylinders, cones and height fields stand
/// on y.
inline constexpr std::string_view js_turn_from_y =
    R"(// The engine's capsules, cylinders, cones and height fields stand on y, those of the bodies above on z.
function turn(body) {
  const [x, y, z, w] = unit(body);
  const stands = ["capsule", "cylinder", "cone", "field"].includes(body.shape.type);
  return stands ? [x + w, y + z, z - y, w - x].map((c) => c * Math.SQRT1_2) : [x, y, z, w];
}
)";

/// A function `Vec support_<name>(Vec d)`: the support mapping of the placed body, in the world frame. Empty
/// for a half-space, which is unbounded, and for a mesh, which is not convex.
std::string support_function(std::string_view name, const Shape& shape, const Pose& pose);
bool has_support(const Shape& shape);

/// A description such as "box of half extents 1, 2, 3", for comments.
std::string describe(const Shape& shape);

}  // namespace touchstone::fuzz
