// touchstone answer: the same truth from every form of input, rulings on stated answers, and what it refuses.
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/workspace.h"

using nlohmann::json;
using touchstone::test::Run;
using touchstone::test::Workspace;

namespace {

void check_columns(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(line.size() <= 80);
  }
}

std::vector<json> lines_of(const Run& r) {
  std::vector<json> all;
  std::istringstream lines(r.out);
  for (std::string line; std::getline(lines, line);) all.push_back(touchstone::test::parsed<json>(line));
  return all;
}

// A bracket of the number that is a few roundings wide.
bool is_about(const json& gap, double x) {
  return gap[0] <= x && x <= gap[1] && gap[1].get<double>() - gap[0].get<double>() <= 0x1p-48;
}

// Without what depends on the clock.
json timeless(json j) {
  j.erase("nanoseconds");
  return j;
}

}  // namespace

TEST_CASE("two bodies on the command line are answered with certificates", "[answer]") {
  const Workspace w("answer-text");
  const Run r = w.touchstone("answer 'box 1 1 1' 'cylinder 0.5 2 at 0 0 3.5 rot 0 0 1 30deg move 0 0 -1'");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  for (const char* line : {"  verdict     disjoint", "  signed gap  [", "  normal      (0, 0, 1) from A to B",
                           "  witness A ", "  impact      first contact at t in [",
                           "  proof       plane d.x = ", "  certified   yes\n", "  time "}) {
    INFO(line);
    CHECK(r.out.find(line) != std::string::npos);
  }
  check_columns(r.out);
  const Run deep = w.touchstone("answer 'box 1 1 1' 'box 0.5 0.5 0.5'");
  CHECK(deep.code == 0);
  CHECK(deep.out.find("  depth       [1.4999") != std::string::npos);
  CHECK(deep.out.find("one of 6 that") != std::string::npos);
  check_columns(deep.out);
  CHECK(deep.out.find("  gradient    one of 24 corners; by translations, by rotations of B:") !=
        std::string::npos);
  const Run ball = w.touchstone("answer 'box 1 1 1' 'sphere 0.5 at 0 0.25 2'");
  CHECK(ball.out.find("  gradient    unique; by translations, by rotations of B:\n"
                      "              (0, 0, 1) (0, 0, 0)\n") != std::string::npos);
  const Run help = w.touchstone("answer --help", "TOUCHSTONE_LAUNCHER=./touchstone");
  CHECK(help.out.find("rounded_box half_extents(3) radius") != std::string::npos);
  check_columns(help.out);
}

TEST_CASE("a body may be padded, in words or as a shape of its own", "[answer]") {
  const Workspace w("answer-padding");
  const auto gap = [&](const std::string& a, const std::string& b) {
    const Run r = w.touchstone("answer --json '" + a + "' '" + b + "'");
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    const json j = lines_of(r).at(0);
    CHECK(j.at("certified") == true);
    return j.at("gap").at(0).get<double>();
  };
  // The rim at (0.5, 0, 1), and a point at distance 1 from it.
  CHECK(gap("cylinder 0.5 1 pad 0.25", "sphere 0.25 at 1.1 0 1.8") == Approx(0.5));
  CHECK(gap("padded_cylinder 0.5 1 0.25", "sphere 0 at 1.1 0 1.8 pad 0.25") == Approx(0.5));
  CHECK(gap("padded_hull 0 0 0 1 0 0 0 1 0 0 0 1 0.25", "sphere 0.5 at -2 0.25 0.25") == Approx(1.25));
  CHECK(gap("hull 0 0 0 1 0 0 0 1 0 0 0 1 pad 0.25", "box 1 1 1 at -2 0 0 pad 0.25") == Approx(0.5));
  CHECK(gap("half_space 0 0 2 1 pad 0.25", "sphere 0.5 at 0 0 2") == Approx(0.75));
  CHECK(w.touchstone("answer 'sphere 1 pad -1' 'sphere 1'").code == 2);
  CHECK(w.touchstone("answer 'sphere 1 pad' 'sphere 1'").code == 2);
  CHECK(w.touchstone("answer 'sphere 1 pad 1 pad 2' 'sphere 1'").code == 2);
  CHECK(w.touchstone("answer 'padded_hull 0 0 0 1 0 0 0 1 0' 'sphere 1'").code == 2);
}

