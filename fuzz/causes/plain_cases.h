// Cases that anyone would write by hand, the plainest first: two spheres or cubes of half extent 1 on the x
// axis, and what differs from that in one respect; the same with the kinds of shapes of a case. A fault that
// the first one shows needs nothing else.
#pragma once

#include <vector>

#include "fuzz/causes/interventions/true_pair.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// At rest: side by side, apart or overlapping as the pair is, by plain shares of the size, the largest
/// first, then by about the share that the pair has; then in other directions and places, of two sizes,
/// turned, one in the other.
std::vector<Case> plain_pairs(const Case& c, const TruePair& p);

/// Of these, those side by side with about the share that the pair has.
std::vector<Case> nearest_plain_pairs(const Case& c, const TruePair& p);

/// In motion, the plainest first: head on, then one of them turning, past each other, fast, slow, touching at
/// the start or at the end.
std::vector<Case> plain_impacts(const Case& c, const BodyPair& p);

/// Whole scenes, with the queries and the margin of the case: a row of cubes or spheres that touch, and what
/// differs from that in one respect. With `moving`, the second body reaches the first during the step;
/// otherwise nothing moves. Scripts are made for questions that run them.
std::vector<Case> plain_scenes(const Case& c, bool moving);

}  // namespace touchstone::fuzz
