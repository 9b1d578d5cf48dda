// A GoogleTest matcher: EXPECT_THAT(contact, touchstone::is_sound(a, b)) with GoogleMock, and without it
// EXPECT_TRUE(touchstone::is_sound(a, b).judge(contact)). `contact` is a touchstone_c::Stated, and a and b
// are touchstone_c::Body. Link touchstone::library.
#pragma once

#include <gtest/gtest.h>

#include <touchstone_sound.hpp>

namespace touchstone {

class IsSound {
 public:
  using is_gtest_matcher = void;
  explicit IsSound(Soundness s) : soundness_(std::move(s)) {}
  bool MatchAndExplain(const touchstone_c::Stated& s, std::ostream* out) const {
    const bool holds = soundness_.holds(s);
    if (!holds && out != nullptr) *out << soundness_.reason(s);
    return holds;
  }
  void DescribeTo(std::ostream* out) const { *out << soundness_.description(); }
  void DescribeNegationTo(std::ostream* out) const { *out << "is wrong, or cannot be judged"; }
  testing::AssertionResult judge(const touchstone_c::Stated& s) const {
    if (soundness_.holds(s)) return testing::AssertionSuccess();
    return testing::AssertionFailure() << s << soundness_.reason(s);
  }

 private:
  Soundness soundness_;
};

inline IsSound is_sound(touchstone_c::Body a, touchstone_c::Body b, touchstone_c::Precision p = {}) {
  return IsSound(Soundness(std::move(a), std::move(b), p));
}

}  // namespace touchstone