TEST_CASE("points inside round bodies prove a gap less the radii, and the proof says so", "[answer]") {
  const Workspace w("answer-radii");
  const Run round = w.touchstone("answer 'box 1 1 1' 'sphere 1 at 3 0 0'");
  CHECK(round.out.find("by (1, 0, 0) and (3, 0, 0), less the") != std::string::npos);
  CHECK(w.touchstone("answer 'box 1 1 1' 'box 1 1 1 at 3 0 0'").out.find("less the") == std::string::npos);
}

TEST_CASE("whether bodies are within a margin is decided exactly, and from a scene's own margin",
          "[answer]") {
  const Workspace w("answer-within");
  const std::string corners = "answer --json 'box 1 1 1' 'box 1 1 1 at 2.375 2.5 0' --within ";
  const auto within = [&](const std::string& command) {
    const Run r = w.touchstone(command);
    INFO(command << r.out << r.err);
    CHECK(r.code == 0);
    return lines_of(r).at(0).at("within");
  };
  CHECK(within(corners + "0.625").at("verdict") == "within");
  CHECK(within(corners + "0.62499999999999989").at("verdict") == "beyond");
  const json clear = within(corners + "1");
  CHECK(clear.at("verdict") == "within");
  CHECK(clear.at("certified") == true);
  CHECK(within("answer --json 'sphere 1' 'sphere 1 at 1.5 0 0' --within -0.25").at("verdict") == "within");
  CHECK(within("answer --json 'sphere 1' 'sphere 1 at 1.5 0 0' --within -0.75").at("verdict") == "beyond");
  w.write("scene.json", R"({"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 1}],
    "bodies": [{"shape": 0}, {"shape": 0, "pose": {"translation": [3, 0, 0]}}], "margin": 1})");
  CHECK(within("answer --json scene.json").at("margin") == 1.0);
  const Run text = w.touchstone("answer 'box 1 1 1' 'box 1 1 1 at 2.375 2.5 0' --within 0.625");
  CHECK(text.out.find("  within      yes, the gap is at most 0.625") != std::string::npos);
  check_columns(text.out);
  CHECK(w.touchstone("answer 'sphere 1' 'sphere 1' --within nan").code == 2);
  CHECK(lines_of(w.touchstone("answer --json 'sphere 1' 'sphere 1 at 3 0 0'"))[0].contains("within") ==
        false);
}

TEST_CASE("a stated bound or gradient is judged as what it claims to be", "[answer]") {
  const Workspace w("answer-bounds");
  const auto code = [&](const std::string& stated) {
    w.write("stated.json", stated);
    return w.touchstone("answer 'sphere 1' 'sphere 1 at 3 0 0' --answers stated.json").code;
  };
  CHECK(code(R"({"lower_bound": 0.5})") == 0);
  CHECK(code(R"({"lower_bound": 1.5})") == 1);
  CHECK(code(R"({"lower_bound": 0.5, "upper_bound": 1.5})") == 0);
  CHECK(code(R"({"upper_bound": 0.5})") == 1);
  CHECK(code(R"({"normal": [1, 0, 0], "moment": [0, 0, 0], "unique_gradient": true})") == 0);
  CHECK(code(R"({"normal": [1, 0, 0], "moment": [0, 0, 1]})") == 1);
  CHECK(code(R"({"unique_gradient": false})") == 1);
}

TEST_CASE("a turn by a right angle is exact", "[answer]") {
  const Workspace w("answer-right-angle");
  for (const std::string turn : {"90deg", "-270deg", "450deg"}) {
    const auto j =
        lines_of(w.touchstone("answer --json 'box 1 2 3' 'box 1 2 3 at 3 0 0 rot 0 0 2 " + turn + "'"));
    REQUIRE(j.size() == 1);
    CHECK(j[0]["verdict"] == "overlap");  // 1 + 2 = 3: they touch
    CHECK(is_about(j[0]["gap"], 0.0));
  }
  const auto half =
      lines_of(w.touchstone("answer --json 'box 1 2 3' 'hull 0 0 0 1 0 0 at 3 0 0 rot 0 0 1 180deg'"));
  CHECK(is_about(half[0]["gap"], 1.0));
}

