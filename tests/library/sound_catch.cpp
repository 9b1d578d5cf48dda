#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#include "touchstone_catch.h"

using touchstone_c::Body;
using touchstone_c::Stated;

namespace {
const Body box{"box 1 1 1"}, ball{"sphere 0.5", {0, 0, 1.75, 0, 0, 0, 1}};
}

TEST_CASE("a right answer") {
  REQUIRE_THAT(Stated().distance(0.25).normal({0, 0, 1}), touchstone::is_sound(box, ball));
  REQUIRE_THAT(Stated().distance(0.2500001), touchstone::is_sound(box, ball, {1e-6, false}));
  REQUIRE_THAT(Stated().distance(0.26), !touchstone::is_sound(box, ball));
}

TEST_CASE("a wrong answer", "[wrong]") {
  REQUIRE_THAT(Stated().distance(0).normal({0, 0, 1}), touchstone::is_sound(box, ball));
}

TEST_CASE("the wrapper") {
  CHECK(touchstone_c::gap(box, ball).lo == Approx(0.25));
  const Body falls{"sphere 0.5", {0, 0, 1.75, 0, 0, 0, 1}, std::array<double, 6>{0, 0, -1, 0, 0, 0}};
  CHECK(touchstone_c::impact(box, falls).t_hi == Approx(0.25));
  CHECK(touchstone_c::answer(box, falls).find("\"certified\":true") != std::string::npos);
  CHECK(touchstone_c::check(box, ball,
                            R"({"kind": "separating_plane", "direction": [0, 0, 1], "offset": 1.1})"));
  CHECK_THROWS_AS(Body{"bax 1 1 1"}, touchstone_c::Error);
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const Body hull{touchstone_c::Shape::hull(points, 4), {2, 0, 0, 0, 0, 0, 1}};
  CHECK(touchstone_c::gap(box, hull).lo == Approx(1));
}
