// What the default mix of cases must reach, and that a hole in it is seen.
#include "fuzz/coverage/coverage.h"

#include <algorithm>

#include "oracles/core/core_engine.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

TEST_CASE("the default mix, and solid meshes and padded shapes beside it, reach everything", "[coverage]") {
  fuzz::Coverage coverage;
  for (std::uint64_t i = 0; i < 3000; ++i) coverage.add(fuzz::make_case(1, i), true);
  for (std::uint64_t i = 0; i < 400; ++i) coverage.add(fuzz::make_case(1, i, "solids"), true);
  for (std::uint64_t i = 0; i < 1000; ++i) coverage.add(fuzz::make_case(1, i, "padded"), true);
  CHECK(coverage.cases() == 4400);
  std::string missed;
  for (const auto& [group, value] : coverage.missed()) missed += group + " " + value + "\n";
  CHECK(missed.empty());
}

TEST_CASE("a mix with a hole is seen", "[coverage]") {
  fuzz::Coverage coverage;
  for (std::uint64_t i = 0; i < 50; ++i) coverage.add(fuzz::make_case(1, i, "separate"), true);
  const auto missed = coverage.missed();
  const auto misses = [&](const char* group, const char* value) {
    return std::find(missed.begin(), missed.end(), std::pair<std::string, std::string>(group, value)) !=
           missed.end();
  };
  CHECK(misses("regime", "deeper than 0.1"));
  CHECK(misses("question", "swept_candidates"));
  CHECK(misses("family", "deep"));
  CHECK_FALSE(misses("regime", "apart"));
  CHECK_FALSE(misses("family", "separate"));
}

TEST_CASE("each query of a case is counted once, with what the engine made of it", "[coverage]") {
  Case c;
  c.family = "hand";
  c.scene.shapes = {Sphere{1}, Box{{1, 1, 1}}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = {2, 0, 0};  // they touch
  c.queries = {{Question::overlap, 1, 0}, {Question::distance, 0, 1}};
  fuzz::Coverage coverage;
  coverage.add(c, true);
  CoreEngine core;
  coverage.add(core.card(), c, core.run({&c, 1}).at(0));
  CHECK(coverage.count("pair", "box-sphere") == 2);
  CHECK(coverage.count("order", "a > b") == 1);
  CHECK(coverage.count("regime", "touching within 1e-13") == 2);
  CHECK(coverage.count("shape", "box") == 1);
  CHECK(coverage.count("core", "overlap: answered") == 1);
  CHECK(coverage.count("core", "contact: answered") == 0);
  CHECK(coverage.count("script", "no script") == 1);
  CHECK(coverage.groups().back().name == "core");
}
