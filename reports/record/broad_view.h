// Records how broad phases process a script; reports/web/src/broad draws it.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/math/aabb.h"
#include "core/scene/scene.h"

namespace touchstone::fuzz {

struct BroadView {
  struct Grid {
    int along = 0;  // axis of the columns
    std::array<double, 3> origin{}, cell{};
    std::array<long, 3> count{};  // of cells; border cells extend to infinity
  };
  /// One method's structure at one query.
  struct Look {
    std::string explanation;
    int sweep_axis = -1;  // axis 0–2, or -1
    std::vector<Grid> grids;
    std::vector<std::vector<Aabb>> nodes;  // trees only: by level, lowest first
    /// Number of pairs that the structure brings together, and the first few whose boxes do not overlap.
    long considered = 0;
    std::vector<BodyPair> pruned;
  };
  /// One query of the script.
  struct Frame {
    std::vector<std::optional<Aabb>> boxes;  // by body; empty when absent
    std::vector<BodyPair> kept;              // reported by every method, sorted
    long all_pairs = 0;                      // exact tests needed without a broad phase
    std::array<long, 3> overlap_on_axis{};   // pairs whose intervals overlap on x, y, z
    std::vector<Look> looks;                 // by method
  };
  std::string name;
  std::vector<std::string> bodies;
  std::vector<bool> fixed;
  std::vector<std::string> methods;
  std::vector<Frame> frames;
};

/// An infinite bound becomes null.
nlohmann::json to_json(const BroadView& view);

}  // namespace touchstone::fuzz
