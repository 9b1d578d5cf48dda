#ifdef HAS_GMOCK
#include <gmock/gmock.h>
#endif

#include "touchstone_gtest.h"

using touchstone_c::Body;
using touchstone_c::Stated;

namespace {
const Body box{"box 1 1 1"}, ball{"sphere 0.5", {0, 0, 1.75, 0, 0, 0, 1}};
}

TEST(contact, is_right) {
  EXPECT_TRUE(touchstone::is_sound(box, ball).judge(Stated().distance(0.25).normal({0, 0, 1})));
#ifdef HAS_GMOCK
  EXPECT_THAT(Stated().distance(0.25).normal({0, 0, 1}), touchstone::is_sound(box, ball));
#endif
}

TEST(contact, is_wrong) {
  EXPECT_TRUE(touchstone::is_sound(box, ball).judge(Stated().distance(0).normal({0, 0, 1})));
#ifdef HAS_GMOCK
  EXPECT_THAT(Stated().distance(0), touchstone::is_sound(box, ball));
#endif
}
