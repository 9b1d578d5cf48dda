// The C interface in this process: answers, refusals, threads.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "library/touchstone.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

namespace {

struct Owned {
  touchstone_shape* shape = nullptr;
  explicit Owned(const char* text) {
    const touchstone_status s = touchstone_parse_shape(text, &shape);
    INFO(touchstone_last_error());
    REQUIRE(s == TOUCHSTONE_OK);
  }
  ~Owned() { touchstone_free_shape(shape); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
};

constexpr double above[] = {0, 0, 1.75, 0, 0, 0, 1};

touchstone_gap gap_of(const Owned& a, const Owned& b, const double* pose, double margin = 0) {
  touchstone_gap g{};
  REQUIRE(touchstone_gaps(a.shape, nullptr, b.shape, pose, 1, margin, &g) == TOUCHSTONE_OK);
  return g;
}

}  // namespace

TEST_CASE("the library answers gaps, and says what is within a margin", "[library]") {
  const Owned box("box 1 1 1"), ball(R"({"type": "sphere", "radius": 0.5})");
  const touchstone_gap g = gap_of(box, ball, above, 0.25);
  CHECK(g.lo <= 0.25);
  CHECK(g.hi >= 0.25);
  CHECK(g.hi - g.lo < 0x1p-40);
  CHECK(g.verdict == TOUCHSTONE_DISJOINT);
  CHECK(g.normal[2] == 1);
  CHECK(gap_of(box, ball, above, 0.3).within_margin == 1);
  CHECK(gap_of(box, ball, above, 0.2).within_margin == 0);
  const double inside[] = {0, 0, 1.25, 0, 0, 0, 2};
  const touchstone_gap deep = gap_of(box, ball, inside);
  CHECK(deep.verdict == TOUCHSTONE_OVERLAP);
  CHECK(deep.lo <= -0.25);
  CHECK(deep.hi >= -0.25);
  CHECK(deep.within_margin == 1);
  const double touching[] = {0, 0, 1.5, 0, 0, 0, 1};
  CHECK(gap_of(box, ball, touching).verdict == TOUCHSTONE_OVERLAP);
}

TEST_CASE("an answer of the library is certified, and its certificates are checked by the library",
          "[library]") {
  const Owned box("box 1 1 1"), cylinder("cylinder 0.5 2");
  const double pose[] = {0.1, 0.2, 3.5, 0.1, 0, 0, 1}, falls[] = {0, 0, -2, 0, 0, 0.3};
  char* text = nullptr;
  REQUIRE(touchstone_answer(box.shape, nullptr, nullptr, cylinder.shape, pose, falls, &text) ==
          TOUCHSTONE_OK);
  const auto j = touchstone::test::parsed<nlohmann::json>(text);
  touchstone_free_text(text);
  INFO(j.dump());
  CHECK(j["certified"] == true);
  CHECK(j["time_of_impact"]["verdict"] == "hit");
  CHECK(j["time_of_impact"]["certified"] == true);
  REQUIRE(j["certificates"].size() == 3);
  const auto holds = [&](const nlohmann::json& c) {
    int valid = -1;
    REQUIRE(touchstone_check(box.shape, nullptr, nullptr, cylinder.shape, pose, falls, c.dump().c_str(),
                             &valid) == TOUCHSTONE_OK);
    return valid == 1;
  };
  for (const auto& c : j["certificates"]) CHECK(holds(c));
  CHECK(holds(j["time_of_impact"]["certificate"]));
  nlohmann::json wrong = j["certificates"]["at_least"];
  wrong["offset"] = wrong["offset"].get<double>() * 1.001;
  CHECK_FALSE(holds(wrong));
}

TEST_CASE("the library judges what an engine says, and gives the reason", "[library]") {
  const Owned box("box 1 1 1"), ball("sphere 0.5");
  touchstone_stated says[3]{};
  for (touchstone_stated& s : says) {
    s.stated = TOUCHSTONE_STATES_DISTANCE | TOUCHSTONE_STATES_NORMAL;
    s.distance = 0.25;
    s.normal[2] = 1;
  }
  says[1].distance = 0;
  says[2].normal[2] = -1;
  double poses[21];
  for (int i = 0; i < 21; ++i) poses[i] = above[i % 7];
  int rulings[3] = {-1, -1, -1};
  REQUIRE(touchstone_judge(box.shape, nullptr, nullptr, ball.shape, poses, nullptr, 3, says, 0, 0, rulings) ==
          TOUCHSTONE_OK);
  CHECK(rulings[0] == TOUCHSTONE_RIGHT);
  CHECK(rulings[1] == TOUCHSTONE_WRONG);
  CHECK(rulings[2] == TOUCHSTONE_WRONG);
  char* why = nullptr;
  REQUIRE(touchstone_explain(box.shape, nullptr, nullptr, ball.shape, above, nullptr, &says[1], 0, 0, &why) ==
          TOUCHSTONE_OK);
  const auto j = touchstone::test::parsed<nlohmann::json>(why);
  touchstone_free_text(why);
  REQUIRE(j["faults"].size() == 1);
  CHECK(j["faults"][0]["words"] == "says 0; the signed distance is 0.25");
  CHECK(j["faults"][0]["fault"] == "distance_off");
}

TEST_CASE("a bad argument is refused in words, and nothing is written", "[library]") {
  const Owned box("box 1 1 1");
  touchstone_shape* none = nullptr;
  for (const char* text : {"", "box", "box 1 1 1 at 0 0 1", "bax 1 1 1", "{", "{\"type\": \"box\"}",
                           "sphere -1", "sphere nan", "mesh 1"}) {
    INFO(text);
    CHECK(touchstone_parse_shape(text, &none) == TOUCHSTONE_INVALID);
    CHECK(none == nullptr);
    CHECK_FALSE(std::string(touchstone_last_error()).empty());
  }
  CHECK(touchstone_parse_shape(nullptr, &none) == TOUCHSTONE_INVALID);
  CHECK(touchstone_parse_shape("box 1 1 1", nullptr) == TOUCHSTONE_INVALID);
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int outside[] = {0, 1, 3};
  CHECK(touchstone_mesh(points, 3, outside, 1, &none) == TOUCHSTONE_INVALID);
  CHECK(touchstone_hull(points, 0, &none) == TOUCHSTONE_INVALID);
  touchstone_gap g{};
  g.verdict = 77;
  const double bad[] = {0, 0, std::numeric_limits<double>::infinity(), 0, 0, 0, 1},
               zero[] = {0, 0, 0, 0, 0, 0, 0};
  CHECK(touchstone_gaps(box.shape, nullptr, box.shape, bad, 1, 0, &g) == TOUCHSTONE_INVALID);
  CHECK(touchstone_gaps(box.shape, zero, box.shape, nullptr, 1, 0, &g) == TOUCHSTONE_INVALID);
  CHECK(touchstone_gaps(nullptr, nullptr, box.shape, nullptr, 1, 0, &g) == TOUCHSTONE_INVALID);
  CHECK(touchstone_gaps(box.shape, nullptr, box.shape, nullptr, 1, std::nan(""), &g) == TOUCHSTONE_INVALID);
  CHECK(touchstone_gaps(box.shape, nullptr, box.shape, nullptr, 1, 0, nullptr) == TOUCHSTONE_INVALID);
  CHECK(g.verdict == 77);
  int valid = 77;
  for (const char* certificate : {"", "[]", "{}", "{\"kind\": \"impact\"}", "{\"kind\": 3}",
                                  R"({"kind": "common_point", "rationals": ["1/0", "0", "0"]})"}) {
    INFO(certificate);
    const touchstone_status s =
        touchstone_check(box.shape, nullptr, nullptr, box.shape, nullptr, nullptr, certificate, &valid);
    CHECK((s == TOUCHSTONE_INVALID || valid == 0));
  }
  touchstone_stated nothing{};
  int ruling = 77;
  CHECK(touchstone_judge(box.shape, nullptr, nullptr, box.shape, nullptr, nullptr, 1, &nothing, 0, 0,
                         &ruling) == TOUCHSTONE_INVALID);
  CHECK(ruling == 77);
}

TEST_CASE("threads share shapes, and each has its own last error", "[library]") {
  const Owned box("box 1 1 1"), cone("cone 0.5 1");
  const auto work = [&](int seed, std::vector<double>& lows, std::string& error) {
    for (int i = 0; i < 40; ++i) {
      const double pose[] = {0.1 * i, 0.05 * i, 0.2, 0.3, 0.1 * i, 0, 1};
      touchstone_gap g{};
      touchstone_gaps(box.shape, nullptr, cone.shape, pose, 1, 0, &g);
      lows.push_back(g.lo);
      touchstone_shape* none = nullptr;
      touchstone_parse_shape(("bad" + std::to_string(seed)).c_str(), &none);
    }
    error = touchstone_last_error();
  };
  std::vector<double> lows[4];
  std::string errors[4];
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back(work, k, std::ref(lows[k]), std::ref(errors[k]));
  for (std::thread& t : threads) t.join();
  for (int k = 0; k < 4; ++k) {
    CHECK(lows[k] == lows[0]);
    CHECK(errors[k].find("bad" + std::to_string(k)) != std::string::npos);
  }
}
