// A case as JSON: round trip, defaults, and refusals.
#include "scenarios/codec/case_codec.h"

#include <algorithm>

#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "scenarios/handmade/scenario.h"
#include "scenarios/value/moving_pairs.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

const std::string two_balls =
    R"({"touchstone_scene":1,"name":"two","shapes":[{"type":"sphere","radius":1}],"bodies":[{"shape":0},{"shape":0}]})";

std::string with(const std::string& fields) {
  return R"({"touchstone_case":1,"scene":)" + two_balls + fields + "}";
}

StoredCase read(const std::string& text) {
  return stored_case_from_json(parse_json(text, "f.json"), "f.json");
}

}  // namespace

TEST_CASE("every scenario with its expectation survives JSON and text", "[scenarios][codec]") {
  int checked = 0;
  for (const auto& s : scenarios::catalog()) {
    const StoredCase stored{s.make(), s.line, "by hand", s.expect};
    REQUIRE(stored_case_from_json(stored_case_to_json(stored)) == stored);
    REQUIRE(stored_case_from_json(parse_json(to_text(stored))) == stored);
    REQUIRE(case_from_json(case_to_json(stored.c)) == stored.c);
    REQUIRE(hash(case_from_json(case_to_json(stored.c)).scene) == hash(stored.c.scene));
    ++checked;
  }
  CHECK(checked >= 40);
}

TEST_CASE("a bare scene file becomes a case with the usual questions", "[scenarios][codec]") {
  const test::TempDir dir;
  const Case c = load_case(dir.write("a.json", two_balls));
  CHECK(c.id == "two");
  CHECK(c.queries ==
        std::vector<Query>{{Question::overlap, 0, 1}, {Question::distance, 0, 1}, {Question::contact, 0, 1}});
  Scene s = c.scene;
  s.name.clear();
  s.bodies[1].motion = Motion{};
  save_scene(s, dir.path() / "b.json");
  CHECK(load_case(dir.path() / "b.json").id == "b");
  CHECK(load_case(dir.path() / "b.json").queries.back() == Query{Question::time_of_impact, 0, 1});
  s.bodies.push_back(s.bodies[0]);
  CHECK(default_queries(s) ==
        std::vector<Query>{{Question::candidates, 0, 1}, {Question::scene_contacts, 0, 1}});
  s.bodies.resize(2);
  s.script = {{Step::Op::insert, 0, std::nullopt}, {}};
  CHECK(default_queries(s).back().question == Question::candidates);
}

namespace {

// A box at the origin, a ball that flies through it, and a third body that is out of the way.
Scene ball_through_box() {
  Scene s;
  s.shapes = {Box{{1, 1, 1}}, Sphere{0.25}};
  s.bodies.resize(3);
  s.bodies[1].shape = s.bodies[2].shape = 1;
  s.bodies[1].pose.translation = {-5, 0.1, 0.2};
  s.bodies[1].motion = Motion{Vec3(10, 0, 0), Vec3::Zero()};
  s.bodies[2].pose.translation = {0, 8, 0};
  return s;
}

bool asks_impact(const std::vector<Query>& all, int a, int b) {
  return std::find(all.begin(), all.end(), Query{Question::time_of_impact, a, b}) != all.end();
}

}  // namespace

TEST_CASE("in a scene with motion only the moving pairs that may meet are asked", "[scenarios][codec]") {
  Scene s = ball_through_box();
  CHECK(moving_pairs(s) == std::vector<BodyPair>{{0, 1}});
  const auto asked = default_queries(s);
  CHECK(asks_impact(asked, 0, 1));
  CHECK(std::count(asked.begin(), asked.end(), Query{Question::swept_candidates, 0, 1}) == 1);
  CHECK(asked.size() == 4);
  CHECK(words_on_impacts_not_asked({"", "", s, asked}).empty());
  CHECK(words_on_impacts_not_asked({"", "", s, {{Question::candidates, 0, 1}}}).find("1 pair that") !=
        std::string::npos);
  // Direction and rotation matter; filtered pairs and pairs of bodies at rest are left out.
  s.bodies[1].motion->linear = {0, 10, 0};
  CHECK(moving_pairs(s).empty());
  s.bodies[1].pose.translation = {0, 0.1, 0.2};
  CHECK(moving_pairs(s) == std::vector<BodyPair>{{0, 1}, {1, 2}});
  s.ignored = {{0, 1}};
  CHECK(moving_pairs(s) == std::vector<BodyPair>{{1, 2}});
  s.bodies[1].motion = Motion{};
  CHECK(moving_pairs(s).empty());
  CHECK(default_queries(s).size() == 2);
  s.shapes[1] = Capsule{0.1, 9};
  s.bodies[1].motion->angular = {1, 0, 0};
  CHECK(moving_pairs(s) == std::vector<BodyPair>{{1, 2}});
}

