// `certify`, `engines --check` and the plug-in kit as a user meets them.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

const std::string mutants = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";

// An engine behind a pipe: `body` answers the message `m` about `scene`.
std::string python(const std::string& body) {
  return R"(import json, sys
print(json.dumps({"touchstone_pipe": 1, "name": "small", "library": "small", "version": "1", "settings": "",
  "unit_roundoff": 1.1e-16, "tau_factor": 64, "source": ""}), flush=True)
scene = None
def say(x): print(json.dumps(x), flush=True)
for line in sys.stdin:
  m = json.loads(line)
  if "scene" in m: scene = m["scene"]; continue
)" + body;
}

}  // namespace

TEST_CASE("certify --memcheck refutes a broad phase that loses no pair but reads freed memory",
          "[certify][cli][optional]") {
  if (touchstone::test::is_sanitized) return skip("Valgrind cannot run what AddressSanitizer is in");
  const Workspace w("memcheck");
  const std::string command =
      "certify --subject " TS_BINARY_DIR "/lib/libts_reads_freed.so --level boxes --jobs 1 --limit 8";
  CHECK(w.touchstone(command).code == 0);
  const Run r = w.touchstone(command + " --memcheck");
  if (r.err.find("apt-get install valgrind") != std::string::npos) {
    CHECK(r.code == 3);
    return skip("Valgrind is not installed");
  }
  INFO(r.out << r.err);
  CHECK(r.code == 1);
  CHECK(r.out.find("Invalid read of size 1 in ") != std::string::npos);
  CHECK(r.out.find("inside a block of size") != std::string::npos);
}

TEST_CASE("certify refuses bad input with exit code 2, the place and the reason, and writes nothing",
          "[certify][cli]") {
  const Workspace w("certify");
  w.write("no_plugin.so", "text");
  w.write("truncated.json", "{\"touchstone_broad_certificate\": 1,");
  w.write("other.json", "{\"touchstone_scene\": 1}");
  const std::pair<const char*, const char*> commands[] = {
      {"--subject nothing", "nothing"},
      {"--subject ./libmissing.so", "libmissing.so"},
      {"--subject ./no_plugin.so", "no_plugin.so"},
      {"--subject grid --scope huge", "--scope"},
      {"--subject grid -o other.json/c.json", "other.json"},
      {"--subject grid --without nothing", "nothing"},
      {"--subject grid --margin -1", "--margin"},
      {"--subject grid --margin nan", "--margin"},
      {"--subject grid --margin 1 --sweeps", "--margin"},
      {"--subject core,core-f32", "core"},
      {"--subject pipe:true", "pipe:true"},
      {"--subject pipe:./missing", "missing"},
      {"--check missing.json", "missing.json"},
      {"--check truncated.json", "truncated.json"},
      {"--check other.json", "other.json"},
      {"", "--subject"}};
  for (const auto& [options, place] : commands) {
    const Run r = w.touchstone("certify " + std::string(options) + " --limit 10");
    INFO(options << " printed: " << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find(place) != std::string::npos);
    CHECK(r.out.empty());
  }
  CHECK(read_all(w.dir / "other.json") == "{\"touchstone_scene\": 1}");
}

TEST_CASE("a certificate with a margin can be checked on its own, and its refutation replayed",
          "[certify][cli][margin]") {
  const Workspace w("certify-margin");
  const Run r = w.touchstone("certify --subject grid --margin 0.5 --limit 60 -o c.json");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find("margin 0.5: every pair") != std::string::npos);
  CHECK(w.touchstone("certify --check c.json").code == 0);
  // The lying engine ignores the margin.
  const Run lie = w.touchstone("certify --subject " + mutants +
                               "near_pairs_no_margin --margin 0.5 --limit 400 -o lie.json");
  INFO(lie.out << lie.err);
  CHECK(lie.code == 1);
  const Run replay = w.touchstone("replay lie.bodies.case.json --engines core");
  INFO(replay.out << replay.err);
  CHECK(replay.out.find("within the margin") != std::string::npos);
  CHECK(replay.code == 0);
}

