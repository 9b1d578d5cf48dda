// A motion in frames: each query of a case's script is one. Its frames are cases of their own, judged like
// any other (docs/truth.md §7).
#pragma once

#include <array>
#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// One case for each query of the script: the bodies at their poses then, without a script, and the questions
/// about pairs of which both are present. The id is that of the motion, followed by @ and the number of the
/// frame, from 0.
std::vector<Case> frames_of(const Case& motion);

/// How a direction is carried from one frame to the next, and what that costs: if w is the width before and
/// w' after, |w'(turn n) - w(n)| <= change for every unit n.
struct Carried {
  Mat3 turn = Mat3::Identity();
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // a point p goes to turn (p - from) + to
  double change = 0;
  Vec3 point(const Vec3& p) const { return turn * (p - from) + to; }
  Vec3 earlier(const Vec3& p) const { return turn.transpose() * (p - to) + from; }
};
/// Seen from the world, from a, and from b.
std::array<Carried, 3> carried(const Scene& before, const Scene& after, int a, int b);

}  // namespace touchstone::fuzz
