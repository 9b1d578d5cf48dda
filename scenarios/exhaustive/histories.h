// Every sequence of insert, move, remove and query of a given length over a few places on a line: state that
// a broad phase keeps wrongly after one operation shows after another.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/exhaustive/evidence.h"

namespace touchstone::fuzz {

/// Sequences of exactly `length` operations; those that end in queries include the shorter ones. Bodies are
/// first inserted in the order of their indices. An operation is body·(places + 1) + (place, or `places` for
/// remove); a query is bodies·(places + 1).
const std::vector<std::string>& histories(int bodies, int places, int length);

std::uint64_t count_histories_of_two(const Draw&);
std::uint64_t count_histories_of_three(const Draw&);
void histories_of_two(const Draw&, std::uint64_t index, Case& out);
void histories_of_three(const Draw&, std::uint64_t index, Case& out);

}  // namespace touchstone::fuzz
