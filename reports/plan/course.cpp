#include "reports/plan/course.h"

#include <algorithm>
#include <string>

#include "core/base/input_error.h"

namespace touchstone::fuzz {
namespace {

constexpr int window = 8;

Course::Step step_of(const Scene& s) {
  Course::Step step;
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (!s.bodies[i].is_static)
      step.moves.push_back({static_cast<int>(i), s.bodies[i].pose, s.bodies[i].motion.value_or(Motion{})});
  return step;
}

bool is_whole_window(const RealScene& s, int first) {
  for (int f = first; f + 1 < first + window; ++f)
    if (!s.is_followed(f)) return false;
  return true;
}

Course along_motions(const Scene& scene) {
  Course c{scene.name, scene, {}};
  for (int i = 0; i < window; ++i) {
    Course::Step step = step_of(scene);
    for (Course::Move& m : step.moves) m.start = pose_at(m.start, m.motion, i);
    step.follows = i > 0;
    c.steps.push_back(std::move(step));
  }
  return c;
}

// Limits coordinates, so that boxes around moving bodies and their differences stay finite.
Course check_coordinates(Course c) {
  constexpr double max_coordinate = 1e300;  // in the scene's unit; the largest double is 1.8e308
  for (const Course::Step& step : c.steps)
    for (const Course::Move& m : step.moves) {
      const Vec3 end = m.start.translation + m.motion.linear;
      const double largest = std::max(m.start.translation.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff());
      if (!(largest <= max_coordinate && m.motion.angular.allFinite()))
        throw InputError("bodies[" + std::to_string(m.body) + "]", "moves to coordinates beyond 1e300");
    }
  return c;
}

}  // namespace

bool Course::moves() const {
  return std::any_of(steps.begin(), steps.end(), [](const Step& s) {
    return std::any_of(s.moves.begin(), s.moves.end(), [](const Move& m) { return m.motion != Motion{}; });
  });
}

Course course_of(const RealScene& real, int steps) {
  std::vector<int> starts;
  for (int f = 0; f + window <= real.frame_count(); ++f)
    if (is_whole_window(real, f)) starts.push_back(f);
  std::vector<int> frames;
  const int windows = std::max(1, steps / window);
  for (int w = 0; w < windows && !starts.empty(); ++w) {
    const std::size_t pick =
        starts.size() == 1 ? 0 : at(w) * (starts.size() - 1) / at(std::max(1, windows - 1));
    for (int f = starts[pick]; f < starts[pick] + window; ++f)
      if (frames.empty() || f > frames.back()) frames.push_back(f);
  }
  if (frames.empty())
    for (int f = 0; f < std::min(steps, real.frame_count()); ++f) frames.push_back(f);
  if (frames.empty()) throw InputError(real.name, "has no frames");
  Course c{real.name, real.frame(frames.front()), {}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Course::Step step = step_of(real.frame_with_motion(frames[i]));
    step.follows = i > 0 && frames[i] == frames[i - 1] + 1 && real.is_followed(frames[i - 1]);
    c.steps.push_back(std::move(step));
  }
  return check_coordinates(std::move(c));
}

Course course_of(const Scene& scene) {
  Scene s = scene;
  s.script.clear();
  if (scene.script.empty()) return check_coordinates(along_motions(s));
  Course c{scene.name, s, {}};
  std::vector<char> present(scene.bodies.size(), 0);
  bool asked = false;
  for (std::size_t i = 0; i < scene.script.size(); ++i) {
    const touchstone::Step& step = scene.script[i];
    const std::string place = "script[" + std::to_string(i) + "]";
    if (step.op == touchstone::Step::Op::remove)
      throw InputError(place, "removes a body; a plan requires that all bodies stay");
    if (step.op == touchstone::Step::Op::insert && asked)
      throw InputError(place, "inserts a body after the first query; a plan requires that all bodies stay");
    if (step.op == touchstone::Step::Op::query) {
      c.steps.push_back(step_of(s));
      c.steps.back().follows = asked;
      if (!asked) c.scene.bodies = s.bodies;
      asked = true;
      continue;
    }
    present[at(step.body)] = 1;
    if (step.pose) s.bodies[at(step.body)].pose = *step.pose;
  }
  const auto absent = std::find(present.begin(), present.end(), 0);
  if (absent != present.end())
    throw InputError("script", "never inserts body " + std::to_string(absent - present.begin()));
  if (!asked) throw InputError("script", "has no query");
  return check_coordinates(std::move(c));
}

}  // namespace touchstone::fuzz
