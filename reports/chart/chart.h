// Measures every engine against the referee on the chart's cases, in rounds that take turns.
#pragma once

#include <functional>
#include <span>

#include "oracles/abi/engine.h"
#include "reports/chart/chart_cases.h"
#include "reports/record/chart.h"

namespace touchstone::fuzz {

struct ChartScope {
  std::string name;
  int per_cell = 1, per_motion = 30, rounds = 3;
  bool meshes = false;
  std::vector<std::uint64_t> crowds;  // bodies
};
ChartScope quick_chart();
ChartScope full_chart();

/// What is under way, for people.
using ChartProgress = std::function<void(const std::string&)>;

/// `engines` are asked about pairs and motions, `broad` about candidate pairs.
Chart measure_chart(const ChartScope& scope, std::uint64_t seed, std::span<const EnginePtr> engines,
                    std::span<const EnginePtr> broad, const ChartProgress& progress);

}  // namespace touchstone::fuzz
