// Which configurations of a robot are tried, and which pairs of bodies are asked about in them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenarios/import/model/model.h"

namespace touchstone::fuzz {

/// Drawn uniformly within the limits of joints with one variable, or within half a turn each way for hinges
/// without limits; all other variables keep their values. Number i depends on the seed and i alone.
std::vector<Configuration> drawn_configurations(const Model& model, const Configuration& standard,
                                                std::uint64_t seed, std::uint64_t count);

/// The names of joints that drawn_configurations leaves as they are although they move.
std::vector<std::string> joints_not_drawn(const Model& model);

struct AskedPair {
  std::uint64_t configuration = 0;
  int a = 0, b = 0;
};

using PairProgress = std::function<void(std::uint64_t done, std::uint64_t of)>;

/// The pairs that are not filtered and whose boxes are at most `near` apart along every axis, in the order of
/// configurations. `scene` is that of the model. Ends early when `stop` is set.
std::vector<AskedPair> near_pairs(const Model& model, Scene scene, const std::vector<Configuration>& all,
                                  double near, const PairProgress& progress, const std::atomic<bool>& stop);

/// At most `most` of them, evenly spread.
std::vector<AskedPair> thinned(const std::vector<AskedPair>& all, std::uint64_t most);

/// The number of pairs of one configuration that are not filtered.
std::uint64_t possible_pairs(const Scene& s);

}  // namespace touchstone::fuzz
