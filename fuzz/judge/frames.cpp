#include "fuzz/judge/frames.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

/// Relative rounding of a bound of motion: of poses, products of two rotations and their differences, some
/// forty roundings. Scales with the coordinates and sizes. Tested by: tests/fuzz "a bound of the motion holds
/// for widths in every direction".
constexpr double motion_rounding = 0x1p-46;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct RigidPose {
  Mat3 rotation;
  Vec3 position;
};
RigidPose pose_of(const Scene& s, int body) {
  const Pose& p = s.bodies[at(body)].pose;
  return {rotation_matrix(p.rotation), p.translation};
}
RigidPose seen_from(const RigidPose& frame, const RigidPose& p) {
  return {frame.rotation.transpose() * p.rotation,
          frame.rotation.transpose() * (p.position - frame.position)};
}

// An upper bound of how far any point of the body moves. A point x of the body, |x| <= reach, goes from
// R x + p to R' x + p', and |(R' - R) x| <= 2 sin(θ/2) |x|, where θ is the angle between R and R'. The
// difference of two rotations has the singular values 2 sin(θ/2), 2 sin(θ/2) and 0.
double most_moved(const RigidPose& before, const RigidPose& after, double reach) {
  const double shift = (after.position - before.position).norm();
  const double turn = (after.rotation - before.rotation).norm() / std::numbers::sqrt2;
  return shift + (turn > 0 ? turn * reach : 0);
}

}  // namespace

std::vector<Case> frames_of(const Case& motion) {
  std::vector<Case> frames;
  Truth of_motion(motion.scene);
  for (const Truth::StepState& state : of_motion.steps()) {
    Case c;
    c.id = fmt::format("{}@{}", motion.id, frames.size());
    c.family = motion.family;
    c.scene = motion.scene;
    c.scene.script.clear();
    for (std::size_t i = 0; i < state.pose.size(); ++i) {
      c.scene.bodies[i].motion.reset();
      if (state.pose[i]) c.scene.bodies[i].pose = *state.pose[i];
    }
    for (const Query& q : motion.queries)
      if (is_pair_question(q.question) && !is_motion_question(q.question) && state.pose[at(q.a)] &&
          state.pose[at(q.b)])
        c.queries.push_back(q);
    frames.push_back(std::move(c));
  }
  return frames;
}

std::array<Carried, 3> carried(const Scene& before, const Scene& after, int a, int b) {
  const RigidPose a0 = pose_of(before, a), a1 = pose_of(after, a);
  const RigidPose b0 = pose_of(before, b), b1 = pose_of(after, b);
  const double ra = bounding_radius(before.shape_of(a)), rb = bounding_radius(before.shape_of(b));
  double rounding = a0.position.norm() + a1.position.norm() + b0.position.norm() + b1.position.norm();
  for (const double r : {ra, rb}) rounding += std::isfinite(r) ? r : 0;
  rounding *= motion_rounding;
  std::array<Carried, 3> ways;
  ways[0].change = most_moved(a0, a1, ra) + most_moved(b0, b1, rb) + rounding;
  ways[1] = {a1.rotation * a0.rotation.transpose(), a0.position, a1.position,
             most_moved(seen_from(a0, b0), seen_from(a1, b1), rb) + rounding};
  ways[2] = {b1.rotation * b0.rotation.transpose(), b0.position, b1.position,
             most_moved(seen_from(b0, a0), seen_from(b1, a1), ra) + rounding};
  return ways;
}

}  // namespace touchstone::fuzz
