// Small changes of a case: what a guided campaign and the libFuzzer entry make new cases from.
#pragma once

#include <cstdint>

#include "core/math/rng.h"
#include "scenarios/value/case.h"

namespace touchstone::fuzz {

/// One change in four bytes; every value is one. `number` counts modulo what there is.
struct Change {
  enum class Kind : std::uint8_t {
    nudge,   // a number by `argument` (signed) ulps
    scale,   // a number by 2^(argument/16) (signed)
    copy,    // a number becomes another one, or minus that
    offset,  // a number by ±2^-(argument mod 60)
    simple,  // a number becomes 0, -0, ±1, ±1/2, or is rounded to a few bits
    steer,   // the second body is moved along an axis until the gap is 0, an ulp, or a small power of two
    align,   // the second body is turned as the first
    kinds    // how many there are
  };
  std::uint16_t number = 0;
  std::uint8_t kind = 0;  // modulo Kind::kinds
  std::uint8_t argument = 0;
};

Change random_change(Rng& rng);

/// False, and c is unspecified, when the changed scene is not valid.
bool apply(const Change& change, Case& c);

}  // namespace touchstone::fuzz
