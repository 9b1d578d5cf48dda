// A user's own engine, as a plug-in or behind a pipe: batches, kinds of shapes, times, reproducers, triage.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

const std::string mutants = TS_BINARY_DIR "/lib/libtouchstone_mutants.so";

// Spheres and boxes that it takes for spheres; floats; with and without batches. Arguments: "batches" and
// what it does in a batch, "form=lines" if it answers a batch in lines, or with the radius above which it
// ends, or where it lies.
const char* const balls = R"(import json, math, struct, sys, time
options = dict(x.split("=") for x in sys.argv[1:])
def say(x, data=b""):
  sys.stdout.buffer.write(json.dumps(x).encode() + b"\n" + data)
  sys.stdout.buffer.flush()
def held(x): return struct.unpack("f", struct.pack("f", x))[0]
def answer(question, p, r, q, s):
  if max(r, s) > float(options.get("dies_above", "inf")): sys.exit("too large")
  n = [b - a for a, b in zip(p, q)]
  apart = math.sqrt(sum(x * x for x in n))
  gap = apart - r - s
  if r > float(options.get("lies_above", "inf")): gap += 0.25
  if question == "overlap": return {"overlap": gap <= 0}
  if question == "distance": return {"distance": gap}
  if gap > 0: return {"overlap": False}
  n = [x / apart for x in n] if apart > 0 else [0, 0, 1]
  return {"overlap": True, "normal": n, "depth": -gap, "points": [{"position": [a + r * x for a, x in zip(p, n)], "depth": -gap}]}
card = {"touchstone_pipe": 1, "name": "balls", "library": "balls", "version": "1", "settings": "", "unit_roundoff": 2**-24,
  "tau_factor": 64, "source": "", "receipts": True, "shapes": ["sphere"], "batches": "batches" in options}
if "states" in options: card["states_ns"] = True
say(card)
matrix = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]
radius = lambda s: held(s["radius"])
centre = lambda b: [held(x) for x in b["pose"]["translation"]]
def timed(x):
  if options.get("states") == "yes": x["ns"] = 1500
  return x
def many(m, data):
  n, k = m["count"], m["shapes"]
  if options["batches"] == "log": open("batches.log", "a").write("%d\n" % n)
  whole = struct.unpack_from("<%di" % (3 * k + 2 * n), data)
  at = 4 * len(whole) + 4 * (len(whole) % 2)
  sizes = struct.unpack_from("<%dd" % (4 * k), data, at)
  poses = struct.unpack_from("<%dd" % (14 * n), data, at + 32 * k)
  assert m["bytes"] == at + 32 * k + 8 * 14 * n and set(whole[:k]) == {0}
  found, receipts, points = [], [], []
  for i in range(n):
    a, b = [whole[3 * k + side * n + i] for side in (0, 1)]
    p, q = [[held(x) for x in poses[7 * (side * n + i):][:3]] for side in (0, 1)]
    r, s = held(sizes[4 * a]), held(sizes[4 * b])
    found.append(answer(m["ask_many"], p, r, q, s))
    receipts.append(([r, 0, 0, 0], [s, 0, 0, 0], p, q))
    points += [[i] + x["position"] + [x["depth"]] for x in found[-1].get("points", [])]
  if options.get("form") == "lines":
    lines = [json.dumps({"received": {"shapes": [{"shape": 0, "size": r[0]}, {"shape": 1, "size": r[1]}],
      "bodies": [{"body": j, "matrix": matrix, "translation": r[2 + j]} for j in (0, 1)]}, **f}) for f, r in zip(found, receipts)]
    return say({"answers": n, "lines": True}, "".join(x + "\n" for x in lines).encode())
  fields = {"overlap": ["overlap"], "distance": ["distance"], "contact": ["overlap", "normal", "depth"]}[m["ask_many"]]
  empty = {"normal": [0, 0, 0], "depth": 0.0}
  arrays = [[f.get(name, empty.get(name)) for f in found] for name in fields]
  arrays += [[r[j] for r in receipts] for j in range(4)] + [[matrix] * n, [matrix] * n]
  flat = [float(y) for array in arrays for x in array for y in (x if isinstance(x, list) else [x])]
  flat += [y for x in points for y in x]
  line = {"answers": n, "fields": fields + ["size_a", "size_b", "translation_a", "translation_b", "matrix_a", "matrix_b"],
    "points": len(points)}
  bad = options["batches"]
  if bad == "short": flat.pop()
  if bad == "fields": line["fields"][0] = "overlaps"
  if bad == "count": line["answers"] = n + 1
  say(timed(line), struct.pack("<%dd" % len(flat), *flat))
