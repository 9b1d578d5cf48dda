// `touchstone view SCENE --broad`: the page's data against a double loop over its own boxes, and refusals.
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using touchstone::test::Workspace;

namespace {

using Json = nlohmann::json;

bool meet(const Json& a, const Json& b, std::size_t axis) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto low = [&](const Json& x) { return x[0][axis].is_null() ? -inf : x[0][axis].get<double>(); };
  const auto high = [&](const Json& x) { return x[1][axis].is_null() ? inf : x[1][axis].get<double>(); };
  return low(a) <= high(b) && low(b) <= high(a);
}

}  // namespace

TEST_CASE("the page's pairs are those of a double loop over its boxes", "[cli][view]") {
  const Workspace w("view");
  long kept = 0, pruned = 0;
  for (const std::string scene : {"thousand_balls", "cubes_fill_space", "around_the_origin"}) {
    INFO(scene);
    const auto r = w.touchstone("view " + scene + " --broad --json");
    REQUIRE(r.code == 0);
    const Json data = touchstone::test::parsed<Json>(r.out);
    REQUIRE(data["methods"].size() == 4);
    for (const Json& f : data["frames"]) {
      Json expected = Json::array();
      std::array<long, 3> on_axis{};
      const Json& boxes = f["boxes"];
      for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a + 1; b < boxes.size(); ++b) {
          if (boxes[a].is_null() || boxes[b].is_null()) continue;
          bool all = true;
          for (std::size_t k = 0; k < 3; ++k) {
            const bool here = meet(boxes[a], boxes[b], k);
            on_axis[k] += here ? 1 : 0;
            all &= here;
          }
          if (all) expected.push_back({a, b});
        }
      CHECK(f["kept"] == expected);
      CHECK(f["overlap_on_axis"] == Json(on_axis));
      for (const Json& look : f["looks"]) {
        CHECK(look["considered"].get<long>() >= static_cast<long>(expected.size()));
        CHECK(look["considered"].get<long>() <= f["all_pairs"].get<long>());
        for (const Json& p : look["pruned"]) {
          const Json &a = boxes[p[0].get<std::size_t>()], &b = boxes[p[1].get<std::size_t>()];
          CHECK_FALSE((meet(a, b, 0) && meet(a, b, 1) && meet(a, b, 2)));
          ++pruned;
        }
      }
      kept += static_cast<long>(expected.size());
    }
  }
  CHECK(kept > 1000);
  CHECK(pruned > 1000);
}

TEST_CASE("view refuses what it cannot show, and names place and reason", "[cli][view]") {
  const Workspace w("view");
  const auto refused = [&](const std::string& args, const std::string& reason) {
    INFO(args);
    const auto r = w.touchstone("view " + args);
    CHECK(r.code == 2);
    CHECK(r.err.find(reason) != std::string::npos);
  };
  refused("thousand_balls", "-o");
  refused("thousand_balls --broad", "-o");
  refused("thousand_balls --broad -o page.html --method fastest", "fastest: unknown; expected automatic");
  refused("no_such_scene --broad -o page.html", "no_such_scene");
  w.write("file", "");
  refused("thousand_balls --broad -o file/page.html", "cannot be created");
  CHECK_FALSE(std::filesystem::exists(w.dir / "page.html"));
}