TEST_CASE("a certificate can be checked on its own; a tampered one is not valid", "[certify][cli]") {
  const Workspace w("certify");
  const Run made = w.touchstone("certify --subject sort_and_sweep --limit 60 -o c.json --page c.html");
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  CHECK(made.out.find("sort_and_sweep: boxes certified, bodies certified") != std::string::npos);
  for (std::size_t a = 0; a < made.out.size(); a = made.out.find('\n', a) + 1)
    CHECK(made.out.find('\n', a) - a <= 80);
  const Run again = w.touchstone("certify --check c.json --jobs 2");
  INFO(again.out << again.err);
  CHECK(again.code == 0);
  // Without built pages there is only the certificate, and nothing overwrites it.
  if (fs::exists(TS_BINARY_DIR "/share/touchstone/web/certificate.html"))
    CHECK(read_all(w.dir / "c.html").find("histories_of_three") != std::string::npos);
  else
    CHECK(made.err.find("its data is in c.json") != std::string::npos);
  auto j = parsed<nlohmann::ordered_json>(read_all(w.dir / "c.json"));
  j["evidence"][0]["cases"] = 35152;
  w.write("tampered.json", j.dump());
  CHECK(w.touchstone("certify --check tampered.json").code == 1);
}

TEST_CASE("a plug-in that loses pairs is refuted by a script that replay accepts", "[certify][cli]") {
  const Workspace w("certify");
  const std::string subject = mutants + "stale_after_move";
  const Run r = w.touchstone("certify --subject " + subject +
                             " --level boxes --without no_boxes --limit 2000 -o c.json");
  INFO(r.out << r.err);
  REQUIRE(r.code == 1);
  const auto script = w.dir / "c.case.json";
  REQUIRE(fs::exists(script));
  const auto doc = parsed<nlohmann::json>(read_all(script));
  CHECK(doc.at("scene").at("bodies").size() == 2);
  CHECK(doc.at("scene").at("script").size() <= 6);
  CHECK(w.touchstone("replay c.case.json --engines " + subject + " --subject stale_after_move").code == 1);
  CHECK(w.touchstone("certify --check c.json --subject " + subject).code == 1);
  // A broad phase of the core is selected by name. The engine that the script refutes is named but not run.
  const Run others = w.touchstone("replay c.case.json --engines core,grid --subject grid");
  INFO(others.out << others.err);
  CHECK(others.code == 0);
  CHECK(others.out.find(":stale_after_move (not queried here") != std::string::npos);
  CHECK(others.out.find("grid") != std::string::npos);
}

