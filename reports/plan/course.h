// What happens in a scene, step by step, as a simulation or a robot's planner would tell it to a world.
#pragma once

#include <string>
#include <vector>

#include "scenarios/import/real_scene.h"

namespace touchstone::fuzz {

struct Course {
  struct Move {
    int body = 0;
    Pose start;
    Motion motion;  // over the step; a body rests when it is zero
  };
  struct Step {
    std::vector<Move> moves;  // of every body that is not static
    bool follows = false;     // begins where the one before has ended, so that what was kept of it is of use
  };
  std::string name;
  Scene scene;  // at the first step; its script is empty
  std::vector<Step> steps;
  bool moves() const;
};

/// An index of bodies, shapes or steps.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Windows of 8 steps that follow each other, spread evenly over the recording, `steps` in all.
Course course_of(const RealScene& scene, int steps = 24);

/// The scene's script, a step a query; without one 8 steps in which every body goes on as its motion says, or
/// rests. Throws InputError when the script removes a body, or inserts one after its first query.
Course course_of(const Scene& scene);

}  // namespace touchstone::fuzz
