// What simulators do instead of computing a time of impact, for comparison charts. None of these is
// conservative; each states what it can miss. Definitions and conventions as in impact.h, over all of [0,1].
#pragma once

#include "core/impact/impact.h"

namespace touchstone {

/// Overlap at the end pose only: toi = 1 if there is one. Misses every pass that begins and ends within the
/// step; what it finds is late by up to the whole step.
ImpactAnswer end_pose_impact(const MovingShape& a, const MovingShape& b);

/// The first overlap at t = 0, 1/N, 2/N … 1. Misses passes shorter than 1/N; late by up to 1/N. invalid_input
/// when N < 1.
ImpactAnswer substep_impact(const MovingShape& a, const MovingShape& b, int substeps);

/// Speculative contact: takes the gap g and the witness points at t = 0. If g is at most `margin` times the
/// largest distance by which the two can approach in the step (|v_a − v_b| + R_a·|ω_a| + R_b·|ω_b|), contact
/// is predicted at g divided by the speed at which the witness points, moving on as at t = 0, close the gap
/// along its normal. No contact is predicted if that is later than 1. Misses contacts of other points,
/// predicts contact where the bodies pass each other (a ghost contact), and is early or late where they
/// rotate.
ImpactAnswer speculative_impact(const MovingShape& a, const MovingShape& b, double margin);

}  // namespace touchstone
