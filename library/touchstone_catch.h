// A Catch2 matcher (version 2 or 3): REQUIRE_THAT(contact, touchstone::is_sound(a, b)), where `contact` is a
// touchstone_c::Stated, and a and b are touchstone_c::Body. Link touchstone::library.
#pragma once

#if __has_include(<catch2/matchers/catch_matchers.hpp>)
#include <catch2/matchers/catch_matchers.hpp>
#else
#include <catch2/catch.hpp>
#endif

#include <touchstone_sound.hpp>

namespace touchstone {

#if __has_include(<catch2/matchers/catch_matchers.hpp>)
using MatcherOfStated = Catch::Matchers::MatcherBase<touchstone_c::Stated>;
#else
using MatcherOfStated = Catch::MatcherBase<touchstone_c::Stated>;
#endif

class IsSound : public MatcherOfStated {
 public:
  explicit IsSound(Soundness s) : soundness_(std::move(s)) {}
  bool match(const touchstone_c::Stated& s) const override {
    const bool holds = soundness_.holds(s);
    reason_ = holds ? "" : "\n" + soundness_.reason(s);
    return holds;
  }
  std::string describe() const override { return soundness_.description() + reason_; }

 private:
  Soundness soundness_;
  mutable std::string reason_;  // of the last match
};

inline IsSound is_sound(touchstone_c::Body a, touchstone_c::Body b, touchstone_c::Precision p = {}) {
  return IsSound(Soundness(std::move(a), std::move(b), p));
}

}  // namespace touchstone