TEST_CASE("of many moving pairs a fixed number is asked, and the number left out is reported",
          "[scenarios][codec]") {
  Scene s;
  s.shapes = {Sphere{1}};
  s.bodies.resize(20);
  for (Body& b : s.bodies) b.motion = Motion{Vec3(1, 0, 0), Vec3::Zero()};
  const auto asked = default_queries(s);
  CHECK(asked.size() == 3 + most_impacts_asked);
  CHECK(impacts_not_asked({"", "", s, asked}) == 190 - most_impacts_asked);
  CHECK(words_on_impacts_not_asked({"", "", s, asked}).find("126 pairs") != std::string::npos);
}

TEST_CASE("a case without questions gets the usual ones, one without id the file's name",
          "[scenarios][codec]") {
  const test::TempDir dir;
  CHECK(read(with("")).c.queries.size() == 3);
  CHECK(read(with(R"(,"queries":[])")).c.queries.empty());
  CHECK(load_case(dir.write("named.json", with(""))).id == "named");
}

TEST_CASE("faults of a case are reported with their place", "[scenarios][codec][bad-input]") {
  struct Bad {
    std::string text, place, reason;
  };
  const std::vector<Bad> list{
      {"[]", "f.json", "must be an object"},
      {"{}", "f.json", "\"touchstone_case\" is missing"},
      {R"({"touchstone_case":3,"scene":{}})", "f.json: touchstone_case", "version 3 is not known"},
      {R"({"touchstone_case":1})", "f.json", "\"scene\" is missing"},
      {R"({"touchstone_case":1,"scene":{}})", "f.json: scene", "\"touchstone_scene\" is missing"},
      {R"({"touchstone_case":1,"scene":{"touchstone_scene":1,"shapes":[{"type":"sphere","radius":-1}],"bodies":[]}})",
       "f.json: scene.shapes[0].radius", "negative"},
      {with(R"(,"answer":42)"), "f.json", "unknown field \"answer\""},
      {with(R"(,"id":42)"), "f.json: id", "must be a string"},
      {with(R"(,"queries":[{"question":"colour"}])"), "f.json: queries[0].question", "unknown question"},
      {with(R"(,"queries":[{"question":"overlap","a":0}])"), "f.json: queries[0]", "\"b\" is missing"},
      {with(R"(,"queries":[{"question":"overlap","a":0,"b":2}])"), "f.json: queries[0].b", "is not a body"},
      {with(R"(,"queries":[{"question":"overlap","a":1,"b":1}])"), "f.json: queries[0]", "must differ"},
      {with(R"(,"queries":[{"question":"candidates","a":0}])"), "f.json: queries[0]", "unknown field \"a\""},
      {with(R"(,"queries":[{"question":"ray","a":0,"b":1}])"), "f.json: queries[0]", "a sphere of radius 0"},
      {R"({"touchstone_case":1,"scene":{"touchstone_scene":1,"shapes":[],"bodies":[],"margin":-1},"queries":[{"question":"candidates_within"}]})",
       "f.json: queries[0].question", "not negative"},
      {R"({"touchstone_case":1,"scene":{"touchstone_scene":1,"shapes":[],"bodies":[],"margin":"wide"}})",
       "f.json: scene.margin", "must be a number"},
      {with(R"(,"expect":{"gap":1})"), "f.json: expect.gap", "must be an object"},
      {with(R"(,"expect":{"gap":{"value":1,"tolerance":-1}})"), "f.json: expect.gap.tolerance", "negative"},
      {with(R"(,"expect":{"impact":{"hit":false,"time":1}})"), "f.json: expect.impact.time", "without a hit"},
      {with(R"(,"expect":{"box_pairs":-1})"), "f.json: expect.box_pairs", "negative"},
      {with(R"(,"expect":{"mood":"good"})"), "f.json: expect", "unknown field \"mood\""},
  };
  for (const Bad& bad : list) {
    const std::string what = refusal([&] { read(bad.text); });
    INFO(bad.text << "\n  message: " << what);
    CHECK(contains(what, bad.place + ": "));
    CHECK(contains(what, bad.reason));
  }
  CHECK(contains(refusal([] { scenarios::load_corpus("/no/such/directory"); }), "cannot be listed"));
}
