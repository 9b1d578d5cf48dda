// Engines behind a pipe as a user meets them: receipts, missing commands, engines from npm.
#include <cstdio>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "tests/support/catch.h"
#include "tests/support/pair_case.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

// Spheres of radius 1 at integer coordinates; `receipt` is the code that handles a scene.
std::string on_whole_numbers(const std::string& card, const std::string& receipt) {
  return R"(import json, sys
def say(x): print(json.dumps(x), flush=True)
card = {"touchstone_pipe": 1, "name": "whole", "library": "whole", "version": "1", "settings": "",
  "unit_roundoff": 1.1e-16, "tau_factor": 64, "source": ""}
)" + card +
         R"(
say(card)
for line in sys.stdin:
  m = json.loads(line)
  if "scene" in m:
    at = [[float(round(x)) for x in b["pose"]["translation"]] for b in m["scene"]["bodies"]]
)" + receipt +
         R"(
  else: say({"overlap": sum((x - y) ** 2 for x, y in zip(at[m["a"]], at[m["b"]])) <= 4})
)";
}

const char* const give =
    R"(    say({"received": {"bodies": [{"body": i, "matrix": [1, 0, 0, 0, 1, 0, 0, 0, 1], "translation": t}
      for i, t in enumerate(at)], "shapes": [{"shape": 0, "size": [1]}]}}))";

const char* const two_spheres = R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1,
  "shapes": [{"type": "sphere", "radius": 1}],
  "bodies": [{"shape": 0}, {"shape": 0, "pose": {"translation": [2.4, 0, 0]}}]},
  "queries": [{"question": "overlap", "a": 0, "b": 1}]})";

Run replay(const Workspace& w, const std::string& card, const std::string& receipt) {
  w.write("whole.py", on_whole_numbers(card, receipt));
  w.write("two.json", two_spheres);
  return w.touchstone("replay two.json --engines 'pipe:python3 whole.py' --subject whole");
}

}  // namespace

TEST_CASE("a receipt separates what was lost on the way in from what the algorithm does",
          "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  const Run with = replay(w, "card['receipts'] = True", give), without = replay(w, "", "");
  INFO(with.out << with.err << without.out << without.err);
  CHECK(with.code == 1);
  CHECK(with.out.find("lost in its rounding") != std::string::npos);
  CHECK(without.code == 1);
  CHECK(without.out.find("ghost: says overlap") != std::string::npos);
  CHECK(without.out.find("lost in its rounding") == std::string::npos);
}

TEST_CASE("an engine that holds another shape is not blamed for its algorithm", "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  const std::string card = "card['receipts'] = True";
  // It cooks every sphere to one of radius 1.3 and answers correctly for those.
  const std::string cooked = R"(    reach = 2.6 ** 2
    say({"received": {"shapes": [{"shape": 0, "as": %}]}}))";
  const auto receipt = [&](const std::string& shape) {
    return cooked.substr(0, cooked.find('%')) + shape + cooked.substr(cooked.find('%') + 1);
  };
  std::string engine = on_whole_numbers(card, receipt(R"({"type": "sphere", "radius": 1.3})"));
  engine.replace(engine.find("float(round(x))"), 15, "x");
  engine.replace(engine.find("<= 4"), 4, "<= reach");
  w.write("whole.py", engine);
  w.write("two.json", two_spheres);
  const Run told = w.touchstone("replay two.json --engines 'pipe:python3 whole.py' --subject whole");
  INFO(told.out << told.err);
  CHECK(told.code == 1);
  CHECK(told.out.find("ghost") != std::string::npos);
  CHECK(told.out.find("holds another shape") != std::string::npos);
  // A shape of another kind, and a kind that does not exist.
  const std::string box = R"({"type": "box", "half_extents": [1.3, 1.3, 1.3]})";
  engine.replace(engine.find(R"({"type": "sphere", "radius": 1.3})"), 33, box);
  w.write("whole.py", engine);
  const Run boxes = w.touchstone("replay two.json --engines 'pipe:python3 whole.py' --subject whole");
  INFO(boxes.out << boxes.err);
  CHECK(boxes.out.find("holds another shape") != std::string::npos);
  engine.replace(engine.find(box), box.size(), R"({"type": "blob"})");
  w.write("whole.py", engine);
  const Run blob = w.touchstone("replay two.json --engines 'pipe:python3 whole.py' --subject whole");
  INFO(blob.out << blob.err);
  CHECK(blob.out.find("an unknown type of shape: blob") != std::string::npos);
}

