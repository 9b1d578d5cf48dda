// The candidate pairs that an engine reports for one query, compared with those that must be reported. Every
// pair that must be reported is, with no tolerance (truth.md §3); a pair that names an absent body is stale.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "scenarios/value/candidate_pairs.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

struct CandidateComparison {
  std::vector<BodyPair> reported;   // sorted_unique
  std::uint64_t duplicates = 0;     // reported more than once
  std::vector<std::size_t> missed;  // positions in `required`
  std::vector<BodyPair> stale;      // name an absent body, or one body twice
};

/// `pair_of` maps an element of `required` to its pair (a < b); `is_present(i)` is called for bodies of the
/// scene only, which has `bodies` of them.
template <class Required, class PairOf, class IsPresent>
CandidateComparison compare_candidates(const Observation& answer, std::size_t query, int bodies,
                                       const std::vector<Required>& required, PairOf pair_of,
                                       IsPresent is_present) {
  CandidateComparison r;
  if (query < answer.candidate_pairs.size()) {
    r.reported = sorted_unique(answer.candidate_pairs[query]);
    r.duplicates = answer.candidate_pairs[query].size() - r.reported.size();
  }
  for (std::size_t i = 0; i < required.size(); ++i)
    if (!std::binary_search(r.reported.begin(), r.reported.end(), std::invoke(pair_of, required[i])))
      r.missed.push_back(i);
  const auto absent = [&](int i) { return i < 0 || i >= bodies || !is_present(i); };
  for (const BodyPair& p : r.reported)
    if (p.first == p.second || absent(p.first) || absent(p.second)) r.stale.push_back(p);
  return r;
}

}  // namespace touchstone::fuzz
