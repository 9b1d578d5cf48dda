// Boxes at which broad phases break: borders of cells, limits of the world, ends that differ by the last
// place, sizes far apart, zeros of both signs, denormals, huge numbers, infinite boxes, boxes that are none.
#pragma once

#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

void cell_borders(const Draw&, std::uint64_t index, Case& out);
void touching_by_an_ulp(const Draw&, std::uint64_t index, Case& out);
void sizes_far_apart(const Draw&, std::uint64_t index, Case& out);
void zeros_and_denormals(const Draw&, std::uint64_t index, Case& out);
void far_from_the_origin(const Draw&, std::uint64_t index, Case& out);
void huge_coordinates(const Draw&, std::uint64_t index, Case& out);
void unbounded(const Draw&, std::uint64_t index, Case& out);
void no_boxes(const Draw&, std::uint64_t index, Case& out);

// Scripts and crowds.
void long_scripts(const Draw&, std::uint64_t index, Case& out);
void longest_script(const Draw&, std::uint64_t index, Case& out);
void moving_crowds(const Draw&, std::uint64_t index, Case& out);

/// 2 to 33 boxes with centres uniform in a cube of two units of volume a box and sides uniform in
/// [1/4, 7/4], all multiples of 2⁻¹⁰; one in five is fixed.
void uniform_boxes(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
