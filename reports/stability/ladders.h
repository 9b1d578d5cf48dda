// The ladders of `touchstone stability` as data: one degeneracy per row, from harmless to severe.
#pragma once

#include <span>
#include <vector>

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct LadderRow {
  const char *name, *line, *unit;
  std::vector<double> values;  // harmless first
  std::vector<Question> questions;
  Scene (*make)(Rng& rng, double value);
};

std::span<const LadderRow> ladders();

}  // namespace touchstone::fuzz
