// Releases of an engine from npm: installing them, what they cannot be asked, which of them has a fault.
#include <nlohmann/json.hpp>

#include "tests/support/catch.h"
#include "tests/support/npm_registry.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"

using namespace touchstone::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("several releases of one engine from npm are installed side by side, and used by name",
          "[npm][optional]") {
  if (!has_command("node")) return skip("node is not installed");
  const Workspace w("versions-install");
  const NpmRegistry npm(w);
  const Run r = npm.touchstone("engines --install rapier@0.3,rapier@0.6,rapier@0.5.0");
  INFO(r.out << r.err);
  REQUIRE(r.code == 0);
  for (const char* name : {"rapier@0.3.0: Rapier", "rapier@0.6.1: Rapier", "rapier@0.5.0: Rapier"})
    CHECK(says(r.out, name));
  std::size_t installs = 0;
  for (std::size_t at = 0; (at = npm.log().find("install ", at)) != std::string::npos; ++at) ++installs;
  CHECK(installs == 3);
  CHECK(says(npm.log(), "--ignore-scripts"));
  CHECK_FALSE(says(npm.log().substr(npm.log().find("install ")), "install --no"));

  const Run listed = npm.touchstone("engines --json rapier@0.5.0");
  INFO(listed.out << listed.err);
  REQUIRE(listed.code == 0);
  CHECK(parsed<Json>(listed.out)[0]["name"] == "rapier@0.5.0");
  CHECK(parsed<Json>(listed.out)[0]["version"] == "0.5.0");
  w.write("two.json", two_small_balls);
  const Run asked = npm.touchstone(
      "replay two.json --engines rapier@0.3.0,rapier@0.5.0,rapier@0.6.1 --subject rapier@0.5.0");
  INFO(asked.out << asked.err);
  CHECK(asked.code == 1);
  CHECK(says(asked.out, "rapier@0.3.0           right   0.75"));
  CHECK(says(asked.out, "rapier@0.5.0           WRONG   1"));
  CHECK(says(asked.out, "rapier@0.6.1           right   0.75"));
  // The name on a finding's key is that of the release.
  const Run shrunk = npm.touchstone("bisect bodies two.json --engine rapier@0.5.0");
  INFO(shrunk.out << shrunk.err);
  CHECK(says(shrunk.out, "rapier@0.5.0.distance.distance_off"));

  const Run missing = npm.touchstone("engines rapier@0.2.0");
  CHECK(missing.code == 2);
  CHECK(says(missing.err, "engines --install rapier@0.2.0 installs @dimforge/rapier3d-compat 0.2.0"));
  const Run near = npm.touchstone("engines rapier@0.3");
  CHECK(near.code == 2);
  CHECK(says(near.err, "did you mean rapier@0.3.0"));
}

TEST_CASE("what npm and packages say about releases is checked", "[npm][optional]") {
  if (!has_command("node")) return skip("node is not installed");
  const Workspace w("versions-hostile");
  const NpmRegistry npm(w);
  npm.list(npm.names() +
           R"(, "0.9.0-beta.1", "1.0.0;touch here", "../../x", "9999999999.0.0", "0.08.0", 7, "0.6.01")");
  const Run r = npm.touchstone("versions rapier --releases 8 --cases 1 --json");
  INFO(r.out << r.err);
  REQUIRE(r.code == 0);
  std::vector<std::string> releases;
  const Json table = parsed<Json>(r.out);
  for (const Json& release : table["releases"]) releases.push_back(release["release"]);
  CHECK(releases ==
        std::vector<std::string>{"0.0.9", "0.1.0", "0.2.0", "0.3.0", "0.4.0", "0.5.0", "0.6.1", "0.7.0"});
  CHECK_FALSE(fs::exists(w.dir / "here"));

  for (const char* name :
       {"rapier@../../x", "rapier@", "rapier@0.3.0.0", "rapier@latest", "rapier@1", "rapier@'0.3.0;x'"}) {
    const Run bad = npm.touchstone("engines --install " + std::string(name));
    INFO(name << bad.out << bad.err);
    CHECK(bad.code == 2);
    CHECK(says(bad.err, "--install rapier@"));
  }
  npm.list(npm.names() + ", {");
  const Run damaged = npm.touchstone("versions rapier");
  INFO(damaged.err);
  CHECK(damaged.code == 2);
  CHECK(says(damaged.err, "npm view @dimforge/rapier3d-compat versions:"));

  // A package that says to be another release than the folder's is not that release.
  const fs::path package =
      w.dir /
      "packages/releases/@dimforge+rapier3d-compat@0.3.0/node_modules/@dimforge/rapier3d-compat/package.json";
  REQUIRE(fs::exists(package));
  REQUIRE(npm.touchstone("engines rapier@0.3.0").code == 0);
  std::ofstream(package) << R"({"version": "0.4.0", "main": "rapier.mjs"})";
  CHECK(says(npm.touchstone("engines rapier@0.3.0").err, "is not installed"));
}

