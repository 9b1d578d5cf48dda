// Reductions that make a case smaller. Each proposes cases, boldest first, without querying an engine. A
// proposal need not be a valid scene: smaller_and_valid() keeps those that are valid, and smaller by
// measure(), so the shrinker terminates.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "scenarios/random/numbers.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// Rounds v to the nearest number with `significant` bits.
double rounded_to(double v, int significant);

/// A kind of list in a case: queries, bodies, steps, vertices of its i-th hull, …
struct ListPart {
  std::string_view name;
  std::size_t (*lists)(const Case& c);                    // number of such lists
  std::size_t (*count)(const Case& c, std::size_t list);  // elements of one list
  std::optional<Case> (*drop)(const Case& c, std::size_t list, std::size_t first, std::size_t n);
};
std::span<const ListPart> list_parts();

/// Simplifies single elements: removes a body's motion, sets a rotated body upright, moves everything to the
/// origin.
struct Simplification {
  std::string_view name;
  void (*propose)(const Case& c, std::vector<Case>& out);
};
std::span<const Simplification> simplifications();

/// The numbers that are lengths: those of numbers(c) but rotations, angular velocities and the normals of
/// half-spaces.
std::vector<double*> lengths(Case& c);

/// The case with all numbers rounded to a few bits, fewest first.
std::vector<Case> round_all(const Case& c);
/// The case with the i-th of numbers(c) set to 0, to ±1 and rounded to a few bits, fewest first. Empty when i
/// is out of range.
std::vector<Case> round_one(const Case& c, std::size_t i);

/// The proposals that are valid and smaller than c.
std::vector<Case> smaller_and_valid(const Case& c, std::vector<Case> proposals);

}  // namespace touchstone::fuzz