while True:
  line = sys.stdin.buffer.readline()
  if not line: break
  m = json.loads(line)
  if "scene" in m:
    scene = m["scene"]
    say({"received": {"shapes": [{"shape": i, "size": [radius(s)]} for i, s in enumerate(scene["shapes"])],
      "bodies": [{"body": i, "matrix": matrix, "translation": centre(b)} for i, b in enumerate(scene["bodies"])]}})
  elif "ask_many" in m: many(m, sys.stdin.buffer.read(m["bytes"]))
  elif m["ask"] not in ("overlap", "distance", "contact"): say({"outcome": "unsupported"})
  else:
    a, b = scene["bodies"][m["a"]], scene["bodies"][m["b"]]
    say(timed(answer(m["ask"], centre(a), radius(scene["shapes"][a["shape"]]), centre(b), radius(scene["shapes"][b["shape"]]))))
)";

const char* const pair_families = "--family separate,near,shallow,deep,contained --seed 3";

// Without the sandbox, because the command writes down how large its batches were.
Run fuzz(const Workspace& w, const std::string& options, const std::string& out, int cases) {
  return w.touchstone("fuzz --engines 'pipe:python3 balls.py" + options + "' --cases " +
                      std::to_string(cases) + " --out " + out + " --jobs 1 --no-sandbox " + pair_families);
}

Json summary(const Workspace& w, const std::string& out) {
  return parsed<Json>(read_all(w.dir / out / "summary.json"));
}

std::vector<std::string> keys(const Workspace& w, const std::string& campaign) {
  std::vector<std::string> all;
  if (fs::exists(w.dir / campaign / "findings"))
    for (const auto& e : fs::directory_iterator(w.dir / campaign / "findings"))
      all.push_back(e.path().filename().string());
  std::sort(all.begin(), all.end());
  return all;
}

std::string compile_line(const std::string& program) {
  const std::string mark = "//   g++ ";
  const std::size_t at = program.find(mark);
  return at == std::string::npos ? "" : program.substr(at + 5, program.find(" && ", at) - at - 5);
}

}  // namespace

TEST_CASE("a campaign with batches finds the same as one without, byte for byte", "[pipe][batch][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("batches");
  w.write("balls.py", balls);
  for (const auto& [what, word] :
       {std::pair("lies_above=1.1", "distance_off"), {"dies_above=1.15", "crashed"}}) {
    const std::string option = std::string(" ") + what;
    fs::remove(w.dir / "batches.log");
    const Run without = fuzz(w, option, std::string("one-") + what, 160);
    REQUIRE(without.code == 1);
    for (const std::string form : {"arrays", "lines"}) {
      const std::string out = form + "-" + what;
      const Run with = fuzz(w, option + " batches=log form=" + form, out, 160);
      INFO(without.out << without.err << with.out << with.err);
      REQUIRE(with.code == 1);
      CHECK(summary(w, std::string("one-") + what).at("digest") == summary(w, out).at("digest"));
      const auto found = keys(w, out);
      CHECK(found == keys(w, std::string("one-") + what));
      CHECK(std::any_of(found.begin(), found.end(), [&, word = word](const std::string& k) {
        return k.find(word) != std::string::npos;
      }));
    }
    std::istringstream log(read_all(w.dir / "batches.log"));
    int largest = 0;
    for (int n; log >> n;) largest = std::max(largest, n);
    CHECK(largest > 8);
  }
}

TEST_CASE("a batch answered in another form than asked is a crash with its reason",
          "[pipe][batch][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("batches");
  w.write("balls.py", balls);
  const std::pair<const char*, const char*> forms[] = {{"fields", "an unknown field: overlaps"},
                                                       {"count", "another number of pairs than asked"}};
  for (const auto& [form, reason] : forms) {
    const Run r = fuzz(w, std::string(" batches=") + form, form, 32);
    INFO(r.out << r.err);
    CHECK(r.code == 1);
    std::string all;
    for (const std::string& key : keys(w, form))
      all += read_all(w.dir / form / "findings" / key / "finding.json");
    CHECK(all.find(reason) != std::string::npos);
  }
}

