// The state of a broad phase before each query of a script, and boxes in plain arithmetic: the material for
// lies about the internals of a broad phase.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/math/aabb.h"
#include "core/scene/scene.h"
#include "tests/mutants/mutant.h"

namespace touchstone::mutants {

struct BodyHistory {
  std::optional<Pose> pose;    // now; empty: not present
  std::optional<Pose> before;  // before its last insert or move, if it was ever present
  std::optional<Pose> first;   // at its first insert
  int inserts = 0;
  int moves = 0;           // since its last insert
  int moves_in_frame = 0;  // since the last query
  int slot = -1;           // in an array in which a removal is filled with the last element
};

struct QueryState {
  int query = 0;
  int removals = 0;  // so far
  int present = 0;
  std::vector<BodyHistory> bodies;
};

/// One per query step.
std::vector<QueryState> replay(const Scene& scene);

/// Extents by the support mapping, rounded to nearest, not outward.
Aabb plain_box(const Shape& shape, const Pose& pose);

/// Keeps the reported pairs for which `kept` holds, a < b.
using Kept = std::function<bool(const Scene&, const QueryState&, int a, int b)>;
Lie keep_pairs(Kept kept);

/// Keeps the reported pairs whose boxes, as the lie sees them, overlap. An empty box overlaps nothing.
using BoxOf = std::function<Aabb(const Scene&, const QueryState&, int body)>;
Lie keep_overlapping(BoxOf box_of);

/// Changes the pairs of each query as a list.
using Listed = std::function<void(const Scene&, const QueryState&, std::vector<BodyPair>&)>;
Lie change_list(Listed change);

}  // namespace touchstone::mutants
