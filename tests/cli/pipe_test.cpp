// Engines behind a pipe as a user meets them: receipts, missing commands, engines from npm.
#include <cstdio>

#include "tests/support/catch.h"
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
  for (const char* name : {"jolt", "jolt-tuned", "rapier"}) {
    const Run r =
        w.run("TOUCHSTONE_NPM=" + w.dir.string() + "/none " TS_BINARY_DIR "/bin/touchstone engines " + name);
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("./touchstone engines --install " + std::string(name)) != std::string::npos);
  }
  const Run unknown = w.touchstone("engines --install physx");
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("jolt, jolt-tuned and rapier") != std::string::npos);
  const Run no_npm = w.run("PATH=" + w.dir.string() +
                           " TOUCHSTONE_NPM=none " TS_BINARY_DIR "/bin/touchstone engines --install rapier");
  INFO(no_npm.out << no_npm.err);
  CHECK(no_npm.code == 2);
  CHECK(no_npm.err.find("nodejs and npm") != std::string::npos);
  CHECK_FALSE(fs::exists(w.dir / "none"));
}

TEST_CASE("engines from npm use the interface correctly", "[pipe][npm][optional]") {
  const Workspace w("npm");
  std::size_t checked = 0;
  for (const char* name : {"jolt", "jolt-tuned", "rapier"}) {
    if (w.touchstone("engines " + std::string(name)).code != 0) {
      std::printf("left out: %s is not installed (touchstone engines --install %s)\n", name, name);
      continue;
    }
    const Run r = w.touchstone("engines --check " + std::string(name));
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(r.out.find(std::string(name) + ": 19 right, 0 wrong") != std::string::npos);
    ++checked;
  }
  if (checked == 0) skip("no engine from npm is installed");
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
