// The cases of the suites that evidence.cpp lists: boxes first, then bodies.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

// Endpoint orders. On one axis, comparisons can distinguish n intervals only by the order of their 2n ends,
// ties included: 26 orders for two intervals (points included), 818 for three. Boxes have one order per axis.

/// Ranks of lo₀, hi₀, lo₁, hi₁, …: dense from 0, lo <= hi.
using AxisOrder = std::vector<int>;
const std::vector<AxisOrder>& axis_orders(int intervals);

/// Triples of orders of three intervals (indices into axis_orders(3)), one for each class under renaming of
/// boxes, exchange of axes and reflection of each axis; ten bits per index.
const std::vector<std::uint32_t>& triple_classes();

std::uint64_t count_orders_of_two(const Draw&);
std::uint64_t count_orders_on_an_axis(const Draw&);
std::uint64_t count_orders_of_three(const Draw&);
void orders_of_two(const Draw&, std::uint64_t index, Case& out);
void orders_on_an_axis(const Draw&, std::uint64_t index, Case& out);
void orders_of_three(const Draw&, std::uint64_t index, Case& out);

// Every sequence of insert, move, remove and query of a given length over a few places on a line: state that
// a broad phase keeps wrongly after one operation shows after another.

/// Sequences of exactly `length` operations; those that end in queries include the shorter ones. Bodies are
/// first inserted in the order of their indices. An operation is body·(places + 1) + (place, or `places` for
/// remove); a query is bodies·(places + 1).
const std::vector<std::string>& histories(int bodies, int places, int length);

std::uint64_t count_histories_of_two(const Draw&);
std::uint64_t count_histories_of_three(const Draw&);
void histories_of_two(const Draw&, std::uint64_t index, Case& out);
void histories_of_three(const Draw&, std::uint64_t index, Case& out);

// Boxes on which broad phases fail: cell borders, limits of the world, ends that differ in the last place,
// very different sizes, zeros of both signs, denormals, huge numbers, infinite boxes, invalid boxes.

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

// Cases about bodies: the campaign's families that query candidate pairs, and bodies that move within a step.

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