TEST_CASE("text, JSON lines, plain numbers and a scene file give the same answer", "[answer]") {
  const Workspace w("answer-forms");
  const auto text = lines_of(w.touchstone("answer --json 'box 1 1 1' 'sphere 0.5 at 0 0 1.75 move 0 0 -1'"));
  REQUIRE(text.size() == 1);
  CHECK(text[0]["certified"] == true);
  CHECK(text[0]["time_of_impact"]["certified"] == true);
  w.write("lines.jsonl",
          R"({"a": "box 1 1 1", "b": "sphere 0.5 at 0 0 1.75 move 0 0 -1"})"
          "\n\n"
          R"({"a": {"type": "box", "numbers": [1, 1, 1]}, "b": {"type": "sphere", "numbers": [0.5],
             "pose": [0, 0, 1.75, 0, 0, 0, 1], "motion": [0, 0, -1, 0, 0, 0]}})");
  std::string one_line = touchstone::test::read_all(w.dir / "lines.jsonl");
  for (std::size_t at; (at = one_line.find("\n             ")) != std::string::npos;)
    one_line.replace(at, 14, " ");
  w.write("lines.jsonl", one_line);
  const auto lines = lines_of(w.touchstone("answer --json lines.jsonl"));
  REQUIRE(lines.size() == 2);
  const auto piped = lines_of(w.run("cat lines.jsonl | " TS_BINARY_DIR "/bin/touchstone answer --json -"));
  REQUIRE(piped.size() == 2);
  w.write("scene.json", text[0]["scene"].dump());
  const auto scene = lines_of(w.touchstone("answer --json scene.json"));
  REQUIRE(scene.size() == 1);
  for (const json& j : {lines[0], lines[1], piped[0], scene[0]}) CHECK(timeless(j) == timeless(text[0]));
}

TEST_CASE("every pair of a scene is answered, or the one that is chosen", "[answer]") {
  const Workspace w("answer-scene");
  w.write("scene.json", R"({"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 1}],
    "bodies": [{"shape": 0, "name": "left"}, {"shape": 0, "pose": {"translation": [3, 0, 0]}},
               {"shape": 0, "pose": {"translation": [7, 0, 0]}}], "ignored": [[1, 2]]})");
  const auto all = lines_of(w.touchstone("answer --json scene.json"));
  REQUIRE(all.size() == 2);
  CHECK(is_about(all[0]["gap"], 1.0));
  CHECK(is_about(all[1]["gap"], 5.0));
  const auto one = lines_of(w.touchstone("answer --json scene.json --pair 2 1"));
  REQUIRE(one.size() == 1);
  CHECK(is_about(one[0]["gap"], 2.0));
  CHECK(one[0]["normal"] == json({-1.0, 0.0, 0.0}));
  CHECK(w.touchstone("answer scene.json").out.find("0 sphere left, 1 sphere\n") != std::string::npos);
}

