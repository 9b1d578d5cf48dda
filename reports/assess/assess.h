// Asks engines about the pairs that matter of a robot: those that are not filtered and near each other in
// some configuration; the judge rules on the answers.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "oracles/abi/engine.h"
#include "reports/assess/asked_pairs.h"
#include "reports/record/assessment.h"
#include "scenarios/import/model/import.h"

namespace touchstone::fuzz {

/// How near pairs are that are asked unless the user says otherwise, in metres: about the padding that
/// planners of motions put around links at most.
inline constexpr double usual_near = 0.05;
/// The error of a distance that is accepted unless the user says otherwise, in metres: about how well arms
/// repeat a position.
inline constexpr double usual_accepted_error = 1e-4;

struct AssessOptions {
  std::uint64_t seed = 1;
  std::uint64_t samples = 200;          // configurations drawn, unless there is a trajectory
  std::uint64_t most_pairs = 4000;      // of all near pairs, evenly spread, are asked
  double near = usual_near;             // in the scene's unit
  double error = usual_accepted_error;  // of a distance, for the advice
  int jobs = 1;
};

/// Overlap, distance and contact of one pair of a scene, as assess asks them.
Case case_of_pair(const Scene& scene, const AskedPair& p);

/// Those that assess asks about: the rows of a trajectory, or those drawn.
std::vector<Configuration> asked_configurations(const ImportedModel& robot, const AssessOptions& options);

using EnginesOfJob = std::function<std::vector<EnginePtr>()>;
/// `what`: "configurations" while near pairs are looked for, then "pairs".
using AssessProgress = std::function<void(std::string_view what, std::uint64_t done, std::uint64_t of)>;

/// `robot.configurations` are asked as they are if there are several, else `samples` are drawn. Stops early
/// when `stop` is set. The result does not depend on the number of jobs, times aside. Throws what an engine
/// or a job throws.
Assessment assess(const ImportedModel& robot, const AssessOptions& options, const EnginesOfJob& engines,
                  const AssessProgress& progress, const std::atomic<bool>& stop);

}  // namespace touchstone::fuzz
