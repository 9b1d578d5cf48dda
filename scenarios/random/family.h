// Families of random cases. A case is a pure function of (family mix, seed, index): any case can be made
// again alone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

struct Family {
  std::string_view name;
  std::string_view line;  // what it aims at, for people
  int weight;             // share in the default mix
  void (*make)(Rng& rng, Case& out);
};

/// The catalog.
std::span<const Family> families();

/// The index-th case of a campaign of one family, of several by their weights (`deep,far`), or, empty, of
/// all. Throws InputError on an unknown family.
Case make_case(std::uint64_t seed, std::uint64_t index, std::string_view names = {});

}  // namespace touchstone::fuzz
