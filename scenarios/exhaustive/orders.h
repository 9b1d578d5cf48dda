// Endpoint orders. On one axis, comparisons can distinguish n intervals only by the order of their 2n ends,
// ties included: 26 orders for two intervals (points included), 818 for three. Boxes have one order per axis.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

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

}  // namespace touchstone::fuzz
