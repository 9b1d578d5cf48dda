// The cases of the chart: every pair of kinds × regime × scale for the narrow phase, families of motions for
// impacts, growing crowds for broad phases. Same seed, same cases.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct ChartCase {
  Case c;
  std::string regime, pair, scale;
  std::uint64_t bodies = 0;
};

/// overlap, distance and contact; `per_cell` cases each.
std::vector<ChartCase> narrow_chart_cases(std::uint64_t seed, int per_cell, bool meshes);
/// time_of_impact, `per_regime` cases of each family of motions.
std::vector<ChartCase> impact_chart_cases(std::uint64_t seed, int per_regime);
/// candidates of `bodies` bodies in a cube that grows with them.
ChartCase broad_chart_case(std::uint64_t seed, std::uint64_t bodies);

}  // namespace touchstone::fuzz
