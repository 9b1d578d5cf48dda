// What a case can be made smaller by. Each reduction proposes cases, boldest first; none asks an engine. A
// proposal need not be a valid scene: propose() keeps the valid ones that are smaller.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Something of which a case has several: queries, bodies, steps, vertices of its i-th hull, …
struct ListPart {
  std::string_view name;
  std::size_t (*lists)(const Case& c);                    // how many such lists
  std::size_t (*count)(const Case& c, std::size_t list);  // elements of one
  std::optional<Case> (*drop)(const Case& c, std::size_t list, std::size_t first, std::size_t n);
};
std::span<const ListPart> list_parts();

/// Simpler forms of single things: a body without its motion, a turned body upright, everything moved to the
/// origin.
struct Simplification {
  std::string_view name;
  void (*propose)(const Case& c, std::vector<Case>& out);
};
std::span<const Simplification> simplifications();

/// The same case with all numbers at a few bits, fewest first.
std::vector<Case> round_all(const Case& c);
/// The i-th of numbers(c) as 0, ±1 and at a few bits, fewest first. Empty when i is past the last.
std::vector<Case> round_one(const Case& c, std::size_t i);

/// Those that are valid and smaller than c.
std::vector<Case> smaller_and_valid(const Case& c, std::vector<Case> proposals);

}  // namespace touchstone::fuzz
