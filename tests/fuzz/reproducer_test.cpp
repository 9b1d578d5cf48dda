// The text of reproducers: one for every engine with a writer, every question and every fault.
#include "fuzz/reproduce/reproducer.h"

#include <string>
#include <vector>

#include "core/base/input_error.h"
#include "oracles/core/core_engine.h"
#include "tests/support/catch.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using namespace touchstone::fuzz;
using touchstone::test::Run;
using touchstone::test::Workspace;

namespace {

Case case_of(Question question, const Shape& a, const Shape& b) {
  Case c;
  c.scene.shapes = {a, b};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = {0.5, 0.25, 0.125};
  if (question == Question::time_of_impact) c.scene.bodies[1].motion = Motion{{-1, 0, 0}, {0, 0.5, 0}};
  c.queries = {is_pair_question(question) ? Query{question, 0, 1} : Query{question, -1, -1}};
  return c;
}

Finding finding_of(const std::string& engine, const Case& c, std::string_view fault) {
  const Question question = c.queries[0].question;
  Finding f;
  f.engine = engine;
  f.question = to_string(question);
  f.fault = fault;
  Evidence e;
  e.c = c;
  e.observation = make_core_engine()->run({&c, 1})[0].answers[0];
  e.a = 0;
  e.b = 1;
  e.step = question == Question::candidates ? 0 : -1;
  e.question = question;
  f.evidence = std::make_shared<const Evidence>(std::move(e));
  return f;
}

// A token that was not filled in looks like @NAME@.
bool has_open_token(const std::string& text) {
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at + 1)) {
    const std::size_t end = text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_", at + 1);
    if (end != std::string::npos && end > at + 1 && text[end] == '@') return true;
  }
  return false;
}

// From `begin` to the end of `end`.
std::string part_of(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin), to = text.find(end, from);
  REQUIRE(from != std::string::npos);
  REQUIRE(to != std::string::npos);
  return text.substr(from, to + end.size() - from);
}

// The program's own check of an impact, with answers given by hand instead of an engine's.
std::string asked_by_hand(const std::string& program) {
  return R"(#include <array>
#include <cmath>
#include <cstdio>
#include <vector>
using Vec = std::array<double, 3>;
)" + part_of(program, "struct Answer {", "\n};\n") +
         "namespace {\n" + part_of(program, "void print_impact", "}  // namespace") + R"(
int main() {
  Answer none, nan, at_half;
  nan.hit = at_half.hit = true;
  at_half.impact = 0.5;
  for (const Answer& x : {none, nan, at_half}) std::puts(check(x) ? "right" : "WRONG");
}
)";
}

}  // namespace

TEST_CASE("every engine with a writer has a program for every question and every fault", "[reproduce]") {
  const std::vector<std::string> engines{"fcl-libccd",
                                         "fcl-libccd-tuned",
                                         "fcl-indep",
                                         "fcl-indep-tuned",
                                         "bullet-f32-query",
                                         "bullet-f32-sim",
                                         "bullet-f64-query-tuned",
                                         "bullet-f64-sim",
                                         "libccd-gjk",
                                         "libccd-mpr-tuned",
                                         "ode",
                                         "fcl-naive",
                                         "fcl-sap",
                                         "fcl-spatial-hash",
                                         "fcl-dynamic-tree-array",
                                         "bullet-f64-dbvt",
                                         "bullet-f32-axis-sweep",
                                         "bullet-f32-simple",
                                         "ode-hash",
                                         "ode-sap",
                                         "dart",
                                         "dart-fcl",
                                         "dart-fcl-mesh",
                                         "dart-bullet",
                                         "dart-ode",
                                         "mujoco2"};
  const std::vector<Question> questions{Question::overlap,    Question::distance,
                                        Question::contact,    Question::time_of_impact,
                                        Question::candidates, Question::scene_contacts};
  const std::vector<std::pair<Shape, Shape>> pairs{{Box{{0.5, 0.5, 0.5}}, Sphere{0.5}},
                                                   {Capsule{0.5, 0.5}, Cylinder{0.5, 0.5}}};
  std::size_t written = 0;
  for (const Question question : questions)
    for (const auto& [a, b] : pairs) {
      const Case c = case_of(question, a, b);
      for (std::size_t i = 0; i < fault_names.size(); ++i) {
        const Finding base = finding_of("core", c, fault_names[i]);
        for (const std::string& engine : engines) {
          Finding f = base;
          f.engine = engine;
          CAPTURE(engine, to_string(question), fault_names[i]);
          try {
            const std::string text = reproducer(f, EngineCard{});
            CHECK(!has_open_token(text));
            CHECK(text.find("int main()") != std::string::npos);
            ++written;
          } catch (const InputError&) {
            // Refused with a message: this engine does not answer this question.
          } catch (const std::exception& e) {
            FAIL_CHECK(e.what());
          }
        }
      }
    }
  CHECK(written > 1000);
}

