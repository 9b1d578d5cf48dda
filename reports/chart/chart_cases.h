// The cases of the chart: every pair of kinds × regime × scale for the narrow phase, pairs nearer and farther
// than a margin, rays, families of motions for impacts, crowds of growing size for broad phases. The same
// seed gives the same cases.
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

/// Cases for overlap, distance and contact, `per_cell` in each combination.
std::vector<ChartCase> narrow_chart_cases(std::uint64_t seed, int per_cell, bool meshes);
/// Cases for within and bounded_distance: margins above and below the gap, `per_cell` for each pair of kinds.
std::vector<ChartCase> margin_chart_cases(std::uint64_t seed, int per_cell, bool meshes);
std::vector<ChartCase> ray_chart_cases(std::uint64_t seed, int count);
/// Cases for time_of_impact, `per_regime` from each family of motions.
std::vector<ChartCase> impact_chart_cases(std::uint64_t seed, int per_regime);
/// A case for candidates: `bodies` bodies in a cube whose volume is proportional to their number.
ChartCase broad_chart_case(std::uint64_t seed, std::uint64_t bodies);

}  // namespace touchstone::fuzz
