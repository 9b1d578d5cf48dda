// Small changes of a case, from which guided campaigns and the libFuzzer entry point make new cases.
#pragma once

#include <cstdint>

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// One change in four bytes; every value is valid. `number` is taken modulo the count of numbers.
struct Change {
  enum class Kind : std::uint8_t {
    nudge,   // a number by `argument` (signed) ulps
    scale,   // a number by 2^(argument/16) (signed)
    copy,    // a number becomes another one, or its negative
    offset,  // a number by ±2^-(argument mod 60)
    simple,  // a number becomes 0, -0, ±1, ±1/2, or is rounded to a few bits
    steer,   // the second body is moved along an axis until the gap is 0, an ulp, or a small power of two
    align,   // the second body gets the first one's rotation
    kinds    // number of kinds
  };
  std::uint16_t number = 0;
  std::uint8_t kind = 0;  // modulo Kind::kinds
  std::uint8_t argument = 0;
};

Change random_change(Rng& rng);

/// Returns false, with c unspecified, when the changed scene is not valid.
bool apply(const Change& change, Case& c);

}  // namespace touchstone::fuzz
