// `touchstone import`, commands that are given a robot in place of a scene, and `assess`.
#include <nlohmann/json.hpp>
#include <string>

#include "reports/text/record_text.h"
#include "tests/support/catch.h"
#include "tests/support/workspace.h"

using touchstone::test::read_all;
using touchstone::test::Workspace;

namespace {

using Json = nlohmann::json;
using namespace touchstone;

const std::string files = TS_SOURCE_DIR "/tests/scenarios/import/files/";
const std::string mutants = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t widest_line(const std::string& text) {
  std::size_t most = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    most = std::max(most, end - at);
    at = end + 1;
  }
  return most;
}

// Without times, and without the order of advice that depends on them.
Json reproducible(const std::string& text) {
  Json j = Json::parse(text);
  j.erase("advice");
  for (Json& e : j["engines"])
    for (Json& q : e["questions"]) q.erase("median_ns");
  return j;
}

}  // namespace

TEST_CASE("import writes a scene that other commands read, and they read the robot itself", "[cli][import]") {
  const Workspace w("import");
  const auto r = w.touchstone("import " + files + "arm.urdf --joint j2=0.5 -o scene.json");
  INFO(r.err);
  REQUIRE(r.code == 0);
  CHECK(has(r.out, "6, 5 joints"));
  CHECK(has(r.out, "no SRDF says which pairs to check"));
  CHECK(widest_line(r.out) <= 80);
  const Json scene = Json::parse(read_all(w.dir / "scene.json"));
  CHECK(scene["bodies"].size() == 6);
  CHECK(scene["bodies"][1]["name"] == "shoulder");
  CHECK_FALSE(scene["ignored"].empty());
  const auto stored = w.touchstone("replay scene.json --engines core --json");
  const auto direct = w.touchstone("replay " + files + "arm.urdf --joint j2=0.5 --engines core --json");
  REQUIRE(stored.code == 0);
  REQUIRE(direct.code == 0);
  CHECK(Json::parse(stored.out)[0]["queries"][0]["referee"] ==
        Json::parse(direct.out)[0]["queries"][0]["referee"]);
  CHECK(w.touchstone("view " + files + "arm.urdf --broad --json").code == 0);
}

TEST_CASE("a trajectory is a script, and filtered pairs are not asked", "[cli][import]") {
  const Workspace w("import");
  w.write("t.csv", "time,j2,slide\n0,0,0\n1,1.2,0.1\n2,-1.9,0\n");
  const auto r = w.touchstone("replay " + files + "arm.urdf --trajectory t.csv --engines core --json");
  INFO(r.err);
  REQUIRE(r.code == 0);
  const Json query = Json::parse(r.out)[0]["queries"][0];
  REQUIRE(query["question"] == "candidates");
  REQUIRE(query["referee"]["overlapping_pairs"].size() == 3);
  // Links that a joint connects overlap in this arm, and are filtered.
  for (const Json& step : query["referee"]["overlapping_pairs"])
    for (const Json& pair : step) CHECK(pair[1].get<int>() - pair[0].get<int>() > 1);
}

TEST_CASE("what cannot be imported ends with exit code 2, file and line", "[cli][import]") {
  const Workspace w("import");
  w.write("bad.urdf",
          "<robot name='r'>\n<link name='a'>\n<collision><geometry><torus/></geometry></collision>\n"
          "<collision><geometry><sphere radius='1'/></geometry></collision></link></robot>");
  const auto strict = w.touchstone("import bad.urdf");
  CHECK(strict.code == 2);
  CHECK(has(strict.err, "bad.urdf:3: <torus>"));
  const auto lenient = w.touchstone("import bad.urdf --lenient");
  CHECK(lenient.code == 0);
  CHECK(has(lenient.err, "1 element left out"));
  CHECK(has(lenient.err, "bad.urdf:3"));
  CHECK(w.touchstone("import scene.json").code == 2);
  const auto misplaced = w.touchstone("replay drop --joint a=1");
  CHECK(misplaced.code == 2);
  CHECK(has(misplaced.err, "is not a robot"));
}