TEST_CASE("questions about margins and rays name their bodies, and the scene its margin",
          "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  // Spheres; a ray along x that starts before the sphere.
  w.write("balls.py", R"(import json, sys
def say(x): print(json.dumps(x), flush=True)
say({"touchstone_pipe": 1, "name": "balls", "library": "balls", "version": "1", "settings": "",
  "unit_roundoff": 1.1e-16, "tau_factor": 64, "source": ""})
for line in sys.stdin:
  m = json.loads(line)
  if "scene" in m:
    scene = m["scene"]
    continue
  a, b = scene["bodies"][m["a"]], scene["bodies"][m["b"]]
  gap = b["pose"]["translation"][0] - a["pose"]["translation"][0]
  gap -= sum(scene["shapes"][x["shape"]]["radius"] for x in (a, b))
  if m["ask"] == "within": say({"overlap": gap <= scene["margin"]})
  elif m["ask"] == "contact_within":
    mid = a["pose"]["translation"][0] + scene["shapes"][a["shape"]]["radius"] + gap / 2
    near = {"normal": [1, 0, 0], "depth": -gap, "points": [{"position": [mid, 0, 0], "depth": -gap}]}
    say({"overlap": True, **near} if gap <= scene["margin"] else {"overlap": False})
  elif m["ask"] == "bounded_distance": say({"lower": gap} if gap > scene["margin"] else {"distance": gap})
  elif m["ask"] == "ray": say({"toi": -gap / b["motion"]["linear"][0], "normal": [1, 0, 0]})
)");
  w.write("three.json", R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1, "margin": 0.5,
  "shapes": [{"type": "sphere", "radius": 1}, {"type": "sphere", "radius": 0}],
  "bodies": [{"shape": 0, "pose": {"translation": [9, 0, 0]}}, {"shape": 0},
    {"shape": 0, "pose": {"translation": [2.25, 0, 0]}}, {"shape": 0, "pose": {"translation": [6, 0, 0]}},
    {"shape": 1, "pose": {"translation": [5, 0, 0]}, "motion": {"linear": [-8, 0, 0]}}]},
  "queries": [{"question": "within", "a": 1, "b": 2}, {"question": "within", "a": 1, "b": 3},
    {"question": "bounded_distance", "a": 1, "b": 2}, {"question": "bounded_distance", "a": 1, "b": 3},
    {"question": "contact_within", "a": 1, "b": 2}, {"question": "contact_within", "a": 1, "b": 3},
    {"question": "ray", "a": 1, "b": 4}]})");
  const Run told = w.touchstone("replay three.json --engines 'pipe:python3 balls.py' --subject balls");
  INFO(told.out << told.err);
  CHECK(told.code == 0);
  for (const char* const answer :
       {"right   within\n", "right   beyond\n", "right   0.25\n", "right   at least 4\n",
        "right   within, 0.25 apart, n (1 0 0), 1 points", "right   t = 0.5,"})
    CHECK(told.out.find(answer) != std::string::npos);
}

TEST_CASE("a command is sent rounded boxes if its card lists them", "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  const auto engine = [](const std::string& card) {
    return R"(import json, sys
def say(x): print(json.dumps(x), flush=True)
say({"touchstone_pipe": 1, "name": "rounded", "library": "rounded", "version": "1", "settings": "",
  "unit_roundoff": 1.1e-16, "tau_factor": 64, "source": "", "receipts": True)" +
           card + R"(})
for line in sys.stdin:
  m = json.loads(line)
  if "scene" in m:
    scene = m["scene"]
    say({"received": {"shapes": [{"shape": i, "size": s["half_extents"] + [s["radius"]]}
      for i, s in enumerate(scene["shapes"])]}})
    continue
  a, b = scene["bodies"][m["a"]], scene["bodies"][m["b"]]
  x, y = scene["shapes"][a["shape"]], scene["shapes"][b["shape"]]
  apart = [max(0, abs(p - q) - h - k) for p, q, h, k in zip(a["pose"]["translation"], b["pose"]["translation"],
    x["half_extents"], y["half_extents"])]
  say({"distance": sum(d * d for d in apart) ** 0.5 - x["radius"] - y["radius"]})
)";
  };
  w.write("two.json", R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1,
  "shapes": [{"type": "rounded_box", "half_extents": [1, 2, 3], "radius": 0.5},
             {"type": "rounded_box", "half_extents": [1, 1, 1], "radius": 0.25}],
  "bodies": [{"shape": 0}, {"shape": 1, "pose": {"translation": [5, 7, 0]}}]},
  "queries": [{"question": "distance", "a": 0, "b": 1}]})");
  w.write("rounded.py", engine(", \"more_shapes\": [\"rounded_box\"]"));
  const Run sent = w.touchstone("replay two.json --engines 'pipe:python3 rounded.py,core' --subject rounded");
  INFO(sent.out << sent.err);
  // It ignores rotations, so only the case itself is answered right.
  CHECK(sent.out.find("rounded                right   4.25") != std::string::npos);  // |(3, 4)| - 0.75
  w.write("rounded.py", engine(""));
  const Run not_sent = w.touchstone("replay two.json --engines 'pipe:python3 rounded.py' --subject rounded");
  INFO(not_sent.out << not_sent.err);
  CHECK(not_sent.code == 3);
  CHECK(not_sent.out.find("cannot: rounded") != std::string::npos);
}

