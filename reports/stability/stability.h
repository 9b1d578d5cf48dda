// Climbs ladders: at every rung, queries the engines, judges the answers, and repeats the queries in other
// forms: B moved by an ulp, A and B exchanged, other frames, another unit.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/math/rng.h"
#include "oracles/abi/engine.h"
#include "reports/record/stability.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// `ladder` is a ladder's name, or empty for all. Throws InputError when there is no such ladder.
Stability climb(const std::string& ladder, std::uint64_t seed, int per_rung,
                std::span<const EnginePtr> engines, const std::function<void(const std::string&)>& progress);

// The ladders of `touchstone stability` as data: one degeneracy per row, from harmless to severe.

struct LadderRow {
  const char *name, *line, *unit;
  std::vector<double> values;  // harmless first
  std::vector<Question> questions;
  Scene (*make)(Rng& rng, double value);
};

std::span<const LadderRow> ladders();

}  // namespace touchstone::fuzz
