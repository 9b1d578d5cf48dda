// Lies that no answer tells apart: what bounds the score of any grouping by answers.
#pragma once

#include <map>
#include <string>

#include "fuzz/causes/engine_pool.h"
#include "reports/record/causes.h"
#include "reports/record/result.h"

namespace touchstone::mutants {

/// For each lying engine that has findings, the first of those that answer like it. Only engines with
/// findings in one cause are compared: two are equal if both answer alike to the first case of each of their
/// findings there and to all changed forms of it (fuzz/causes/intervention.h), asked afresh.
std::map<std::string, std::string> equal_lies(const fuzz::Causes& causes, const fuzz::CampaignResult& result,
                                              const fuzz::MakeEngine& make);

}  // namespace touchstone::mutants