TEST_CASE("stated answers are right, or wrong with a reason", "[answer]") {
  const Workspace w("answer-stated");
  const auto ruling = [&](const std::string& a, const std::string& b, const std::string& stated,
                          const std::string& more = "") {
    w.write("stated.json", stated);
    const Run r = w.touchstone("answer --json '" + a + "' '" + b + "' --answers stated.json " + more);
    INFO(stated << r.out << r.err);
    const auto lines = lines_of(r);
    REQUIRE(lines.size() == 1);
    const std::string said = lines[0]["stated"]["ruling"];
    CHECK(r.code == (said == "wrong" ? 1 : said == "right" ? 0 : 3));
    return lines[0]["stated"]["faults"].empty() ? said
                                                : lines[0]["stated"]["faults"][0]["fault"].get<std::string>();
  };
  const std::string box = "box 1 1 1", apart = "sphere 0.5 at 0 0 1.75", deep = "sphere 0.5 at 0 0 1.25";
  CHECK(ruling(box, apart, R"({"distance": 0.25, "normal": [0, 0, 1]})") == "right");
  CHECK(ruling(box, apart, R"({"distance": 0.0, "normal": [0, 0, 1]})") == "distance_off");
  CHECK(ruling(box, apart, R"({"distance": 0.25, "normal": [0, 0, -1]})") == "not_minimal");
  CHECK(ruling(box, apart, R"({"distance": 0.25, "normal": [0, 0.6, 0.8]})") == "not_minimal");
  CHECK(ruling(box, apart, R"({"distance": 0.25, "normal": [0, 0, 2]})") == "normal_not_unit");
  CHECK(ruling(box, apart, R"({"depth": -0.25, "normal": [0, 0, 1]})") == "right");
  CHECK(ruling(box, apart, R"({"depth": -0.3, "normal": [0, 0, 1]})") == "infeasible");
  CHECK(ruling(box, apart, R"({"overlap": false})") == "right");
  CHECK(ruling(box, apart, R"({"overlap": true})") == "ghost");
  CHECK(ruling(box, apart, R"({"depth": 0.1})") == "ghost");
  CHECK(ruling(box, apart, R"({"distance": "NaN"})") == "no_number");
  CHECK(ruling(box, apart, R"({"witness": [[0, 0, 1], [0, 0, 1.25]]})") == "right");
  CHECK(ruling(box, apart, R"({"witness": [0, 0, 1, 0, 0, 1.5]})") == "witness_off");
  CHECK(ruling(box, apart, R"({"distance": 0.250001})") == "distance_off");
  CHECK(ruling(box, apart, R"({"distance": 0.250001})", "--error 1e-5") == "right");
  CHECK(ruling(box, apart, R"({"distance": 0.250001})", "--single") == "right");
  CHECK(ruling(box, deep, R"({"overlap": true, "depth": 0.25, "normal": [0, 0, 1],
                              "points": [{"position": [0, 0, 0.9], "depth": 0.25}]})") == "right");
  CHECK(ruling(box, deep, R"({"depth": 0.25, "normal": [1, 0, 0]})") == "not_minimal");
  CHECK(ruling(box, deep, R"({"depth": 0.2, "normal": [0, 0, 1]})") == "infeasible");
  CHECK(ruling(box, deep, R"({"depth": 0.3, "normal": [0, 0, 1]})") == "depth_excess");
  CHECK(ruling(box, deep, R"({"distance": -0.25, "normal": [0, 0, 1]})") == "right");
  CHECK(ruling(box, deep, R"({"distance": -0.25, "normal": [1, 0, 0]})") == "not_minimal");
  CHECK(ruling(box, deep, R"({"overlap": false})") == "missed");
  CHECK(ruling(box, deep, R"({"distance": 0.25})") == "missed");
  CHECK(ruling(box, apart + " move 0 0 -1", R"({"time_of_impact": 0.25})") == "right");
  CHECK(ruling(box, apart + " move 0 0 -1", R"({"time_of_impact": 0.5})") == "late");
  CHECK(ruling(box, apart + " move 0 0 -1", R"({"time_of_impact": 0.2})") == "early");
  CHECK(ruling(box, apart + " move 0 0 -1", R"({"time_of_impact": null})") == "missed");
  CHECK(ruling(box, apart + " move 0 0 1", R"({"time_of_impact": null, "overlap": null})") == "right");
  CHECK(ruling(box, apart, R"({"points": [{"position": [0, 0, 1]}]})") == "not judged");
  CHECK(ruling("half_space 0 0 1 0", "sphere 1 at 0 0 3", R"({"distance": 2, "normal": [0, 0, 1]})") ==
        "right");
  w.write("stated.json", R"({"distance": 0.0, "normal": [0, 0, 1]})");
  const Run text = w.touchstone("answer '" + box + "' '" + apart + "' --answers stated.json");
  CHECK(text.code == 1);
  CHECK(text.out.find(
            "  stated      wrong\n              distance_off: says 0; the signed distance is 0.25\n") !=
        std::string::npos);
}

