// Pairs near contact for the narrow-phase benchmark.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/shape/shape.h"

namespace touchstone::bench {

enum class Task { overlap, distance, contact };
inline constexpr std::string_view task_names[] = {"overlap", "distance", "contact"};

struct PairCase {
  Shape a, b;
  Pose pose_a, pose_b;
};

/// Rows of the table: two shapes; hulls are named by their number of vertices.
struct PairKind {
  std::string_view name;
  ShapeKind a, b;
  int vertices = 0;
};
inline constexpr PairKind pair_kinds[] = {
    {"sphere-sphere", ShapeKind::sphere, ShapeKind::sphere},
    {"sphere-box", ShapeKind::sphere, ShapeKind::box},
    {"sphere-capsule", ShapeKind::sphere, ShapeKind::capsule},
    {"capsule-capsule", ShapeKind::capsule, ShapeKind::capsule},
    {"capsule-box", ShapeKind::box, ShapeKind::capsule},
    {"box-box", ShapeKind::box, ShapeKind::box},
    {"cylinder-cylinder", ShapeKind::cylinder, ShapeKind::cylinder},
    {"box-cylinder", ShapeKind::box, ShapeKind::cylinder},
    {"box-cone", ShapeKind::box, ShapeKind::cone},
    {"ellipsoid-ellipsoid", ShapeKind::ellipsoid, ShapeKind::ellipsoid},
    {"hull8", ShapeKind::hull, ShapeKind::hull, 8},
    {"hull32", ShapeKind::hull, ShapeKind::hull, 32},
    {"hull128", ShapeKind::hull, ShapeKind::hull, 128},
    {"hull512", ShapeKind::hull, ShapeKind::hull, 512},
};

/// Half of them overlap; gap or depth uniform up to 5 % of the size. Contacts: all overlap.
std::vector<PairCase> make_cases(const PairKind& kind, Task task, int count, std::uint64_t seed);

}  // namespace touchstone::bench
