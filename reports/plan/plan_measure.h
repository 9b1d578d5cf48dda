// Measures the choices for a plan on the scene's own course.
#pragma once

#include <functional>
#include <vector>

#include "core/world/step_world.h"
#include "reports/plan/course.h"
#include "reports/record/plan.h"

namespace touchstone::fuzz {

/// The pose of every body at the end of every step: steps × bodies.
using EndPoses = std::vector<std::vector<Pose>>;
EndPoses end_poses(const Course& course);

struct Occurrence {
  int step = 0, a = 0, b = 0;  // a < b
};
/// The candidate pairs of every step, from the broad-phase boxes of the bodies without simpler shapes, with
/// half of the margin around them.
std::vector<std::vector<BodyPair>> course_candidates(const Course& course, const EndPoses& poses,
                                                     double margin = 0);

/// Measures every broad phase of the core (boxes of the moving bodies in, pairs out); fastest first.
std::vector<PlanPhase> measure_phases(const Course& course, const EndPoses& poses, int rounds,
                                      double margin = 0);

/// Sets `fidelity.method` of each pair of kinds that occurs to the fastest on a sample of its candidates.
/// Returns the measurements, most expensive pairs first.
std::vector<PlanPair> choose_methods(const Course& course, const EndPoses& poses,
                                     const std::vector<std::vector<BodyPair>>& candidates, std::uint64_t seed,
                                     int rounds, Fidelity& fidelity);

/// One way to run a course.
struct Way {
  std::string name;
  Fidelity fidelity;
  bool is_plan = false;
  std::vector<PlanPair> pairs;  // for a plan: the measurements of its methods
};

/// Runs the course once. Returns the average ns per step, over the steps that follow another one if there are
/// any. `each`, if given, receives every report.
double run_course(const Course& course, const Fidelity& fidelity,
                  const std::function<void(int step, const StepReport&)>& each = {});

}  // namespace touchstone::fuzz
