// Endpoint orders. On an axis, n intervals are told apart, as far as a comparison can tell, by the order of
// their 2n ends with ties: 26 orders for two intervals, points included, and 818 for three. Boxes have one
// order an axis.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

/// Ranks of lo₀, hi₀, lo₁, hi₁, …: dense from 0, lo <= hi.
using AxisOrder = std::vector<int>;
const std::vector<AxisOrder>& axis_orders(int intervals);

/// Triples of orders of three intervals (indices into axis_orders(3)), one of each class under renaming of
/// boxes, exchange of axes and reflection of each axis; ten bits an index.
const std::vector<std::uint32_t>& triple_classes();

std::uint64_t count_orders_of_two(const Draw&);
std::uint64_t count_orders_on_an_axis(const Draw&);
std::uint64_t count_orders_of_three(const Draw&);
void orders_of_two(const Draw&, std::uint64_t index, Case& out);
void orders_on_an_axis(const Draw&, std::uint64_t index, Case& out);
void orders_of_three(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
