// Boxes on which broad phases fail: cell borders, limits of the world, ends that differ in the last place,
// very different sizes, zeros of both signs, denormals, huge numbers, infinite boxes, invalid boxes.
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

/// 2 to 33 boxes with centres uniform in a cube with two units of volume per box and sides uniform in
/// [1/4, 7/4], all multiples of 2⁻¹⁰; one in five is fixed.
void uniform_boxes(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
