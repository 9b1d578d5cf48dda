// What is wrong about an answer, in numbers: how far it is from the truth, and quantities of the case that
// the error may be proportional to. Half the depth is another fault than a depth that is 1e-3 too small.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/judge/truth.h"
#include "scenarios/value/case.h"
#include "scenarios/value/judgement.h"

namespace touchstone::fuzz {

struct Deviation {
  /// The part of the answer that is wrong: "distance", "depth", "opposite normal", "missed", …
  std::string manner;
  double error = 0;  // answered minus true, signed; 0 where there is no number to compare
  /// The true value, the scale L of the case, the extents of the smaller and the larger body, and 1: what the
  /// error is compared with, in the order of `references`.
  std::array<double, 5> of{};
};
enum class Reference : std::uint8_t { truth, scale, smaller, larger, one };
inline constexpr auto references = std::to_array<std::string_view>(
    {"the true value", "the scale of the scene", "the smaller body", "the larger body", "a constant"});

Deviation deviation_of(const Case& c, const Query& q, const Observation& o, const FaultReport& f,
                       Truth& truth);

/// The rule that the errors of one fault in several cases follow: error = factor · reference, with the same
/// factor in all of them.
struct ErrorLaw {
  Reference reference = Reference::one;
  double factor = 0;
};
/// All that fit; none with fewer than three errors. Several, when their references do not vary enough in
/// these cases to tell them apart.
std::vector<ErrorLaw> laws_of(std::span<const Deviation> of_one_fault);

/// True when some law, with the same factor within a tenth, is one of both, or neither has any.
bool obey_one_law(std::span<const ErrorLaw> x, std::span<const ErrorLaw> y);

}  // namespace touchstone::fuzz
