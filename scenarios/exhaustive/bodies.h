// Cases about bodies: the campaign's families that query candidate pairs, and bodies that move within a step.
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

/// Two bodies. About half of the pairs meet, mostly not at the start poses.
/// Translation only, along one world axis or in any direction; turning only; both; and motion so fast or from
/// so far away that a box that ignores any part of it is far off.
void drifting_on_an_axis(const Draw&, std::uint64_t index, Case& out);
void drifting(const Draw&, std::uint64_t index, Case& out);
void turning_in_place(const Draw&, std::uint64_t index, Case& out);
void turning_pairs(const Draw&, std::uint64_t index, Case& out);
void fast_and_far(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
