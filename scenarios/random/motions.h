// Smooth motions in frames, as persistent contacts have them. They are kinematics without physics: a formula
// gives the poses at each time, and nothing reacts to a contact. A motion is a case whose script inserts the
// bodies and moves them; each query of the script is a frame.
#pragma once

#include <span>
#include <string_view>

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct MotionRow {
  std::string_view name;
  std::string_view line;  // summary for display
  /// The scene with `frames` >= 2 queries, and the questions about its pairs.
  void (*make)(Rng& rng, int frames, Case& out);
};

/// The catalog.
std::span<const MotionRow> motion_rows();

}  // namespace touchstone::fuzz