TEST_CASE("what a release's interface lacks or does differently is unsupported, never a wrong answer",
          "[npm][optional]") {
  if (!has_command("node")) return skip("node is not installed");
  const Workspace w("versions-api");
  const NpmRegistry npm(w);
  REQUIRE(npm.touchstone("engines --install "
                         "rapier@0.0.9,rapier@0.1.0,rapier@0.2.0,rapier@0.3.0,rapier@0.6.1,rapier@0.7.0")
              .code == 0);
  w.write("moving.json", R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1,
    "shapes": [{"type": "sphere", "radius": 0.5}],
    "bodies": [{"shape": 0}, {"shape": 0, "pose": {"translation": [3, 0, 0]},
      "motion": {"linear": [-4, 0, 0], "angular": [0, 0, 0]}}]},
    "queries": [{"question": "overlap", "a": 0, "b": 1}, {"question": "time_of_impact", "a": 0, "b": 1},
      {"question": "candidates"}]})");
  const auto answers = [&](const std::string& release) {
    const Run r = npm.touchstone("replay moving.json --json --engines rapier@" + release);
    INFO(r.out << r.err);
    std::string outcomes;
    const Json replayed = parsed<Json>(r.out);
    for (const Json& query : replayed[0]["queries"]) {
      const Json& a = query["engines"]["rapier@" + release]["answer"];
      outcomes += a["outcome"].get<std::string>() +
                  (a.contains("detail") ? ": " + a["detail"].get<std::string>() : "") + "\n";
    }
    return std::pair(r.code, outcomes);
  };
  const std::string differs = " differs from the adapter's release: ";
  const std::string no_world = "unsupported: rapier@0.3.0" + differs + "rapier.World is not a constructor\n";
  // castShape with 8, 9 and 11 arguments.
  for (const char* release : {"0.2.0", "0.3.0", "0.6.1"}) {
    const auto [code, outcomes] = answers(release);
    INFO(release << "\n" << outcomes);
    CHECK(code == 0);
    CHECK(says(outcomes, "answered\nanswered\nunsupported: "));
  }
  CHECK(says(answers("0.3.0").second, no_world));
  const auto lacking = answers("0.1.0");
  INFO(lacking.second);
  CHECK(lacking.first == 3);
  CHECK(says(lacking.second,
             "unsupported: rapier@0.1.0" + differs + "p.shape.intersectsShape is not a function"));
  const auto refused = answers("0.0.9");
  INFO(refused.second);
  CHECK(refused.first == 3);
  CHECK(
      says(refused.second, "unsupported: rapier@0.0.9 cannot be started by the adapter: made for browsers"));
  // It returns times in per cent of the step.
  const auto other_unit = answers("0.7.0");
  INFO(other_unit.second);
  CHECK(other_unit.first == 0);
  CHECK(says(other_unit.second,
             "answered\nunsupported: rapier@0.7.0" + differs + "unit balls 3 apart: {\"toi\":25}"));
}