TEST_CASE("answers go with their pairs in order, and must be as many", "[answer]") {
  const Workspace w("answer-many");
  w.write("pairs.jsonl",
          "{\"a\": \"sphere 1\", \"b\": \"sphere 1 at 3 0 0\"}\n"
          "{\"a\": \"sphere 1\", \"b\": \"sphere 1 at 4 0 0\"}\n");
  w.write("stated.jsonl", "{\"distance\": 1}\n{\"distance\": 1}\n");
  const Run r = w.touchstone("answer pairs.jsonl --answers stated.jsonl");
  CHECK(r.code == 1);
  CHECK(r.out.find("2 answers stated: 1 right, 1 wrong\n") != std::string::npos);
  w.write("array.json", R"([{"distance": 1}, {"distance": 2}])");
  CHECK(w.touchstone("answer pairs.jsonl --answers array.json").code == 0);
  w.write("few.json", R"([{"distance": 1}])");
  CHECK(w.touchstone("answer pairs.jsonl --answers few.json").code == 2);
  w.write("more.json", R"([{"distance": 1}, {"distance": 2}, {"distance": 2}])");
  CHECK(w.touchstone("answer pairs.jsonl --answers more.json").code == 2);
  w.write("own.jsonl",
          "{\"a\": \"sphere 1\", \"b\": \"sphere 1 at 3 0 0\", \"answer\": {\"distance\": 1}}\n");
  CHECK(w.touchstone("answer own.jsonl").code == 0);
  CHECK(w.touchstone("answer own.jsonl --answers few.json").code == 2);
}

TEST_CASE("bad input is refused with place and reason", "[answer]") {
  const Workspace w("answer-refused");
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Run r = w.touchstone("answer " + arguments);
    INFO(arguments << r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find(words) != std::string::npos);
  };
  refused("'bax 1 1 1' 'sphere 1'", "first body: unknown shape `bax`; did you mean box?");
  refused("'box 1 1' 'sphere 1'", "first body: `box` ends too early");
  refused("'box 1 1 1 1' 'sphere 1'", "first body: has one number too many");
  refused("'box 1 1 one' 'sphere 1'", "where `one` stands");
  refused("'sphere 1' 'sphere 1 rot 0 0 1 30'", "second body: `rot` needs an angle with its unit");
  refused("'sphere 1' 'sphere 1 rot 0 0 0 30deg'", "axis that is not zero");
  refused("'sphere 1' 'sphere 1 at 0 0 0 at 1 1 1'", "given twice");
  refused("'sphere 1' 'sphere 1 to 0 0 0'", "unknown word `to`");
  refused("'sphere 1' 'sphere -1'", "radius");
  refused("'sphere 1' 'mesh 1 2 3'", "as JSON");
  refused("'sphere 1' ''", "is empty");
  refused("'sphere 1' 'sphere 1 quat 0 0 0 0'", "rotation");
  refused("'half_space 0 0 1 0 move 0 0 1' 'sphere 1'", "motion");
  refused("absent.json", "absent.json");
  refused("absent.jsonl", "no such file");
  refused("'sphere 1' 'sphere 1' --pair 0 1", "--pair");
  w.write("bad.jsonl", "{\"a\": \"sphere 1\", \"b\": \"sphere 1\"}\n{\"a\": \"sphere 1\"}\n");
  refused("bad.jsonl", "bad.jsonl:2: field \"b\" is missing");
  w.write("cut.jsonl", "{\"a\": \"sphere 1\", \"b\"");
  refused("cut.jsonl", "cut.jsonl:1");
  w.write("unknown.jsonl", "{\"a\": \"sphere 1\", \"b\": \"sphere 1\", \"c\": 1}");
  refused("unknown.jsonl", "unknown field");
  w.write("field.jsonl", R"({"a": {"shape": {"type": "box"}}, "b": "sphere 1"})");
  refused("field.jsonl", "half_extents");
  w.write("pose.jsonl", R"({"a": {"type": "sphere", "numbers": [1], "pose": [0, 0]}, "b": "sphere 1"})");
  refused("pose.jsonl", "pose");
  w.write("empty.jsonl", "\n");
  refused("empty.jsonl", "is empty");
  w.write("nothing.json", "{}");
  refused("'sphere 1' 'sphere 1' --answers nothing.json", "nothing.json: states nothing");
  w.write("typo.json", "{\"distanze\": 1}");
  refused("'sphere 1' 'sphere 1' --answers typo.json", "unknown field");
}