TEST_CASE("what a command writes to standard error is shown when it dies", "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  w.write("two.json", two_spheres);
  w.write("broken.py", "import sys\ndef f(:\n");
  const Run at_start = w.touchstone("replay two.json --engines 'pipe:python3 broken.py'");
  CHECK(at_start.code == 2);
  CHECK(at_start.err.find("exit code 1: ") != std::string::npos);
  CHECK(at_start.err.find("SyntaxError: invalid syntax") != std::string::npos);
  // More than a pipe's buffer, while the harness waits for an answer.
  const std::string chatty =
      "    [print('x' * 1000, file=sys.stderr) for _ in range(300)]; sys.exit('no licence')";
  const Run later = replay(w, "", chatty);
  INFO(later.out << later.err);
  CHECK(later.out.find("no licence") != std::string::npos);
}

TEST_CASE("a receipt may refuse the scene; a malformed one is a crash with its reason", "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  const std::string card = "card['receipts'] = True";
  const Run refused = replay(w, card, "    say({'outcome': 'unsupported'})");
  INFO(refused.out << refused.err);
  CHECK(refused.out.find("cannot: whole") != std::string::npos);
  for (const char* bad :
       {"    say({'received': {'bodies': [{'body': 7, 'matrix': [0] * 9, 'translation': [0] * 3}]}})",
        "    say({'received': {'bodies': [{'body': 0, 'matrix': [1], 'translation': [0] * 3}]}})",
        "    say({'received': {'shapes': [{'shape': 0}]}})"}) {
    const Run r = replay(w, card, bad);
    INFO(bad << r.out << r.err);
    CHECK(r.code != 0);
    CHECK(r.out.find("crashed") != std::string::npos);
    CHECK(r.out.find("receipt") != std::string::npos);
  }
}

TEST_CASE("a missing command is named, with the reason", "[pipe]") {
  const Workspace w("pipe");
  w.write("text", "no program");
  const std::pair<const char*, const char*> commands[] = {
      {"pipe:./missing --option", "there is no such command"},
      {"pipe:./text", "the command is not executable"},
      {"pipe:false", "the command ended without an answer, exit code"},
  };
  for (const auto& [command, reason] : commands)
    for (const char* how : {"certify --limit 4 --subject", "engines --check", "replay two.json --engines"}) {
      w.write("two.json", two_spheres);
      const Run r = w.touchstone(std::string(how) + " '" + command + "'");
      INFO(how << " " << command << " printed: " << r.out << r.err);
      CHECK(r.code == 2);
      CHECK(r.err.find(command) != std::string::npos);
      CHECK(r.err.find(reason) != std::string::npos);
    }
}

TEST_CASE("a certificate of a command holds for the scripts that it names and no others",
          "[pipe][certify][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe");
  fs::copy(TS_SOURCE_DIR "/oracles/example/broad_phase.py", w.dir / "mine.py");
  const Run made = w.touchstone("certify --subject 'pipe:python3 mine.py' --limit 8 -o c.json");
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  CHECK(made.out.find("plug-in ") != std::string::npos);
  const std::string check = "certify --check c.json --subject 'pipe:python3 mine.py'";
  CHECK(w.touchstone(check).code == 0);
  std::ofstream(w.dir / "mine.py", std::ios::app) << "# another\n";
  const Run changed = w.touchstone(check);
  CHECK(changed.code == 1);
  CHECK(changed.out.find("a different build from the one certified") != std::string::npos);
}

