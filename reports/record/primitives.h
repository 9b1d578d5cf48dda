// Answers about deforming primitives, counted: what `touchstone primitives` found.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "reports/record/observation_json.h"
#include "reports/record/result.h"

namespace touchstone::fuzz {

/// Queries of one kind from one source.
struct PrimitiveTally {
  std::uint64_t queries = 0, hits = 0;           // hits: the primitives meet within the step
  std::uint64_t missed = 0, ghost = 0, late = 0;  // false negative; false positive; after the first contact
  std::uint64_t failed = 0;                      // no answer
  std::uint64_t source_wrong = 0;                // the file's own verdict is not the exact one
  TimeHistogram time;                            // of one query; never hashed
  /// Contacts that do not exist, reported by a core that was allowed a tolerance: neither right nor wrong.
  std::uint64_t not_judged = 0;
  std::uint64_t wrong() const { return missed + ghost + late + failed; }
  void merge(const PrimitiveTally& o);
};

/// By source (a folder of published queries, or "random") and kind ("vertex-face", "edge-edge").
using PrimitiveTallies = std::map<std::pair<std::string, std::string>, PrimitiveTally>;

Json to_json(const PrimitiveTallies& tallies);

}  // namespace touchstone::fuzz
