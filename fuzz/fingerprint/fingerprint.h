// The fixed set of cases of fingerprints, and an engine's answers to it. The set has a version: a change of
// what it asks is a new version, because fingerprints of different questions cannot be compared.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "oracles/abi/engine.h"
#include "reports/record/fingerprint.h"

namespace touchstone::fuzz {

inline constexpr std::uint64_t fingerprint_set = 1, fingerprint_cases = 20'000;

/// Case i of the set.
Case fingerprint_case(std::uint64_t i);

struct FingerprintConfig {
  std::function<EnginePtr()> make;  // an engine that was asked nothing yet; called by several threads
  std::uint64_t cases = fingerprint_cases;
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
};
/// The same for any number of jobs. Throws Stopped when `stop` is set.
Fingerprint fingerprint_of(const FingerprintConfig& config);

/// Where an answer of a fingerprint comes from: the `index`-th to that question about these shapes.
struct FingerprintPlace {
  std::uint64_t case_index = 0;
  std::size_t query = 0;
};
/// Empty if the set has no such answer.
std::optional<FingerprintPlace> place_in_set(const std::string& question, const std::string& shapes,
                                             std::size_t index, std::uint64_t cases);

}  // namespace touchstone::fuzz
