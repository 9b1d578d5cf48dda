// What a plan chooses from, measured on the scene's own course.
#pragma once

#include <functional>
#include <vector>

#include "core/world/step_world.h"
#include "reports/plan/course.h"
#include "reports/record/plan.h"

namespace touchstone::fuzz {

/// Where every body is at the end of every step: steps × bodies.
using EndPoses = std::vector<std::vector<Pose>>;
EndPoses end_poses(const Course& course);

struct Occurrence {
  int step = 0, a = 0, b = 0;  // a < b
};
/// The candidate pairs of every step, by broad-phase boxes of the bodies as they are.
std::vector<std::vector<BodyPair>> course_candidates(const Course& course, const EndPoses& poses);

/// Every broad phase of the core: boxes of the moving bodies in, pairs out; quickest first.
std::vector<PlanPhase> measure_phases(const Course& course, const EndPoses& poses, int rounds);

/// Sets `fidelity.method` of each pair of kinds that occurs to the quickest on a sample of its candidates,
/// and says what was measured; the pairs that take most time first.
std::vector<PlanPair> choose_methods(const Course& course, const EndPoses& poses,
                                     const std::vector<std::vector<BodyPair>>& candidates, std::uint64_t seed,
                                     int rounds, Fidelity& fidelity);

/// One way to run a course.
struct Way {
  std::string name;
  Fidelity fidelity;
  bool is_plan = false;
  std::vector<PlanPair> pairs;  // of a plan: what its methods were measured to be
};

/// Runs the course once; ns of a step on average, of those that follow another one where there are such.
/// `each`, when given, sees every report.
double run_course(const Course& course, const Fidelity& fidelity,
                  const std::function<void(int step, const StepReport&)>& each = {});

}  // namespace touchstone::fuzz