TEST_CASE("a table says which releases have a cause, the same for any number of jobs", "[npm][optional]") {
  if (!has_command("node")) return skip("node is not installed");
  const Workspace w("versions-table");
  const NpmRegistry npm(w);
  const std::string command = "versions rapier --only 0.1,0.3,0.4,0.5,0.6.1 --cases 300 --json";
  const Run one = npm.touchstone(command + " --jobs 1"), two = npm.touchstone(command + " --jobs 2");
  INFO(one.out << one.err);
  REQUIRE(one.code == 0);
  CHECK(one.out == two.out);
  const Json table = parsed<Json>(one.out);
  CHECK(table["releases"][0]["cannot"].get<std::string>().empty() == false);
  CHECK(table["releases"][1]["wrong"] == 0);
  std::size_t of_distance = 0;
  for (const Json& cause : table["causes"]) {
    if (cause["question"] != "distance" || cause["fault"] != "distance_off") continue;
    ++of_distance;
    INFO(cause.dump(1));
    CHECK(cause["releases"]["0.1.0"]["says"] == "cannot be asked");
    CHECK(cause["releases"]["0.3.0"]["says"] == "right");
    CHECK(cause["releases"]["0.4.0"]["says"] == "shows");
    CHECK(cause["releases"]["0.6.1"]["says"] == "right");
    CHECK(cause["introduced_in"] == "0.4.0");
    CHECK(cause["not_in"] == "0.3.0");
    CHECK(cause["gone_since"] == "0.6.1");
  }
  CHECK(of_distance > 0);

  // The causes of a campaign, in releases that it did not ask; without npm.
  REQUIRE(npm.touchstone("fuzz --engines rapier@0.5.0 --cases 300 --out out").code == 1);
  REQUIRE(npm.touchstone("causes out").code == 0);
  const Run given = npm.touchstone("versions rapier --installed --causes out/causes.json");
  INFO(given.out << given.err);
  REQUIRE(given.code == 0);
  CHECK(says(given.out, "    0.1.0  0.3.0  0.4.0  0.5.0  0.6.1\n"));
  CHECK(says(given.out, "-      .      X      X      .\n"));
  CHECK(says(given.out, "introduced in 0.4.0 (right in 0.3.0), gone since 0.6.1"));
  const Run markdown = npm.touchstone("versions rapier --installed --causes out/causes.json --markdown");
  CHECK(says(markdown.out, "| - | . | X | X | . | 0.4.0 | 0.6.1 |\n"));
  const Run unknown = npm.touchstone("versions fcl");
  CHECK(unknown.code == 2);
  CHECK(says(unknown.err, "is not one that npm has releases of"));
}

TEST_CASE("bisect release names the first bad release", "[npm][optional]") {
  if (!has_command("node")) return skip("node is not installed");
  const Workspace w("versions-bisect");
  const NpmRegistry npm(w);
  w.write("two.json", two_small_balls);
  const Run newest = npm.touchstone("bisect release two.json --engine rapier");
  INFO(newest.out << newest.err);
  CHECK(newest.code == 3);
  CHECK(says(newest.err, "rapier@0.7.0 is not found wrong; name an older release that is with --bad"));
  const Run r = npm.touchstone("bisect release two.json --engine rapier --bad 0.6.0");
  INFO(r.out << r.err);
  REQUIRE(r.code == 0);
  CHECK(says(r.out, "first bad: 0.4.0 (0.3.0 is good)"));
  CHECK_FALSE(says(npm.log(), "compat@0.6.1"));
  CHECK_FALSE(says(npm.log(), "compat@0.0.9"));
  // The key of the finding in another release; and nothing but releases that cannot be asked before it.
  const std::string key = r.out.substr(0, r.out.find('\n')), name = "rapier@0.6.0";
  REQUIRE(key.starts_with(name + ".distance.distance_off."));
  const Run skipped = npm.touchstone(
      "bisect release two.json --engine rapier --bad 0.5.0 --only 0.0,0.1,0.4,0.5 --json --key rapier" +
      key.substr(name.size()));
  INFO(skipped.out << skipped.err);
  REQUIRE(skipped.code == 0);
  const Json j = parsed<Json>(skipped.out);
  CHECK(j["first_bad"] == "0.4.0");
  CHECK(j["good"].is_null());
  CHECK(j["skipped"] == Json{"0.0.9", "0.1.0"});
  CHECK(j["key"] == "rapier@0.5.0" + key.substr(name.size()));
}
