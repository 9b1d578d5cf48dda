// Ladders: one mechanism each, as pairs of bodies that differ in one number.
#pragma once

#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone::scenarios {

struct Ladder {
  std::string_view name, mechanism, line;
  std::vector<double> values;
  /// Two bodies without a script.
  Scene (*make)(double value);
};

std::vector<Ladder> alignment_ladders();
std::vector<Ladder> degenerate_ladders();
std::vector<Ladder> motion_ladders();
std::vector<Ladder> round_ladders();
std::vector<Ladder> size_ladders();

/// All of them, in a fixed order.
std::vector<Ladder> ladders();

}  // namespace touchstone::scenarios
