// Forms in which a case of any family may be asked: the pair in the other order, the questions in another
// order, quaternions of any length, the case before once more with one body moved.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Whether a case is the one before it, moved; most are not.
bool is_sequel(Rng& rng);
/// The case before, as it is or with one body moved by 2^-30 to 1 of its size, or turned.
void move_a_body(Rng& rng, Case& c);

/// Each form with a chance of its own; most cases stay as they are.
void apply_forms(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
