// Bytes to scenes, for a fuzzer that is guided by the coverage of our own code.
//   byte 0        the family, modulo their number
//   bytes 1 to 8  the seed of its case, little-endian; the case is number 0 of that seed
//   then, 4 bytes each, at most 16 changes of it (generate/mutate.h): number (little-endian), kind, argument
// Every input of 9 bytes or more is a case of the same domains as a campaign's, near one that a campaign
// makes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracles/abi/engine.h"
#include "scenarios/random/mutate.h"

namespace touchstone::fuzz {

/// Nothing for too few bytes, or where a change leaves a scene that is not valid.
std::optional<Case> decode(std::span<const std::uint8_t> bytes);
std::vector<std::uint8_t> encode(std::uint8_t family, std::uint64_t seed, std::span<const Change> changes);

/// Asks the engine about the case that the bytes mean, by the referee and by the relations; aborts, with the
/// case as JSON on stderr for `touchstone replay`, when it is found wrong.
void judge_bytes(std::span<const std::uint8_t> bytes, const EnginePtr& engine);

}  // namespace touchstone::fuzz
