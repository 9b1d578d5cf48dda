// What simulators do instead of computing a time of impact, to be charted beside it. None is conservative,
// each says what it can miss. Questions and conventions as in impact.h, all of [0,1].
#pragma once

#include "core/impact/impact.h"

namespace touchstone {

/// Overlap at the end pose alone: toi = 1 when there is one. Misses every pass that begins and ends within
/// the step; what it does find is late by up to the whole step.
ImpactAnswer end_pose_impact(const MovingShape& a, const MovingShape& b);

/// Overlap at t = 0, 1/N, 2/N … 1: the first of them. Misses passes shorter than 1/N, late by up to 1/N.
/// invalid_input when N < 1.
ImpactAnswer substep_impact(const MovingShape& a, const MovingShape& b, int substeps);

/// Speculative contact: the gap g and the witness points at t = 0; when g is at most `margin` times the
/// farthest that the two can approach in the step (|v_a − v_b| + R_a·|ω_a| + R_b·|ω_b|), contact is foreseen
/// at g divided by the speed at which the witness points, moving on as they do at t = 0, close the gap along
/// its normal. Not foreseen when that is later than 1. Misses what another pair of points hits, foresees
/// contact where the bodies pass each other (a ghost), early or late where they turn.
ImpactAnswer speculative_impact(const MovingShape& a, const MovingShape& b, double margin);

}  // namespace touchstone