TEST_CASE("engines --check explains what an engine gets wrong about the interface",
          "[certify][cli][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("certify");
  w.write("whole.py", python(R"(
  if m["ask"] != "overlap": say({"outcome": "unsupported"}); continue
  a, b = scene["bodies"][m["a"]], scene["bodies"][m["b"]]
  def half(x):
    s = scene["shapes"][x["shape"]]
    return [h / 2 for h in s["half_extents"]] if s["type"] == "box" else [s["radius"]] * 3 if s["type"] == "sphere" else None
  p, q = half(a), half(b)
  if p is None or q is None: say({"outcome": "unsupported"}); continue
  say({"overlap": all(abs(x - y) <= h + k for x, y, h, k in
       zip(a["pose"]["translation"], b["pose"]["translation"], p, q))})
)"));
  const Run r = w.touchstone("engines --check 'pipe:python3 whole.py'");
  INFO(r.out << r.err);
  CHECK(r.code == 1);
  CHECK(r.out.find("extents, not whole sides") != std::string::npos);
  CHECK(r.out.find("wrong        boxes take half extents") != std::string::npos);
  CHECK(r.out.find("right        two spheres apart") != std::string::npos);
  CHECK(w.touchstone("engines --check core").code == 0);
}

TEST_CASE("a command behind a pipe that dies or writes nonsense is refuted, and is not a failure of ours",
          "[certify][cli][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("certify");
  w.write("dies.py", python("  sys.exit('it died of ' + m['ask'])\n"));
  w.write("nonsense.py", python("  print('hello', flush=True)\n"));
  for (const char* file : {"dies.py", "nonsense.py"}) {
    const Run r =
        w.touchstone("certify --level boxes --limit 4 --subject 'pipe:python3 " + std::string(file) + "'");
    INFO(r.out << r.err);
    CHECK(r.code == 1);
    CHECK(r.out.find("crashed (orders_of_two, case 0)") != std::string::npos);
  }
}

TEST_CASE("FCL is told of a move in both ways; a removed body that it still names is stale, not a crash",
          "[certify][cli][optional]") {
  const Workspace w("certify");
  const Run there = w.touchstone("engines fcl-interval-tree-update-one");
  if (there.code != 0 || there.out.find("0.7.0") == std::string::npos)
    return skip("FCL 0.7.0 is not installed");
  const auto script = [](const std::string& halves, const std::string& steps) {
    return R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1, "shapes": [{"type": "box", "half_extents": )" +
           halves + R"(}, {"type": "box", "half_extents": [1, 1, 1]}], "bodies": [{"shape": 0}, {"shape": 1,
             "pose": {"translation": [0, 0, 0]}}], "script": [)" +
           steps + R"(, {"op": "query"}]}, "queries": [{"question": "candidates"}]})";
  };
  const std::string in = R"({"op": "insert", "body": 0}, )";
  w.write("moved.json",
          script("[1, 1, 1]", in + R"({"op": "insert", "body": 1, "pose": {"translation": [-4, -4, -2.5]}},
                         {"op": "move", "body": 1, "pose": {"translation": [0, 0, -1]}})"));
  w.write("removed.json",
          script("[0, 0, 0]", in + R"({"op": "insert", "body": 1}, {"op": "remove", "body": 0})"));
  const auto says = [&](const std::string& engine, const std::string& file) {
    return w.touchstone("replay " + file + " --engines " + engine + " --subject " + engine);
  };
  CHECK(says("fcl-interval-tree", "moved.json").code == 0);
  const Run lost = says("fcl-interval-tree-update-one", "moved.json");
  CHECK(lost.code == 1);
  CHECK(lost.out.find("missed: query 0: pair (0, 1)") != std::string::npos);
  for (const char* engine : {"fcl-interval-tree", "fcl-interval-tree-update-one"}) {
    const Run stale = says(engine, "removed.json");
    INFO(stale.out);
    CHECK(stale.code == 1);
    CHECK(stale.out.find("stale: query 0: pair (0, 1)") != std::string::npos);
  }
}

TEST_CASE("a subject that is too slow is not certified: exit code 3, which option to raise, no script",
          "[certify][cli][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("certify");
  w.write("slow.py", python(R"(
  while len(scene["steps"]) > 100: pass
  lists, here = [], set()
  for s in scene["steps"]:
    if s["op"] == "query": lists.append([[a, b] for a in here for b in here if a < b])
    elif s["op"] == "remove": here.remove(s["body"])
    else: here.add(s["body"])
  say({"pairs": lists})
)"));
  const Run r = w.touchstone(
      "certify --level boxes --limit 2 --case-seconds 0.1 --without no_boxes,long_scripts,longest_script "
      "--subject 'pipe:python3 slow.py'");
  INFO(r.out << r.err);
  CHECK(r.code == 3);
  CHECK(r.out.find("Level of boxes: not certified") != std::string::npos);
  CHECK(r.out.find("too slow for moving_crowds") != std::string::npos);
  CHECK(r.out.find("0.1 CPU s per question); raise --case-seconds") != std::string::npos);
  CHECK(r.out.find("refuted") == std::string::npos);
  CHECK(std::count(r.out.begin(), r.out.end(), '\n') < 60);
}
