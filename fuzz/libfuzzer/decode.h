// Decodes bytes into cases, for a fuzzer guided by the coverage of the core.
//   byte 0        index of the family, modulo the number of families
//   bytes 1 to 8  the seed of its case, little-endian; the case is number 0 of that seed
//   then at most 16 changes of 4 bytes each (scenarios/random/mutate.h): number (little-endian), kind,
//   argument
// Every input of 9 bytes or more is a case from the same domains as a campaign's, and close to one that a
// campaign generates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"
#include "scenarios/random/mutate.h"

namespace touchstone::fuzz {

/// Returns nothing if there are too few bytes or a change makes the scene invalid.
std::optional<Case> decode(std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> encode(std::uint8_t family, std::uint64_t seed, std::span<const Change> changes);

/// Runs the engine on the decoded case and judges it by the referee and the relations. If it is wrong, prints
/// the case as JSON to stderr (for `touchstone replay`) and aborts.
void judge_bytes(std::span<const std::uint8_t> bytes, const EnginePtr& engine);

}  // namespace touchstone::fuzz
