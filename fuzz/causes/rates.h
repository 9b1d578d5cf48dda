// How frequent findings are among the answers that could show them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fuzz/causes/classes.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// How many answers the findings' engines gave to such questions about such shapes.
std::uint64_t asked_about(const CampaignResult& result, std::span<const Finding* const> findings);

/// Wrong answers of each class, divided by the answers to such questions.
std::vector<double> rates_of(const std::vector<FindingClass>& classes, const CampaignResult& result);

}  // namespace touchstone::fuzz
