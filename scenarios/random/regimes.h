// Regimes: situations that the default mix must contain whatever its families are, because some engine fails
// only there. A row has a test for the situation and its minimum share of the default mix.
#pragma once

#include <span>
#include <string_view>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct Regime {
  std::string_view name;
  std::string_view line;  // summary for display
  int one_in;             // at least one case in this many of the default mix shows it
  bool (*shown)(const Case& c, const Case& before);  // `before`: the case with the previous index
};

/// The catalog.
std::span<const Regime> regimes();

}  // namespace touchstone::fuzz
