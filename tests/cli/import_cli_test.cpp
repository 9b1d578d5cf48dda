// `touchstone import`, commands that are given a robot in place of a scene, and `assess`.
#include <nlohmann/json.hpp>
#include <string>

#include "reports/text/record_text.h"
#include "reports/text/text.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using touchstone::test::read_all;
using touchstone::test::Workspace;

namespace {

using Json = nlohmann::json;
using namespace touchstone;

const std::string files = TS_SOURCE_DIR "/tests/scenarios/import/files/";
const std::string mutants = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// In columns: bytes that continue a character do not count.
std::size_t widest_line(const std::string& text) {
  std::size_t most = 0, here = 0;
  for (const char c : text) {
    here = c == '\n' ? 0 : here + ((static_cast<unsigned char>(c) & 0xc0U) != 0x80U);
    most = std::max(most, here);
  }
  return most;
}

// With the line breaks of wrapped paragraphs undone.
std::string unwrapped(std::string text) {
  for (std::size_t at = 0; (at = text.find("\n  ", at)) != std::string::npos;) text.replace(at, 3, " ");
  return text;
}

// Without times, and without the order of advice that depends on them.
Json reproducible(const std::string& text) {
  Json j = test::parsed<Json>(text);
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
  const Json scene = test::parsed<Json>(read_all(w.dir / "scene.json"));
  CHECK(scene["bodies"].size() == 6);
  CHECK(scene["bodies"][1]["name"] == "shoulder");
  CHECK_FALSE(scene["ignored"].empty());
  const auto stored = w.touchstone("replay scene.json --engines core --json");
  const auto direct = w.touchstone("replay " + files + "arm.urdf --joint j2=0.5 --engines core --json");
  REQUIRE(stored.code == 0);
  REQUIRE(direct.code == 0);
  CHECK(test::parsed<Json>(stored.out)[0]["queries"][0]["referee"] ==
        test::parsed<Json>(direct.out)[0]["queries"][0]["referee"]);
  CHECK(w.touchstone("view " + files + "arm.urdf --broad --json").code == 0);
}

TEST_CASE("--padding adds to every shape, and to meshes only as hulls", "[cli][import]") {
  const Workspace w("import-padding");
  const auto shapes = [&](const std::string& options) {
    REQUIRE(w.touchstone("import " + files + "arm.urdf -o scene.json " + options).code == 0);
    return test::parsed<Json>(read_all(w.dir / "scene.json"))["shapes"];
  };
  const Json plain = shapes(""), padded = shapes("--padding 0.01");
  REQUIRE(plain.size() == padded.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const std::string type = plain[i]["type"];
    INFO(type);
    if (type == "box") CHECK(padded[i]["type"] == "rounded_box");
    if (type == "box") CHECK(padded[i]["radius"] == 0.01);
    if (type == "cylinder") CHECK(padded[i]["padding"] == 0.01);
    if (type == "sphere") CHECK(padded[i]["radius"] == plain[i]["radius"].get<double>() + 0.01);
    compared += type == "box" || type == "cylinder" || type == "sphere";
  }
  CHECK(compared > 2);
  w.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto mesh = w.touchstone("import mesh.obj --padding 0.01");
  CHECK(mesh.code == 2);
  CHECK(has(mesh.err, "--convex replaces meshes by their hulls"));
  CHECK(w.touchstone("import mesh.obj --padding 0.01 --convex").code == 0);
  CHECK(w.touchstone("import mesh.obj --padding -1").code == 2);
  CHECK(w.touchstone("import mesh.obj --convex --padding nan").code == 2);
}

TEST_CASE("a trajectory is a script, and filtered pairs are not asked", "[cli][import]") {
  const Workspace w("import");
  w.write("t.csv", "time,j2,slide\n0,0,0\n1,1.2,0.1\n2,-1.9,0\n");
  const auto r = w.touchstone("replay " + files + "arm.urdf --trajectory t.csv --engines core --json");
  INFO(r.err);
  REQUIRE(r.code == 0);
  const Json query = test::parsed<Json>(r.out)[0]["queries"][0];
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
  const Json j = test::parsed<Json>(one.out);
  CHECK(j["asked"].get<int>() > 30);
  CHECK(j["overlapping"].get<int>() > 0);
  CHECK(j["apart"].get<int>() > 0);
  CHECK(j["engines"][0]["padding"] == 0);
  const auto other = w.touchstone("assess " + files + "arm.urdf --samples 30 --engines core --seed 4 --json");
  CHECK_FALSE(reproducible(other.out) == reproducible(one.out));
}

TEST_CASE("assess on an arm of seven joints at a table", "[cli][import]") {
  const Workspace w("assess");
  const std::string cell = files + "cell/";
  const auto r =
      w.touchstone("assess " + cell + "arm7.urdf --srdf " + cell + "arm7.srdf --package-path " + files +
                   " --world " + cell + "table15.scene --samples 20 --engines core,bullet-f64-query");
  INFO(r.out + r.err);
  CHECK(r.code == 0);
  CHECK(has(r.out, "arm7 in table15.scene: 20 configurations"));
  CHECK(has(unwrapped(r.out), "238 pairs can collide"));
  CHECK(has(unwrapped(r.out), "No answer by kinds of shapes: bullet-f64-query: mesh-mesh"));
  CHECK(widest_line(r.out) < 80);
}

TEST_CASE("assess that is interrupted prints what it has and fails", "[cli][import]") {
  const Workspace w("assess");
  // More configurations than any machine asks about in this time.
  const auto r = w.run("timeout --preserve-status -s INT 3 " TS_BINARY_DIR "/bin/touchstone assess " + files +
                       "arm.urdf --samples 300000 --pairs 10000000 --engines core");
  INFO(r.out << r.err);
  CHECK(r.code == 3);
  CHECK(has(unwrapped(r.out), "Interrupted before all pairs were asked."));
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
  const Json j = test::parsed<Json>(r.out);
  REQUIRE(j["engines"].size() == 2);
  CHECK(j["world"] == "table.urdf");
  CHECK(j["engines"][1]["questions"]["overlap"]["missed"].get<int>() > 0);
  const Json& tests = j["advice"]["collision_test"];
  CHECK(tests[0]["engine"] == "core");
  CHECK(tests[1]["by_distance"] == true);
  CHECK(j["engines"][1]["denied_collisions"] >= j["engines"][1]["missed"]);
  CHECK(j["engines"][1]["missed"].get<int>() > 0);
  CHECK(j["engines"][1]["samples"][0]["kind"] == "missed");
  const auto liar = w.touchstone("assess " + files + "arm.urdf --samples 30 --engines " + mutants +
                                 "overlap_one_order_denied");
  CHECK(liar.code == 1);
  CHECK(widest_line(liar.out) <= 80);
  CHECK(has(unwrapped(liar.out), "distance of 0 finds them"));
}

namespace {

// An assessment of ten pairs, of which four collide.
struct Sample {
  fuzz::Assessment a;
  Sample() {
    a.asked = 10;
    a.overlapping = 4;
    a.apart = 6;
    a.error = 1e-4;
  }
  fuzz::AssessedEngine& add(const std::string& name, std::uint64_t answered, std::uint64_t denied = 0,
                            double padding = 0) {
    fuzz::AssessedEngine& e = a.engines.emplace_back();
    e.name = name;
    e.tallies[Question::overlap].outcomes[static_cast<std::size_t>(Outcome::answered)] = answered;
    e.denied = denied;
    e.padding = padding;
    return e;
  }
  fuzz::AssessedEngine& add_distances(const std::string& name, double error, std::int64_t ns) {
    fuzz::AssessedEngine& e = add(name, 10);
    e.distances_apart = 6;
    e.worst_distance_error = error;
    e.tallies[Question::distance].outcomes[static_cast<std::size_t>(Outcome::answered)] = 10;
    e.tallies[Question::distance].time.add(ns);
    return e;
  }
};

}  // namespace

TEST_CASE("for collision tests, the advice is the least padding with which none is missed", "[import]") {
  Sample s;
  s.add("thick", 10, 2, 0.005);
  s.add("thin", 10, 1, 0.001);
  s.add("partial", 9);
  s.add("mute", 10, 1).silent = 1;
  const auto advice = fuzz::test_advice(s.a);
  REQUIRE(advice.size() == 2);
  CHECK(advice[0].engine == "thin");
  CHECK(advice[0].padding == 0.001);
  const std::string text = reports::assessment_text(s.a);
  CHECK(has(unwrapped(text), "thin misses no collision that was asked if bodies at most 1 mm apart"));
  CHECK(has(text, "padding \"unknown\""));
  CHECK(widest_line(text) < 80);
  s.add("sound", 10);
  CHECK(fuzz::test_advice(s.a)[0].engine == "sound");
  s.a.overlapping = 0;
  CHECK(has(unwrapped(reports::assessment_text(s.a)), "nothing that was asked collides"));
}

TEST_CASE("for distances, the advice is the fastest engine that is accurate enough and answers all",
          "[import]") {
  Sample s;
  s.add("tests-only", 10);
  s.add_distances("coarse", 2e-3, 100);
  s.add_distances("slow", 1e-9, 5000);
  s.add_distances("fair", 5e-5, 700);
  s.add_distances("partial", 0, 50).distances_apart = 5;
  auto advice = fuzz::distance_advice(s.a);
  REQUIRE(advice.size() == 3);
  CHECK(advice[0].engine == "fair");
  CHECK(advice[1].engine == "slow");
  CHECK(advice[2].engine == "coarse");
  CHECK(has(unwrapped(reports::assessment_text(s.a)), "Distances: fair is the fastest"));
  s.a.error = 1e-12;
  advice = fuzz::distance_advice(s.a);
  CHECK(advice[0].engine == "slow");
  CHECK(has(unwrapped(reports::assessment_text(s.a)),
            "none has errors of at most <1e-6 mm; slow has the least"));
}

TEST_CASE("the core is not the advice, but beside it", "[import]") {
  Sample s;
  s.add_distances("core", 0, 10).is_own = true;
  s.add_distances("theirs", 1e-5, 900);
  const std::string text = reports::assessment_text(s.a);
  CHECK(has(unwrapped(text), "Distances: theirs is the fastest"));
  CHECK(has(unwrapped(text), "Touchstone's own core: core is the fastest"));
  CHECK(has(unwrapped(text), "docs/core-library.md"));
}

TEST_CASE("names of engines are never cut, and every line fits a terminal", "[import]") {
  Sample s;
  const std::string name(64, 'n');
  s.add(name, 10).unanswered["box-mesh"] = 3;
  s.add("bullet-f32-query-tuned", 10).unanswered["box-mesh"] = 3;
  const std::string text = reports::assessment_text(s.a);
  CHECK(has(text, "\n" + name + "\n"));
  CHECK(has(text, "bullet-f32-query-tuned "));
  CHECK(has(unwrapped(text), "box-mesh 3"));
  CHECK(widest_line(text) < 80);
}

TEST_CASE("times are stated with their unit", "[import]") {
  CHECK(reports::duration(830) == "830 ns");
  CHECK(reports::duration(999.6) == "1.0 µs");
  CHECK(reports::duration(12345) == "12.3 µs");
  CHECK(reports::duration(695e3) == "695 µs");
  CHECK(reports::duration(6.12e6) == "6.1 ms");
  CHECK(reports::duration(2.5e9) == "2.5 s");
}
