// The cases kept as examples of a finding: a few of all that show it, chosen so that the choice depends only
// on which cases showed it.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "reports/record/observation_json.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct Example {
  std::uint64_t index = 0;  // of the case in its campaign
  double error_in_l = 0;
  CaseSize size;
  std::shared_ptr<const Case> c;  // shared by the findings of a case; null when read without it
};

inline constexpr std::size_t sampled_examples = 5;
inline constexpr std::size_t most_examples = sampled_examples + 3;

/// The first (lowest index), the worst (largest error), the simplest (smallest size), each with the lowest
/// index among equals, and a random sample: those with the smallest hashes of key and index. Sorted by index.
/// A case given twice counts once, with its larger error; an error that is NaN counts as infinite.
///
/// What is kept of A and of B suffices: kept(kept(A) ∪ kept(B)) = kept(A ∪ B). So the examples depend neither
/// on the order in which cases are judged nor on how they are divided among jobs and shards.
std::vector<Example> kept_examples(std::vector<Example> all, std::string_view key);

Json to_json(const Example& e);  // without the case

}  // namespace touchstone::fuzz
