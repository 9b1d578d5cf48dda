// The course of a scene, step by step, as a simulation or a robot's planner would report it to a world.
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
    std::vector<Move> moves;  // one for every body that is not static
    bool follows = false;     // starts where the previous step ended, so state kept from it is useful
  };
  std::string name;
  Scene scene;  // at the first step; its script is empty
  std::vector<Step> steps;
  bool moves() const;
};

/// An index of bodies, shapes or steps.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Windows of 8 consecutive steps, spread evenly over the recording, `steps` in total.
Course course_of(const RealScene& scene, int steps = 24);

/// The scene's script, one step per query; without a script, 8 steps in which every body continues its motion
/// or rests. Throws InputError when the script removes a body, or inserts one after its first query.
Course course_of(const Scene& scene);

}  // namespace touchstone::fuzz