TEST_CASE("assess gives the same answers for any number of jobs, and the core is right", "[cli][import]") {
  const Workspace w("assess");
  const std::string command = "assess " + files + "arm.urdf --samples 30 --engines core --seed 3 ";
  const auto one = w.touchstone(command + "--jobs 1 --json"),
             three = w.touchstone(command + "--jobs 3 --json");
  INFO(one.err);
  REQUIRE(one.code == 0);
  REQUIRE(three.code == 0);
  CHECK(reproducible(one.out) == reproducible(three.out));
  const Json j = Json::parse(one.out);
  CHECK(j["asked"].get<int>() > 30);
  CHECK(j["overlapping"].get<int>() > 0);
  CHECK(j["apart"].get<int>() > 0);
  CHECK(j["engines"][0]["padding"] == 0);
  const auto other = w.touchstone("assess " + files + "arm.urdf --samples 30 --engines core --seed 4 --json");
  CHECK_FALSE(reproducible(other.out) == reproducible(one.out));
}

TEST_CASE("assess shows an engine that misses collisions, and says what finds them", "[cli][import]") {
  const Workspace w("assess");
  w.write("table.urdf",
          "<robot name='table'><link name='top'><collision><origin xyz='0.4 0 0.3'/><geometry>"
          "<box size='0.6 1 0.05'/></geometry></collision></link></robot>");
  const auto r = w.touchstone("assess " + files +
                              "arm.urdf --world table.urdf --samples 30 --subject core --engines core," +
                              mutants + "overlap_one_order_denied --json");
  INFO(r.err);
  REQUIRE(r.code == 0);
  const Json j = Json::parse(r.out);
  REQUIRE(j["engines"].size() == 2);
  CHECK(j["world"] == "table.urdf");
  CHECK(j["engines"][1]["questions"]["overlap"]["missed"].get<int>() > 0);
  CHECK(j["advice"][0]["engine"] == "core");
  CHECK(j["advice"][1]["by_distance"] == true);
  const auto liar = w.touchstone("assess " + files + "arm.urdf --samples 30 --engines " + mutants +
                                 "overlap_one_order_denied");
  CHECK(liar.code == 1);
  // The last line names an engine that the test chose.
  CHECK(widest_line(liar.out.substr(0, liar.out.find("\nexit code"))) <= 80);
  CHECK(has(liar.out, "by dist"));
}

TEST_CASE("the advice is the least padding with which no collision is missed", "[import]") {
  fuzz::Assessment a;
  a.asked = 10;
  a.overlapping = 4;
  const auto engine = [&](const std::string& name, std::uint64_t missed, double padding,
                          std::uint64_t answered) {
    fuzz::AssessedEngine e;
    e.name = name;
    fuzz::Tally& t = e.tallies[Question::overlap];
    t.outcomes[static_cast<std::size_t>(Outcome::answered)] = answered;
    t.missed = missed;
    e.padding = padding;
    a.engines.push_back(e);
  };
  engine("thick", 2, 0.005, 10);
  engine("thin", 1, 0.001, 10);
  engine("partial", 0, 0, 9);
  engine("mute", 1, 0, 10);
  a.engines.back().silent = 1;
  auto advice = fuzz::advice_on(a);
  REQUIRE(advice.size() == 2);
  CHECK(advice[0].engine == "thin");
  CHECK(advice[0].padding == 0.001);
  const std::string text = reports::assessment_text(a);
  CHECK(has(text, "thin with a padding of 1 mm"));
  CHECK(has(text, "unknown"));
  engine("sound", 0, 0, 10);
  CHECK(fuzz::advice_on(a)[0].engine == "sound");
  a.overlapping = 0;
  CHECK(has(reports::assessment_text(a), "Nothing that was asked collides"));
}
