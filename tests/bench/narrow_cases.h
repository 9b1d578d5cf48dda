// Pairs near contact for the narrow-phase benchmark, and the interface of its contestants.
#pragma once

#include <limits>
#include <memory>
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

/// What a contestant found; NaN for what it does not report.
struct Found {
  bool overlap = false;
  double gap = std::numeric_limits<double>::quiet_NaN();
  Vec3 normal = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  // unit, A to B
  int points = 0;
};

/// Holds all cases of a cell in its own form; only ask() is timed.
class NarrowContestant {
 public:
  virtual ~NarrowContestant() = default;
  virtual void ask(std::size_t i, Found& out) = 0;
};
using NarrowContestantPtr = std::unique_ptr<NarrowContestant>;

/// Null if the contestant does not answer that question for that pair.
using NarrowMaker = NarrowContestantPtr (*)(Task, const PairKind&, const std::vector<PairCase>&);

NarrowContestantPtr make_narrow_fcl_libccd(Task, const PairKind&, const std::vector<PairCase>&);
NarrowContestantPtr make_narrow_fcl_indep(Task, const PairKind&, const std::vector<PairCase>&);
NarrowContestantPtr make_narrow_bullet(Task, const PairKind&, const std::vector<PairCase>&);
NarrowContestantPtr make_narrow_libccd_gjk(Task, const PairKind&, const std::vector<PairCase>&);
NarrowContestantPtr make_narrow_libccd_mpr(Task, const PairKind&, const std::vector<PairCase>&);
NarrowContestantPtr make_narrow_ode(Task, const PairKind&, const std::vector<PairCase>&);

}  // namespace touchstone::bench
