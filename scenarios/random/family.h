// Families of random cases. A case is a pure function of (family mix, seed, index), so any case can be
// regenerated on its own.
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
  std::string_view line;  // summary for display
  int weight;             // share in the default mix
  void (*make)(Rng& rng, Case& out);
};

/// The catalog.
std::span<const Family> families();

/// The index-th case of a campaign with one family, several by weight (`deep,far`) or, when `names` is empty,
/// all. Throws InputError on an unknown family. If `kinds` are given, all shapes are of these kinds, except
/// where the family has no such case.
Case make_case(std::uint64_t seed, std::uint64_t index, std::string_view names = {},
               std::span<const ShapeKind> kinds = {});

// Regimes: situations that the default mix must contain whatever its families are, because some engine fails
// only there. A row has a test for the situation and its minimum share of the default mix.

struct Regime {
  std::string_view name;
  std::string_view line;  // summary for display
  int one_in;             // at least one case in this many of the default mix shows it
  bool (*shown)(const Case& c, const Case& before);  // `before`: the case with the previous index
};

/// The catalog.
std::span<const Regime> regimes();

}  // namespace touchstone::fuzz
