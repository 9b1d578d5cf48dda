// Measures the speed and accuracy of every engine on the chart's cases, in interleaved rounds.
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
  std::vector<std::uint64_t> crowds;  // numbers of bodies
};
ChartScope quick_chart();
ChartScope full_chart();

/// Receives a description of what is being measured.
using ChartProgress = std::function<void(const std::string&)>;

/// `engines` answer questions about pairs and motions, `broad` about candidate pairs.
Chart measure_chart(const ChartScope& scope, std::uint64_t seed, std::span<const EnginePtr> engines,
                    std::span<const EnginePtr> broad, const ChartProgress& progress);

Machine this_machine();

}  // namespace touchstone::fuzz