TEST_CASE("engines from npm say what to do when they are not installed", "[pipe][npm]") {
  const Workspace w("npm");
  for (const char* name : {"jolt", "jolt-tuned", "rapier", "mujoco", "physx-query", "physx-abp", "havok"}) {
    const Run r =
        w.run("TOUCHSTONE_NPM=" + w.dir.string() + "/none " TS_BINARY_DIR "/bin/touchstone engines " + name);
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("./touchstone engines --install " + std::string(name)) != std::string::npos);
  }
  const Run unknown = w.touchstone("engines --install ph");
  CHECK(unknown.code == 2);
  for (const char* name : {"havok", "jolt-tuned", "mujoco-libccd", "physx-query"})
    CHECK(unknown.err.find(name) != std::string::npos);
  // A library stands for its engines.
  for (const char* name : {"rapier", "physx"}) {
    const Run no_npm =
        w.run("PATH=" + w.dir.string() +
              " TOUCHSTONE_NPM=none " TS_BINARY_DIR "/bin/touchstone engines --install " + name);
    INFO(no_npm.out << no_npm.err);
    CHECK(no_npm.code == 2);
    CHECK(no_npm.err.find("nodejs and npm") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(w.dir / "none"));
}

namespace {

bool is_installed(const Workspace& w, const std::string& name) {
  if (w.touchstone("engines " + name).code == 0) return true;
  std::printf("left out: %s is not installed (touchstone engines --install %s)\n", name.c_str(),
              name.c_str());
  return false;
}

}  // namespace

TEST_CASE("engines from npm use the interface correctly", "[pipe][npm][optional]") {
  const Workspace w("npm");
  const std::pair<const char*, int> right[] = {
      {"jolt", 22},          {"jolt-tuned", 22},    {"rapier", 22},      {"mujoco", 16},
      {"mujoco-single", 16}, {"mujoco-libccd", 16}, {"physx-query", 15}, {"physx-gjk", 17},
      {"physx-sim", 16},     {"physx-sap", 2},      {"physx-mbp", 2},    {"physx-abp", 2},
      {"havok", 15},         {"havok-sim", 12},     {"cannon", 13},      {"cannon-sap", 2}};
  std::size_t checked = 0;
  for (const auto& [name, count] : right) {
    if (!is_installed(w, name)) continue;
    const Run r = w.touchstone("engines --check " + std::string(name));
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(r.out.find(std::string(name) + ": " + std::to_string(count) + " right, 0 wrong") !=
          std::string::npos);
    ++checked;
  }
  if (checked == 0) skip("no engine from npm is installed");
}

TEST_CASE("engines from npm answer in batches as they do one by one", "[pipe][npm][batch][optional]") {
  const Workspace w("npm");
  const char* chosen = std::getenv("TOUCHSTONE_NPM");
  const std::string packages = chosen ? chosen : TS_BINARY_DIR "/npm";
  const fs::path scripts = TS_BINARY_DIR "/share/touchstone/engines/npm";
  fs::copy(scripts, w.dir / "alone", fs::copy_options::recursive);
  std::string adapter = read_all(w.dir / "alone/adapter.mjs");
  const std::string mark = "...engine.card,";
  REQUIRE(adapter.find(mark) != std::string::npos);
  w.write("alone/adapter.mjs", adapter.replace(adapter.find(mark), mark.size(), mark + " batches: false,"));
  std::size_t compared = 0;
  for (const auto& [name, script] : {std::pair("cannon", "cannon/cannon.mjs"),
                                     {"rapier", "rapier/rapier.mjs"},
                                     {"havok", "havok/havok.mjs"},
                                     {"jolt", "jolt/jolt.mjs"}}) {
    if (!is_installed(w, name)) continue;
    const auto digest = [&, script = script](const fs::path& folder, const std::string& out) {
      const Run r =
          w.touchstone("fuzz --cases 128 --seed 3 --jobs 1 --out " + out + " --engines 'pipe:node " +
                       (folder / script).string() + " " + packages + "'");
      INFO(r.out << r.err);
      CHECK(r.code <= 1);
      return parsed<nlohmann::ordered_json>(read_all(w.dir / out / "summary.json")).at("digest");
    };
    CHECK(digest(scripts, std::string(name) + "-batches") ==
          digest(w.dir / "alone", std::string(name) + "-alone"));
    ++compared;
  }
  if (compared == 0) skip("no engine from npm is installed");
}

TEST_CASE("PhysX's broad phases keep every pair of boxes", "[pipe][npm][certify][optional]") {
  const Workspace w("npm");
  if (!is_installed(w, "physx-sap")) return skip("PhysX is not installed");
  for (const char* name : {"physx-sap", "physx-mbp", "physx-abp"}) {
    const Run r = w.touchstone("certify --level boxes --limit 20 --subject " + std::string(name));
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(r.out.find("boxes certified") != std::string::npos);
  }
}

