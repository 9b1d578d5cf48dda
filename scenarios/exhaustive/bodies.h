// Cases about bodies: the campaign's families that end in candidate pairs, and bodies that move within a
// step.
#pragma once

#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

void family_tiles(const Draw&, std::uint64_t index, Case& out);
void family_errands(const Draw&, std::uint64_t index, Case& out);
void family_script(const Draw&, std::uint64_t index, Case& out);
void family_throng(const Draw&, std::uint64_t index, Case& out);
void family_crowd(const Draw&, std::uint64_t index, Case& out);

/// Bodies on and in a half-space.
void grounded(const Draw&, std::uint64_t index, Case& out);

/// Two bodies, of which about half meet, mostly not where they stand at the start.
/// Translation alone, along one axis of the world and any way; turning alone; both; and so fast or far away
/// that a box without any part of the motion is far off.
void drifting_on_an_axis(const Draw&, std::uint64_t index, Case& out);
void drifting(const Draw&, std::uint64_t index, Case& out);
void turning_in_place(const Draw&, std::uint64_t index, Case& out);
void turning_pairs(const Draw&, std::uint64_t index, Case& out);
void fast_and_far(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