TEST_CASE("times that a command states are its own; others are marked", "[pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("times");
  w.write("balls.py", balls);
  const Run plain =
      w.touchstone("fuzz --verbose --engines 'pipe:python3 balls.py' --cases 64 --out plain --seed 3");
  INFO(plain.out << plain.err);
  CHECK(plain.out.find("the time includes the pipe") != std::string::npos);
  CHECK(summary(w, "plain").at("engines").at("balls").at("overlap").at("times_include_pipe") == true);
  const Run stated = w.touchstone(
      "fuzz --verbose --engines 'pipe:python3 balls.py states=yes' --cases 64 --out stated --seed 3");
  INFO(stated.out << stated.err);
  CHECK(stated.out.find("includes the pipe") == std::string::npos);
  const Json overlap = summary(w, "stated").at("engines").at("balls").at("overlap");
  CHECK_FALSE(overlap.contains("times_include_pipe"));
  CHECK(overlap.at("ns_median").get<double>() == Approx(1500).epsilon(0.1));
  const Run promised =
      w.touchstone("fuzz --engines 'pipe:python3 balls.py states=no' --cases 32 --out no --seed 3");
  CHECK(promised.code == 1);
  INFO(promised.out);
  CHECK(promised.out.find("Crashed") != std::string::npos);
}

TEST_CASE("cases are made of the kinds that the subject's card lists; what nobody takes is not refereed",
          "[pipe][card][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("kinds");
  w.write("balls.py", balls);
  const Run alone = w.touchstone("fuzz --engines 'pipe:python3 balls.py' --cases 320 --out alone --seed 3");
  INFO(alone.out << alone.err);
  CHECK(alone.code == 0);
  const Json a = summary(w, "alone"), outcomes = a.at("engines").at("balls").at("overlap").at("outcomes");
  CHECK(outcomes.at("answered").get<int>() > 10 * outcomes.at("unsupported").get<int>());
  const Run beside = w.touchstone(
      "fuzz --engines 'pipe:python3 balls.py,core' --subject core --family separate --cases 160 --out beside "
      "--seed 3");
  INFO(beside.out << beside.err);
  const Json b = summary(w, "beside").at("engines");
  CHECK(b.at("core").at("overlap").at("outcomes").at("unsupported") == 0);
  CHECK(b.at("balls").at("overlap").at("outcomes").at("unsupported").get<int>() > 100);
  const Run mesh =
      w.touchstone("fuzz --engines 'pipe:python3 balls.py' --family mesh --cases 32 --out mesh --seed 3");
  INFO(mesh.out << mesh.err);
  CHECK(mesh.code == 3);
  CHECK(mesh.out.find("32 cases that no engine answers were not refereed") != std::string::npos);
  CHECK(summary(w, "mesh").at("pair_cases") == 0);
}

TEST_CASE("a finding about a plug-in is shown by a program that loads it", "[reproduce][optional]") {
  if (touchstone::test::is_sanitized) return skip("the plug-in needs the sanitizers' runtime");
  const Workspace w("plugin-program");
  int shown = 0;
  for (const char* name : {"depth_halved", "distance_absolute", "normal_flipped"}) {
    const std::string engine = mutants + ":" + name;
    w.touchstone("fuzz --seed 3 --cases 60 --relations 0 --engines " + engine + " --out " + name);
    const auto found = keys(w, name);
    INFO(name);
    REQUIRE_FALSE(found.empty());
    for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 2); ++i) {
      const Run made = w.touchstone("reproduce " + std::string(name) + "/findings/" + found[i] +
                                    " --engine " + engine + " -o reproduce.cpp");
      INFO(found[i] << made.err);
      REQUIRE(made.code == 0);
      const std::string program = read_all(w.dir / "reproduce.cpp");
      const Run compiled = w.run(compile_line(program) + " -Wall -Wextra -Werror");
      INFO(compiled.err);
      REQUIRE(compiled.code == 0);
      const Run result = w.run("./reproduce");
      INFO(result.out);
      CHECK(result.code == 1);
      CHECK(result.out.find("WRONG") != std::string::npos);
      // The same question to an engine that is right about it.
      std::string right = program;
      const std::string named = "engine_name = \"" + std::string(name) + "\"";
      REQUIRE(right.find(named) != std::string::npos);
      w.write("reproduce.cpp",
              right.replace(right.find(named), named.size(), "engine_name = \"last_pair_dropped\""));
      REQUIRE(w.run(compile_line(program)).code == 0);
      CHECK(w.run("./reproduce").code == 0);
      ++shown;
    }
  }
  CHECK(shown >= 4);
}

