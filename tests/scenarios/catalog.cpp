// The catalog of handmade scenarios as a whole.
#include "scenarios/handmade/scenario.h"

#include <map>
#include <set>

#include "scenarios/codec/scene_codec.h"
#include "tests/scenarios/check_case.h"
#include "tests/support/catch.h"

using namespace touchstone;

TEST_CASE("there are at least 40 scenarios, in all eight folders, with unique names", "[scenarios]") {
  std::set<std::string> names;
  std::map<std::string, int> folders;
  for (const auto& s : scenarios::catalog()) {
    INFO(s.name);
    CHECK(names.insert(s.name).second);
    CHECK(s.name.find_first_of(" /\\\"") == std::string::npos);
    CHECK(!s.line.empty());
    CHECK(s.line.find('\n') == std::string::npos);
    ++folders[s.folder];
  }
  CHECK(names.size() >= 40);
  for (const char* f : {"touching", "thin", "far", "deep", "degenerate", "motion", "crowd", "lifecycle"}) {
    INFO(f);
    CHECK(folders[f] >= 5);
  }
  CHECK(folders.size() == 8);
}

TEST_CASE("every scenario is a valid case with an expectation that does not contradict itself",
          "[scenarios]") {
  int checked = 0;
  for (const auto& s : scenarios::catalog()) {
    INFO(s.folder << "/" << s.name);
    const Case c = s.make();
    CHECK(c.id == s.folder + "/" + s.name);
    CHECK(c == s.make());
    test::check_case(c, s.expect);
    ++checked;
  }
  CHECK(checked >= 40);
}

TEST_CASE("the worked example is present: 1,000 objects, 499,500 pairs, 3,420 after the broad phase",
          "[scenarios]") {
  int found = 0;
  for (const auto& s : scenarios::catalog())
    if (s.name == "thousand_balls") {
      CHECK(s.make().scene.bodies.size() == 1000);
      CHECK(s.expect.all_pairs == 499500);
      CHECK(s.expect.box_pairs == 3420);
      CHECK(s.expect.overlapping_pairs == 1800);
      ++found;
    }
  CHECK(found == 1);
}

TEST_CASE("no two scenarios are the same scene", "[scenarios]") {
  std::map<std::uint64_t, std::string> seen;
  for (const auto& s : scenarios::catalog()) {
    const auto [it, is_new] = seen.emplace(hash(s.make().scene), s.name);
    INFO(s.name << " equals " << it->second);
    CHECK(is_new);
  }
}
