// Motions whose time of impact is decided by small differences: overlapping or touching at the start, passing
// each other with a common tangent plane, going through a thin plate within a fraction of the step.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

void start_in_contact(Rng& rng, Case& c);
void graze(Rng& rng, Case& c);
void bullet(Rng& rng, Case& c);

void last_moment(Rng& rng, Case& c);
void whirl(Rng& rng, Case& c);
void swarm(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
