// Bisection of an engine that lies beyond a known value, from a known step, since a known commit.
#include "fuzz/bisect/bisect.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

// The documented example plug-in with one line changed: beyond `limit` it denies that spheres touch.
std::string lying_source(const std::string& limit) {
  std::string s = read_all(TS_SOURCE_DIR "/oracles/example/example_engine.c");
  const std::string honest = "out->overlap = gap <= 0;";
  const std::size_t at = s.find(honest);
  REQUIRE(at != std::string::npos);
  return s.replace(at, honest.size(), fmt::format("out->overlap = gap <= 0 && length <= {};", limit));
}

const std::string build = "gcc -shared -fPIC -I " TS_SOURCE_DIR " engine.c -o libmine.so -lm";

// Six unit spheres far from each other, except bodies 2 and 4, whose centres are 1.75 apart.
std::string spheres() {
  nlohmann::json j{{"touchstone_case", 1}};
  j["scene"]["touchstone_scene"] = 1;
  j["scene"]["shapes"] = {{{"type", "sphere"}, {"radius", 1}}};
  for (int i = 0; i < 6; ++i)
    j["scene"]["bodies"].push_back(
        {{"shape", 0},
         {"pose", {{"translation", {100 * (i == 4 ? 2 : i), 0, 0}}, {"rotation", {0, 0, 0, 1}}}}});
  j["queries"] = {{{"question", "overlap"}, {"a", 2}, {"b", 4}}};
  j["scene"]["bodies"][4]["pose"]["translation"] = {200, 1.75, 0};
  return j.dump();
}

nlohmann::json json_of(const Run& r) {
  INFO(r.err);
  REQUIRE(r.code == 0);
  return parsed<nlohmann::json>(r.out);
}

}  // namespace

TEST_CASE("bodies, stage and value at which a lie starts are found to the last bit", "[bisect]") {
  const Workspace w("bisect");
  w.write("engine.c", lying_source("1.5"));
  REQUIRE(w.run(build).code == 0);
  w.write("case.json", spheres());
  const std::string of = " case.json --engine ./libmine.so --json";

  CHECK(json_of(w.touchstone("bisect bodies" + of))["bodies"] == nlohmann::json{2, 4});
  CHECK(json_of(w.touchstone("bisect stage" + of))["first"] == "overlap");
  const auto t =
      json_of(w.touchstone(fmt::format("bisect value{} --at /scene/bodies/4/pose/translation/1 --to 1", of)));
  CHECK(t["shows_not"] == 1.5);
  CHECK(t["shows"] == std::nextafter(1.5, 2.0));
  CHECK(t["neighbours"] == true);

  CHECK(
      w.touchstone(fmt::format("bisect value{} --at /scene/bodies/4/pose/translation/1 --to 1.9", of)).code ==
      2);
  CHECK(w.touchstone(fmt::format("bisect value{} --at /scene/bodies/9/pose --to 1", of)).code == 2);
  CHECK(w.touchstone("bisect step" + of).code == 2);
  CHECK(w.touchstone("bisect bodies case.json --engine core").code == 3);
}

TEST_CASE("the first query that shows a lie is found, with the changes that led to it", "[bisect]") {
  Case c;
  c.id = "steps";
  c.scene.shapes = {Sphere{1}};
  for (int i = 0; i < 3; ++i) {
    Body b;
    b.shape = 0;
    b.pose.translation = {10.0 * i, 0, 0};
    c.scene.bodies.push_back(b);
  }
  const auto add = [&](Step::Op op, int body, double x = 0) {
    Step s;
    s.op = op;
    s.body = body;
    if (op == Step::Op::move) s.pose = Pose{{x, 0, 0}, {0, 0, 0, 1}};
    c.scene.script.push_back(s);
  };
  for (int i = 0; i < 3; ++i) add(Step::Op::insert, i);
  for (int k = 0; k < 5; ++k) {
    if (k == 3) add(Step::Op::move, 2, 11);
    add(Step::Op::query, -1);
  }
  c.queries = {{Question::candidates, 0, 0}};
  for (const mutants::Mutant& m : mutants::mutants()) {
    if (m.name != "last_pair_dropped") continue;
    const EnginePtr engine = mutants::make_lying_engine(m);
    const auto findings = fuzz::findings_of({&c, 1}, engine)[0];
    REQUIRE(findings.size() == 1);
    const auto r = fuzz::which_step(c, fuzz::commits_fault(engine, findings.begin()->second));
    CHECK(r.query == 3);
    CHECK(r.queries == 5);
    REQUIRE(r.changes.size() == 1);
    CHECK(r.changes[0].op == Step::Op::move);
    CHECK(r.changes[0].body == 2);
    const auto needed = fuzz::which_bodies(c, fuzz::commits_fault(engine, findings.begin()->second));
    CHECK(needed.bodies == std::vector<int>{1, 2});
    return;
  }
  FAIL("the mutant is gone");
}

TEST_CASE("git finds the commit that broke an engine, skipping one that does not build",
          "[bisect][optional]") {
  const Workspace w("bisect");
  if (!has_command("git")) return skip("git is not installed");
  w.write("case.json", spheres());
  const std::string git = "git -c user.name=t -c user.email=t@t -c init.defaultBranch=main ";
  REQUIRE(w.run(fmt::format("{}init -q repo", git)).code == 0);
  const auto commit = [&](const std::string& source, const std::string& name) {
    w.write("repo/engine.c", source);
    REQUIRE(w.run(fmt::format("cd repo && {0}add engine.c && {0}commit -qm {1}", git, name)).code == 0);
  };
  for (int i = 0; i < 9; ++i) {
    const std::string source = lying_source(i < 6 ? "2.5" : "1.5") + fmt::format("\n/* {} */\n", i);
    commit(i == 4 ? fmt::format("{} does not compile", source) : source, fmt::format("c{}", i));
  }
  REQUIRE(w.run(fmt::format("cd repo && {}bisect start HEAD HEAD~8", git)).code == 0);
  const Run r =
      w.run(fmt::format("cd repo && {}bisect run {}/bin/touchstone bisect commit ../case.json --engine "
                        "./libmine.so --build '{}'",
                        git, TS_BINARY_DIR, build));
  INFO(r.out << r.err);
  const std::string bad = w.run(fmt::format("cd repo && {}rev-parse main~2", git)).out;
  CHECK(r.out.find(bad.substr(0, 40) + " is the first bad commit") != std::string::npos);
}
