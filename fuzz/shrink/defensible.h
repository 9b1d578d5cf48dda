// Whether a case would convince the maintainer of an engine: nothing in it is flat, close or extreme, so that
// a wrong answer cannot be put down to the input.
#pragma once

#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// The share of the smaller body's size (its largest full extent) by which bodies are clearly apart or
/// clearly overlap.
inline constexpr double clear_share = 0.01;
/// Numbers that are not zero have a magnitude between these.
inline constexpr double least_plain_number = 0x1p-10, largest_plain_number = 0x1p10;

/// Whether the numbers are plain, the bodies asked about have volume (degeneracy.h) and every triangle of a
/// mesh has area, and each pair of them certainly overlaps or is apart by more than clear_share. A time of
/// impact also needs bodies that are apart at the start and either meet within (0.01, 0.99) and then overlap
/// as much, or stay as far apart. Questions about a scene are about every pair; false when that is too many
/// to examine.
bool is_defensible(const Case& c);

/// A part of it: plain numbers and volume. Bodies may touch, or be as close as they like: all that can be
/// asked of a case that shows how touching is treated.
bool is_solid(const Case& c);

/// The size that clear_share refers to; 0 when neither body has one (half-spaces).
double smaller_size(const Scene& scene, int a, int b);

/// The case itself, then changed ones, smallest change first: with plain numbers and volume, B moved so that
/// the pair clearly overlaps or is clearly apart, an approach that meets within the step, all shapes a little
/// larger or smaller. Only valid scenes; up to about a hundred. Whether they are defensible is not examined.
std::vector<Case> defensible_forms(const Case& c);

}  // namespace touchstone::fuzz
