// A pair's certified answer, and the ruling on somebody's own, as text in 80 columns.
#pragma once

#include <string>

#include "fuzz/answer/pair_answer.h"
#include "scenarios/value/judgement.h"

namespace touchstone::cli {

std::string answer_text(const fuzz::PairAnswer& answer);
std::string answer_text(const fuzz::ImpactAnswer& answer);
/// "stated: right", or every fault with its reason.
std::string ruling_text(const Judgement& j);

}  // namespace touchstone::cli
