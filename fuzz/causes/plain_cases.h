// Cases that anyone would write by hand, the plainest first: two spheres or cubes of half extent 1 on the x
// axis, and what differs from that in one respect; the same with the kinds of shapes of a case. A fault that
// the first one shows needs nothing else.
#pragma once

#include <optional>
#include <vector>

#include "fuzz/causes/interventions/true_pair.h"
#include "fuzz/shrink/shrink.h"
#include "oracles/abi/engine.h"
#include "reports/record/result.h"
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

// The plainest pair that shows a fault: reduced cases of one fault still differ by chance, and then respond
// differently (Groce, Holmes and Kellar 2017, "One test to rule them all", on normalizing test cases).

/// The first of the plain cases (plain_cases.h) that shows the fault; if none does, the case with single
/// bodies and motions made plain where they can be. A case with more than two bodies or a script is returned
/// unchanged.
enum class PlainForms { nearest, all };
/// With `nearest`, only pairs at rest with about the gap of the case: responses of a fault then still vary as
/// its cases do, by which causes of engines with routes are told apart.
Case normal_form(const Case& c, const StillShows& still, PlainForms forms = PlainForms::all);

// A contradiction is evidence of the fault that explains it: of two answers that cannot both be right, one is
// wrong, and the referee may say which.

struct PlainForm {
  Case c;
  Finding finding;  // of the engine's answer to it
};

/// The case itself, or the first form that a relation derives from it, in which the referee finds the engine
/// wrong; of several faults there, one about `question` first, then the earliest stage. Empty when it finds
/// none: only the comparison shows that an answer is wrong.
std::optional<PlainForm> plain_form(const Case& c, Question question, const EnginePtr& engine);

}  // namespace touchstone::fuzz
