// The pair that a case is about, as the referee sees it, and moves of its second body along the true normal.
#pragma once

#include <optional>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct TruePair {
  int a = 0, b = 1;
  double gap = 0;              // signed: > 0 distance, < 0 minus the depth
  Vec3 normal = Vec3::Zero();  // A to B
  double size = 0;             // the bounding radius of the smaller body that has one
};

/// The pair of the first question, or the two bodies of a scene that has no others.
std::optional<BodyPair> pair_of(const Case& c);

/// The pair where the bodies are at the end of the script. Empty when there is none, the referee cannot
/// decide, or its gap has no value.
std::optional<TruePair> true_pair(const Case& c);

/// B moved along the normal, in every pose that it takes.
Case moved_along(const Case& c, const TruePair& p, double by);

/// B moved along the normal until the gap is the given one, up to rounding. Where bodies are to be deeper
/// than they are, another direction may become the one of least depth: the overlap is then less deep.
std::optional<Case> with_gap(const Case& c, double gap);

}  // namespace touchstone::fuzz
