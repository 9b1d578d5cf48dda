// replay --expected: which failures keep a build green.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

const std::string mutants = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";
const std::string ghosts = mutants + "overlap_always", halves = mutants + "depth_halved";

// Two spheres that are apart, and two that overlap.
void write_cases(const Workspace& w) {
  for (const auto& [name, x] : {std::pair{"apart", 3.0}, {"deep", 1.5}}) {
    Json c = {{"touchstone_case", 1}, {"id", name}};
    c["scene"] = {{"touchstone_scene", 1},
                  {"shapes", {{{"type", "sphere"}, {"radius", 1}}}},
                  {"bodies",
                   {{{"shape", 0}},
                    {{"shape", 0}, {"pose", {{"translation", {x, 0, 0}}, {"rotation", {0, 0, 0, 1}}}}}}}};
    w.write(std::string(name) + ".json", c.dump());
  }
}

Json load(const Workspace& w, const std::string& file) { return parsed<Json>(read_all(w.dir / file)); }

}  // namespace

TEST_CASE("recorded failures keep replay green; other ones do not", "[cli][expected]") {
  const Workspace w("expected");
  write_cases(w);
  const std::string replay = "replay apart.json deep.json ", all = "--engines core," + ghosts + "," + halves;
  const Run recorded = w.touchstone(replay + all + " --write-expected now.json");
  INFO(recorded.out << recorded.err);
  REQUIRE(recorded.code == 0);
  const Json now = load(w, "now.json");
  REQUIRE(now.at("failures").size() >= 2);
  for (const Json& f : now.at("failures")) CHECK(f.at("engine") != "core");
  const Run same = w.touchstone(replay + all + " --expected now.json --strict --junit j.xml");
  INFO(same.out << same.err);
  CHECK(same.code == 0);
  CHECK(last_line(same.out) ==
        "exit code 0 is about all engines: " + std::to_string(now.at("failures").size()) +
            " wrong as expected, 0 fixed, 0 newly wrong, 0 not asked\n");
  CHECK(read_all(w.dir / "j.xml").find("<testsuite name=\"overlap_always\"") != std::string::npos);
  CHECK(read_all(w.dir / "j.xml").find("<failure") == std::string::npos);
  // Written again, it is the same file.
  REQUIRE(w.touchstone(replay + all + " --expected now.json --write-expected again.json").code == 0);
  CHECK(read_all(w.dir / "again.json") == read_all(w.dir / "now.json"));
}

TEST_CASE("newly wrong answers are named, and fail only for the subject", "[cli][expected]") {
  const Workspace w("expected");
  write_cases(w);
  w.write("none.json", R"({"touchstone_expected": 1, "failures": []})");
  const std::string replay = "replay apart.json --expected none.json --engines core," + ghosts;
  const Run r = w.touchstone(replay + " --junit j.xml");
  INFO(r.out << r.err);
  CHECK(r.code == 1);
  CHECK(r.out.find("newly wrong:\n  apart: overlap_always ") != std::string::npos);
  CHECK(read_all(w.dir / "j.xml").find("<failure message=\"newly wrong: ") != std::string::npos);
  CHECK(w.touchstone(replay + " --subject core").code == 0);
  CHECK(w.touchstone(replay + " --subject overlap_always").code == 1);
  const Run json = w.touchstone(replay + " --json");
  CHECK(json.code == 1);
  CHECK(parsed<Json>(json.out).at("newly_wrong").at(0).at("case") == "apart");
}

TEST_CASE("what is fixed is said, and fails when strict; what has ended is wrong again", "[cli][expected]") {
  const Workspace w("expected");
  write_cases(w);
  const auto entry = [](const char* case_id, const char* question, const char* until) {
    Json e = {{"case", case_id},
              {"engine", "overlap_always"},
              {"question", question},
              {"fault", "any"},
              {"reason", "it always says so"}};
    if (*until != 0) e["until"] = until;
    return e;
  };
  const auto expect = [&](const Json& failures) {
    w.write("e.json", Json{{"touchstone_expected", 1}, {"failures", failures}}.dump());
  };
  const std::string replay = "replay apart.json deep.json --expected e.json --engines " + ghosts;
  expect({entry("apart", "overlap", "2099-12-31"), entry("apart", "contact", ""),
          entry("apart", "distance", ""), entry("deep", "overlap", ""), entry("elsewhere", "overlap", "")});
  const Run lenient = w.touchstone(replay), strict = w.touchstone(replay + " --strict");
  INFO(lenient.out << lenient.err);
  CHECK(lenient.code == 0);
  CHECK(lenient.out.find("  deep: overlap_always overlap any\n    it always says so\n") != std::string::npos);
  CHECK(last_line(lenient.out).find(" 0 newly wrong, 1 not asked") != std::string::npos);
  CHECK(strict.code == 1);
  expect({entry("apart", "overlap", "2020-01-01"), entry("apart", "contact", ""),
          entry("apart", "distance", "")});
  const Run ended = w.touchstone(replay);
  CHECK(ended.code == 1);
  CHECK(ended.out.find("expected until 2020-01-01: it always says so") != std::string::npos);
}

TEST_CASE("a comparison that is incomplete is not green, and is not recorded", "[cli][expected]") {
  const Workspace w("expected");
  write_cases(w);
  w.write("none.json", R"({"touchstone_expected": 1, "failures": []})");
  const std::string with = " --engines core --expected none.json";
  const Run bad = w.touchstone("replay apart.json absent.json --write-expected now.json" + with);
  CHECK(bad.code == 2);
  CHECK(bad.err.find("absent.json") != std::string::npos);
  CHECK_FALSE(fs::exists(w.dir / "now.json"));
  fs::create_directories(w.dir / "r");
  w.write("r/scene.txt", "");
  CHECK(w.touchstone("replay r" + with).err.find("is a recording") != std::string::npos);
  for (const char* options :
       {" --strict", " --junit j.xml", " --expected absent.json", " --expected apart.json",
        " --write-expected apart.json/file.json", " --expected none.json --junit apart.json/file.xml"}) {
    const Run r = w.touchstone("replay apart.json --engines core" + std::string(options));
    INFO(options << ": " << r.out << r.err);
    CHECK(r.code == 2);
  }
}
