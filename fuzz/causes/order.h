// The order in which to read causes.
#pragma once

#include <functional>
#include <vector>

#include "reports/record/causes.h"

namespace touchstone::fuzz {

/// The documented ones last; then by severity; of equal severity, most unlike first: after the most frequent,
/// always the one whose nearest predecessor of that severity is farthest (furthest point first; Chen et al.,
/// "Taming compiler fuzzers", PLDI 2013, §3). `distance` is between indices. Returns the indices in order.
std::vector<std::size_t> reading_order(const std::vector<Cause>& causes,
                                       const std::function<double(std::size_t, std::size_t)>& distance);

}  // namespace touchstone::fuzz