TEST_CASE("a program tells a time that is no number from no impact", "[reproduce]") {
  if (!test::has_command("g++")) return test::skip("there is no g++");
  const Workspace w("reproducer");
  Case hit = case_of(Question::time_of_impact, Sphere{0.5}, Sphere{0.5});
  hit.scene.bodies[1].pose.translation = {1.5, 0, 0};
  hit.scene.bodies[1].motion = Motion{{-1, 0, 0}, {0, 0, 0}};
  Case none = hit;
  none.scene.bodies[1].motion->linear = {1, 0, 0};
  const auto says = [&](const Case& c, std::optional<double> toi) {
    Finding f = finding_of("fcl-libccd", c, "early");
    Evidence e = *f.evidence;
    e.observation.toi = toi;
    f.evidence = std::make_shared<const Evidence>(std::move(e));
    w.write("check.cpp", asked_by_hand(reproducer(f, EngineCard{})));
    const Run compiled = w.run("g++ -std=c++17 -Wall -Wextra -Werror check.cpp -o check");
    INFO(compiled.err);
    REQUIRE(compiled.code == 0);
    return w.run("./check").out;
  };
  const std::string nan = "says: impact at nan\n";
  // Whatever the finding was, the program judges what the engine says when it is run.
  const std::optional<double> answers[] = {std::nullopt, 0.25, std::nan("")};
  for (const std::optional<double>& toi : answers) {
    const std::string of_hit = says(hit, toi);
    INFO(of_hit);
    CHECK(of_hit.starts_with("says: no impact\nexpected: impact within ["));
    CHECK(of_hit.find(nan) != std::string::npos);
    CHECK(of_hit.find("slack nan") == std::string::npos);
    CHECK(of_hit.find("WRONG") != of_hit.rfind("WRONG"));
    CHECK(of_hit.ends_with("right\n"));
    const std::string of_none = says(none, toi);
    INFO(of_none);
    CHECK(of_none.starts_with("says: no impact\nexpected: no impact in the step\nright\n" + nan));
    CHECK(of_none.ends_with("WRONG\n"));
  }
}

TEST_CASE("engines from npm have programs in JavaScript, and none in C++", "[reproduce]") {
  const std::vector<std::pair<Shape, Shape>> pairs{{Box{{0.5, 0.5, 0.5}}, Sphere{0.5}},
                                                   {Capsule{0.5, 0.5}, Cylinder{0.5, 0.5}}};
  const std::pair<const char*, const char*> packages[] = {
      {"mujoco", "@mujoco/mujoco@"},       {"mujoco-libccd", "@mujoco/mujoco@"},
      {"physx-query", "physx-js-webidl@"}, {"physx-gjk", "physx-js-webidl@"},
      {"havok", "@babylonjs/havok@"},      {"jolt", "jolt-physics@"},
      {"jolt-tuned", "jolt-physics@"},     {"rapier", "@dimforge/rapier3d-compat@"}};
  for (const auto& [engine, package] : packages) {
    CHECK(has_reproducer(engine));
    int written = 0;
    for (const Question question :
         {Question::overlap, Question::distance, Question::contact, Question::time_of_impact})
      for (const auto& [a, b] : pairs) {
        Case c = case_of(question, a, b);
        if (c.scene.bodies[1].motion) c.scene.bodies[1].motion->angular = Vec3::Zero();
        CAPTURE(engine, to_string(question));
        try {
          const std::string text = reproducer(finding_of(engine, c, to_string(Fault::missed)), EngineCard{});
          CHECK(!has_open_token(text));
          CHECK(text.find("int main()") == std::string::npos);
          CHECK(text.find(std::string("npm install ") + package) != std::string::npos);
          CHECK(text.find("function ask()") != std::string::npos);
          CHECK(text.find("function check(x)") != std::string::npos);
          ++written;
        } catch (const InputError&) {
          // Refused with a message: this engine does not answer this question.
        }
      }
    CHECK(written >= 4);
  }
  // A broad phase, a body that turns, and an engine without a writer.
  const Case turning = case_of(Question::time_of_impact, pairs[0].first, pairs[0].second);
  CHECK_THROWS_AS(reproducer(finding_of("havok", turning, to_string(Fault::missed)), EngineCard{}),
                  InputError);
  CHECK_FALSE(has_reproducer("physx-sap"));
  CHECK_FALSE(has_reproducer("havok-sim"));
}
