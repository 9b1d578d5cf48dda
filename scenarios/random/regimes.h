// Regimes: what the default mix must contain whatever its families are, because some engine errs only there.
// A row says how to see it in a case, and the least share of the default mix that shows it.
#pragma once

#include <span>
#include <string_view>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct Regime {
  std::string_view name;
  std::string_view line;  // for people
  int one_in;             // at least one case in so many of the default mix shows it
  bool (*shown)(const Case& c, const Case& before);  // `before`: the case with the index before
};

/// The catalog.
std::span<const Regime> regimes();

}  // namespace touchstone::fuzz
