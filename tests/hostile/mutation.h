// Damage to files: bytes, and the values, members and items of JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/math/rng.h"

namespace touchstone::test {

/// A good file, with its content if that is JSON (else discarded).
struct Original {
  std::string text;
  nlohmann::ordered_json json;
};
Original original_of(std::string text);

/// One of many damaged forms; the same numbers give the same bytes.
std::string mutated(const Original& good, Rng& rng);

}  // namespace touchstone::test
