// Asks engines about the pairs that matter of a robot: those that are not filtered and near each other in
// some configuration; the judge rules on the answers.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "oracles/abi/engine.h"
#include "reports/record/assessment.h"
#include "scenarios/import/model/import.h"

namespace touchstone::fuzz {

/// How near pairs are that are asked unless the user says otherwise, in metres: about the padding that planners
/// of motions put around links at most.
inline constexpr double usual_near = 0.05;

struct AssessOptions {
  std::uint64_t seed = 1;
  std::uint64_t samples = 200;      // configurations drawn, unless there is a trajectory
  std::uint64_t most_pairs = 4000;  // of all near pairs, evenly spread, are asked
  double near = usual_near;         // in the scene's unit
  int jobs = 1;
};

/// Drawn uniformly within the limits of joints with one variable, or within half a turn each way for hinges
/// without limits; all other variables keep their values. Number i depends on the seed and i alone.
std::vector<Configuration> drawn_configurations(const Model& model, const Configuration& standard,
                                                std::uint64_t seed, std::uint64_t count);

/// The names of joints that drawn_configurations leaves as they are although they move.
std::vector<std::string> joints_not_drawn(const Model& model);

using EnginesOfJob = std::function<std::vector<EnginePtr>()>;
using AssessProgress = std::function<void(std::uint64_t asked, std::uint64_t of)>;

/// `robot.configurations` are asked as they are if there are several, else `samples` are drawn. Stops early
/// when `stop` is set. The result does not depend on the number of jobs, times aside. Throws what an engine
/// or a job throws.
Assessment assess(const ImportedModel& robot, const AssessOptions& options, const EnginesOfJob& engines,
                  const AssessProgress& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