TEST_CASE("known faults of engines from npm are shown by programs against the engine alone",
          "[pipe][npm][reproduce][optional]") {
  const Workspace w("npm");
  const std::string unit = R"({"type": "box", "half_extents": [1, 1, 1]})",
                    small = R"({"type": "box", "half_extents": [0.5, 0.5, 0.5]})",
                    cylinder = R"({"type": "cylinder", "radius": 1, "half_height": 1})",
                    cone = R"({"type": "cone", "radius": 1, "half_height": 0.000244140625})",
                    corner = R"({"type": "hull", "vertices": [[0,0,0], [1,0,0], [0,1,0], [0,0,1]]})";
  const std::string moves = R"(, "pose": {"translation": [0, 0, 5]}, "motion": {"linear": [0, 0, -10]})";
  struct Known {
    const char *engine, *key;
    std::string text;
  };
  // Truth by hand. Two equal cylinders with one centre overlap by 2 (axis and diameter). Cubes of side 1 with
  // one centre need 1 along a face, √3 along a diagonal. The cylinder's lower end, at 4, meets the box's
  // upper face, at 1, after 3 of 10. A ball of radius 1 at distance 3 from the axis of a cylinder of radius 1
  // is 1 from it at every angle. A ball in a cube shares all of its points, and so do two equal cones in one
  // place. A ball about the corner of a tetrahedron leaves it after its radius, along any axis backwards.
  const Known all[] = {
      {"mujoco", "mujoco.overlap.missed.cylinder-cylinder.algorithm.solid.gross",
       pair_case(cylinder, cylinder, "overlap")},
      {"physx-gjk", "physx-gjk.contact.not_minimal.box-box.algorithm.solid.gross",
       pair_case(small, small, "contact")},
      {"physx-query", "physx-query.time_of_impact.missed.box-cylinder.algorithm.solid.gross",
       pair_case(cylinder, unit, "time_of_impact", moves)},
      {"havok", "havok.distance.distance_off.cylinder-sphere.representation.solid.small",
       pair_case(cylinder, R"({"type": "sphere", "radius": 1})", "distance",
                 R"(, "pose": {"translation": [2.942355841, 0.5853, 0]})")},
      {"jolt", "jolt.contact.missed.cone-cone.algorithm.solid.small", pair_case(cone, cone, "contact")},
      {"rapier", "rapier.contact.not_minimal.hull-sphere.algorithm.solid.gross",
       pair_case(corner, R"({"type": "sphere", "radius": 1})", "contact")},
      {"cannon", "cannon.overlap.missed.box-sphere.algorithm.solid.gross",
       pair_case(unit, R"({"type": "sphere", "radius": 0.5})", "overlap")},
  };
  std::size_t shown = 0;
  for (const Known& k : all) {
    if (!is_installed(w, k.engine)) continue;
    w.write("known.json", k.text);
    const Run made = w.touchstone("reproduce known.json --engine " + std::string(k.engine) + " --key " +
                                  k.key + " -o reproduce.mjs");
    INFO(k.engine << made.out << made.err);
    REQUIRE(made.code == 0);
    const char* chosen = std::getenv("TOUCHSTONE_NPM");
    const fs::path folder = chosen ? fs::path(chosen) : fs::path(TS_BINARY_DIR "/npm");
    if (!fs::exists(w.dir / "node_modules"))
      fs::create_symlink(folder / "node_modules", w.dir / "node_modules");
    const Run ran = w.run("node reproduce.mjs");
    INFO(ran.out << ran.err);
    CHECK(ran.code == 1);
    CHECK(ran.out.find("WRONG") != std::string::npos);
    ++shown;
  }
  if (shown == 0) skip("no engine from npm is installed");
}

TEST_CASE("ODE is queried correctly, and its spaces keep every pair of boxes", "[ode][certify][optional]") {
  const Workspace w("ode");
  if (w.touchstone("engines ode").code != 0) return skip("ODE is not built in");
  const Run asked = w.touchstone("engines --check ode");
  INFO(asked.out << asked.err);
  CHECK(asked.code == 0);
  CHECK(asked.out.find("ode: 14 right, 0 wrong") != std::string::npos);
  for (const char* space : {"ode-simple", "ode-hash", "ode-quadtree", "ode-sap"}) {
    const Run r =
        w.touchstone("certify --level boxes --without no_boxes --limit 40 --subject " + std::string(space));
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(r.out.find("boxes certified") != std::string::npos);
  }
}
