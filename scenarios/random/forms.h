// Variants in which a case of any family may be presented: the pair swapped, the queries reordered,
// quaternions of any length, the previous case again with one body moved.
#pragma once

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Whether a case is a modified copy of the previous one; most are not.
bool is_sequel(Rng& rng);
/// Turns the previous case into a new one: unchanged, or with one body moved by 2^-30 to 1 of its size, or
/// turned.
void move_a_body(Rng& rng, Case& c);

/// Applies each variant with its own probability; most cases stay unchanged.
void apply_forms(Rng& rng, Case& c);

}  // namespace touchstone::fuzz
