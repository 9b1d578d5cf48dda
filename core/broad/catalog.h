// Every broad phase of the core by name. To add an algorithm, add a file and a row.
#pragma once

#include <array>
#include <string_view>

#include "core/broad/automatic.h"
#include "core/broad/bounding_volume_hierarchy.h"
#include "core/broad/brute_force.h"
#include "core/broad/grid.h"
#include "core/broad/incremental_sweep.h"
#include "core/broad/neighbour_list.h"
#include "core/broad/sort_and_sweep.h"

namespace touchstone::broad {

struct CatalogRow {
  std::string_view name;
  BroadPhasePtr (*make_with)(const Options& options);
  /// Throws std::invalid_argument when options.threads < 1.
  BroadPhasePtr make(const Options& options = {}) const { return make_with(options); }
};

inline constexpr auto catalog = std::to_array<CatalogRow>({
    {"automatic", &make_automatic},
    {"brute_force", &make_brute_force},
    {"sort_and_sweep", &make_sort_and_sweep},
    {"incremental_sweep", &make_incremental_sweep},
    {"grid", &make_grid},
    {"hierarchical_grid", &make_hierarchical_grid},
    {"neighbour_list", &make_neighbour_list},
    {"bounding_volume_hierarchy", &make_bounding_volume_hierarchy},
});

/// Null when the name is unknown.
inline BroadPhasePtr make_broad_phase(std::string_view name, const Options& options = {}) {
  for (const CatalogRow& row : catalog)
    if (row.name == name) return row.make(options);
  return nullptr;
}

}  // namespace touchstone::broad