TEST_CASE("a finding about a command is shown by the lines that it gets", "[reproduce][pipe][optional]") {
  if (!has_command("python3")) return skip("python3 is not installed");
  const Workspace w("pipe-program");
  w.write("balls.py", balls);
  w.write("two.json", R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1,
  "shapes": [{"type": "sphere", "radius": 1.5}],
  "bodies": [{"shape": 0}, {"shape": 0, "pose": {"translation": [4, 0, 0]}}]},
  "queries": [{"question": "distance", "a": 0, "b": 1}]})");
  const Run made =
      w.touchstone("reproduce two.json --engine 'pipe:python3 balls.py lies_above=1' -o reproduce.jsonl");
  INFO(made.out << made.err);
  REQUIRE(made.code == 0);
  const std::string lines = read_all(w.dir / "reproduce.jsonl");
  CHECK(lines.find("apart, signed distance within [") != std::string::npos);
  const Run answers = w.run("python3 balls.py lies_above=1 <reproduce.jsonl");
  INFO(answers.out << answers.err);
  CHECK(answers.out.find("{\"distance\": 1.25}") != std::string::npos);
}

TEST_CASE("triage asks a plug-in again, and writes its program, if the command line names it", "[triage]") {
  const Workspace w("plugin-triage");
  const std::string engine = mutants + ":depth_halved";
  const Run run = w.touchstone("fuzz --seed 3 --cases 40 --relations 0 --engines " + engine + " --out run");
  const std::size_t named = run.out.find("causes run --engines ");
  REQUIRE(named != std::string::npos);
  CHECK(run.out.find(engine, named) != std::string::npos);
  for (const char* how : {"--engines ", "--subject "}) {
    fs::remove_all(w.dir / "kept");
    fs::remove(w.dir / "run/causes.json");
    const Run r = w.touchstone("triage run --ledger new.db --reproducers kept --date 2026-01-02 " +
                               std::string(how) + engine);
    INFO(r.out << r.err);
    CHECK(r.code == 1);
    fs::remove(w.dir / "new.db");
    int programs = 0;
    for (const auto& cause : fs::directory_iterator(w.dir / "kept"))
      programs += read_all(cause.path() / "reproduce.cpp").find("touchstone_engine.h") != std::string::npos;
    CHECK(programs > 0);
  }
}

TEST_CASE("the example on NumPy arrays is right", "[pipe][batch][optional]") {
  if (!has_command("python3") || std::system("python3 -c 'import numpy' 2>/dev/null") != 0)
    return skip("NumPy is not installed");
  const Workspace w("arrays");
  fs::copy(TS_SOURCE_DIR "/oracles/example/arrays.py", w.dir / "arrays.py");
  const Run checked = w.touchstone("engines --check 'pipe:python3 arrays.py'");
  INFO(checked.out << checked.err);
  CHECK(checked.code == 0);
  const Run run = w.touchstone("fuzz --engines 'pipe:python3 arrays.py' --cases 400 --out out");
  INFO(run.out << run.err);
  CHECK(run.code == 0);
  CHECK(run.out.find("about arrays: 0 wrong in") != std::string::npos);
}

TEST_CASE("the example in Rust is right", "[plugin][optional]") {
  if (!has_command("rustc")) return skip("rustc is not installed");
  const Workspace w("rust");
  const std::string source = TS_SOURCE_DIR "/oracles/example/example_engine.rs";
  const Run built =
      w.run("rustc -O --edition 2021 --crate-type cdylib -D warnings " + source + " -o libmine.so");
  INFO(built.out << built.err);
  REQUIRE(built.code == 0);
  const Run checked = w.touchstone("engines --check ./libmine.so");
  INFO(checked.out << checked.err);
  CHECK(checked.code == 0);
  CHECK(checked.out.find("example-rust: 6 right, 0 wrong") != std::string::npos);
  const Run run = w.touchstone("fuzz --engines ./libmine.so --cases 400 --out out");
  INFO(run.out << run.err);
  CHECK(run.code == 0);
  CHECK(run.out.find("about example-rust: 0 wrong in") != std::string::npos);
}
