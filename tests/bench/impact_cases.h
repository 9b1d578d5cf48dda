// Moving pairs for the time-of-impact benchmark.
#pragma once

#include <string_view>
#include <vector>

#include "core/shape/shape.h"

namespace touchstone::bench {

/// How the pairs of a cell move. A is at rest except in `both`.
enum class Course {
  translation,  // 0.9 to 1.8 gap lengths towards A
  graze,        // across: passes or touches by up to 1e-3 of the size
  turn,         // like translation, with a rotation of 0.3 rad to 45 degrees
  swing,        // 45 degrees to 2.5 rad
  spin,         // three to ten full turns
  both          // both bodies translate, and rotate by up to 2.5 rad
};
inline constexpr std::string_view course_names[] = {"translation", "graze", "turn", "swing", "spin", "both"};

struct MovingCase {
  Shape a, b;
  Pose pose_a, pose_b;
  Motion motion_a, motion_b;
};

/// Hulls by their number of vertices, all of them extreme.
struct MovingKind {
  std::string_view name;
  ShapeKind a, b;
  int vertices = 0;
};
inline constexpr MovingKind moving_kinds[] = {
    {"box-box", ShapeKind::box, ShapeKind::box},
    {"hull32", ShapeKind::hull, ShapeKind::hull, 32},
    {"sphere-box", ShapeKind::sphere, ShapeKind::box},
    {"sphere-sphere", ShapeKind::sphere, ShapeKind::sphere},
    {"sphere-capsule", ShapeKind::sphere, ShapeKind::capsule},
    {"capsule-capsule", ShapeKind::capsule, ShapeKind::capsule},
    {"capsule-box", ShapeKind::capsule, ShapeKind::box},
    {"hull128", ShapeKind::hull, ShapeKind::hull, 128},
    {"box-cylinder", ShapeKind::box, ShapeKind::cylinder},
    {"ellipsoid-ellipsoid", ShapeKind::ellipsoid, ShapeKind::ellipsoid},
};

std::vector<MovingCase> make_moving_cases(const MovingKind& kind, Course course, int count,
                                          std::uint64_t seed);

}  // namespace touchstone::bench
