// Cases about bodies: the campaign's families that end in candidate pairs, and bodies that move within a
// step.
#pragma once

#include "fuzz/certify/evidence.h"

namespace touchstone::fuzz {

void family_tiles(const Draw&, std::uint64_t index, Case& out);
void family_errands(const Draw&, std::uint64_t index, Case& out);
void family_script(const Draw&, std::uint64_t index, Case& out);
void family_throng(const Draw&, std::uint64_t index, Case& out);
void family_crowd(const Draw&, std::uint64_t index, Case& out);

/// Bodies on and in a half-space.
void grounded(const Draw&, std::uint64_t index, Case& out);

/// A slender body that turns by up to two turns and moves, and a small one that it may sweep over.
void turning_pairs(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
