// Reproducers as an engine's developer meets them: one file, compiled against that engine only, that shows
// the fault.
#include <algorithm>
#include <set>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/causes_by_hand.h"
#include "tests/support/pair_case.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

// The compile command in the file's header comment.
std::string compile_line(const std::string& program) {
  const std::string mark = "//   g++ ";
  const std::size_t at = program.find(mark);
  return at == std::string::npos ? "" : program.substr(at + 5, program.find(" && ", at) - at - 5);
}

// "engine.question.fault" of a key.
std::string kind_of(const std::string& key) {
  std::size_t at = 0;
  for (int i = 0; i < 3; ++i) at = key.find('.', at) + 1;
  return key.substr(0, at - 1);
}

std::vector<std::string> findings(const Workspace& w, const std::string& engine,
                                  const std::string& campaign) {
  w.touchstone("fuzz --seed 3 --engines core," + engine + " --out " + engine + " " + campaign);
  std::vector<std::string> keys;
  if (!fs::exists(w.dir / engine / "findings")) return keys;
  for (const auto& e : fs::directory_iterator(w.dir / engine / "findings"))
    if (const std::string key = e.path().filename(); key.starts_with(engine + ".")) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

// A relation involves two scenes, so no program shows it.
bool is_relation(const std::string& key) { return key.find(".relation_") != std::string::npos; }

// For the first finding of each kind, up to `most`: the program compiles without a warning and shows the
// fault. 0 when the engine is not installed.
int shown(const Workspace& w, const std::string& engine, const std::string& campaign, int most) {
  std::set<std::string> kinds;
  int n = 0;
  for (const std::string& key : findings(w, engine, campaign)) {
    if (n == most) break;
    const bool no_program = is_relation(key) || key.find(".timed_out.") != std::string::npos;
    if (no_program || !kinds.insert(kind_of(key)).second) continue;
    CAPTURE(key);
    const Run made = w.touchstone("reproduce " + engine + "/findings/" + key + " -o reproduce.cpp");
    // For example, a contact between bodies that are apart within the tolerance.
    if (made.err.find("no program that checks this fault") != std::string::npos) {
      CHECK(made.code == 2);
      continue;
    }
    CHECK(made.err == "");
    REQUIRE(made.code == 0);
    const std::string line = compile_line(read_all(w.dir / "reproduce.cpp"));
    const Run compiled = w.run(line + " -Wall -Wextra -Werror");
    CHECK(compiled.err == "");
    REQUIRE(compiled.code == 0);
    const Run result = w.run("timeout 20 ./reproduce");
    CAPTURE(result.out);
    if (key.find(".crashed") != std::string::npos) {
      CHECK(result.code != 0);
    } else {
      CHECK(result.code == 1);
      CHECK(result.out.find("WRONG") != std::string::npos);
    }
    ++n;
  }
  return n;
}

// Both replay and a reproducer show the script that refutes a broad phase. False if it is not installed.
bool refutation_shown(const Workspace& w, const std::string& engine, const std::string& options) {
  if (w.touchstone("engines " + engine).code != 0) return false;
  const Run certified =
      w.touchstone("certify --subject " + engine + " -o c.json --script c.case.json " + options);
  INFO(engine << certified.out << certified.err);
  REQUIRE(certified.code == 1);
  CHECK(w.touchstone("replay c.case.json --engines core," + engine + " --subject " + engine).code == 1);
  CHECK(w.touchstone("replay c.case.json --engines core," + engine).code != 1);  // about the core
  const Run made = w.touchstone("reproduce c.case.json --engine " + engine + " -o reproduce.cpp");
  INFO(made.err);
  REQUIRE(made.code == 0);
  REQUIRE(w.run(compile_line(read_all(w.dir / "reproduce.cpp")) + " -Wall -Wextra -Werror").code == 0);
  const int shows = w.run("timeout 20 ./reproduce").code;
  // The allocator decides what freed memory holds: in this program it may be unchanged.
  CHECK((shows == 1 || (shows == 0 && engine == "fcl-dynamic-tree-array")));
  return true;
}

// Options that leave out all evidence except one.
std::string only(const std::string& evidence, const std::string& level) {
  std::string without;
  const std::vector<std::string> of_boxes{"orders_of_two",       "orders_on_an_axis", "histories_of_two",
                                          "histories_of_three",  "orders_of_three",   "cell_borders",
                                          "touching_by_an_ulp",  "sizes_far_apart",   "zeros_and_denormals",
                                          "far_from_the_origin", "huge_coordinates",  "long_scripts",
                                          "longest_script",      "moving_crowds",     "uniform_boxes",
                                          "unbounded",           "no_boxes"};
  for (const std::string& e : of_boxes)
    if (e != evidence) without += (without.empty() ? "" : ",") + e;
  return "--level " + level + (level == "boxes" ? " --without " + without : "");
}

}  // namespace

TEST_CASE("a program shows how a broad phase loses a pair: to a bad box, a rotated one or freed memory",
          "[reproduce][certify][optional]") {
  const Workspace w("reproduce");
  const int count = refutation_shown(w, "bullet-f64-dbvt", only("no_boxes", "boxes")) +
                    refutation_shown(w, "bullet-f64-dbvt", only("", "bodies")) +
                    refutation_shown(w, "ode-sap", only("no_boxes", "boxes")) +
                    refutation_shown(w, "fcl-dynamic-tree-array", only("", "bodies"));
  if (count == 0) skip("neither FCL nor Bullet nor ODE is installed: no refutations to show");
}

TEST_CASE("a finding about libccd is shown by a program that needs only libccd", "[reproduce][optional]") {
  const Workspace w("reproduce");
  const int n = shown(w, "libccd-mpr", "--cases 200", 4) + shown(w, "libccd-gjk-tuned", "--cases 200", 4);
  if (n == 0) return skip("no findings: libccd is not installed");
  CHECK(n >= 5);
}

TEST_CASE("a finding about Bullet is shown by a program that needs only Bullet", "[reproduce][optional]") {
  const Workspace w("reproduce");
  const int n =
      shown(w, "bullet-f64-query-tuned", "--cases 300", 8) + shown(w, "bullet-f32-sim", "--cases 600", 3);
  if (n == 0) return skip("no findings: Bullet is not installed");
  CHECK(n >= 6);
}

TEST_CASE("a finding about FCL is shown by a program that needs only FCL", "[reproduce][optional]") {
  const Workspace w("reproduce");
  const int n = shown(w, "fcl-indep", "--cases 200", 2);
  if (n == 0) return skip("no findings: FCL is not installed");
  CHECK(n == 2);
}

TEST_CASE("triage reports at once that it cannot create the directory for reproducers", "[reproduce]") {
  const Workspace w("reproduce");
  w.write("file", "");
  REQUIRE(w.touchstone("fuzz --cases 2 --engines core --out empty").code == 0);
  write_causes_by_hand(w.dir / "empty");
  for (const std::string taken : {"file", "file/below"}) {
    const Run r = w.touchstone("triage empty --reproducers " + taken);
    CHECK(r.code == 2);
    CHECK(r.err.find("--reproducers: " + taken + ": cannot create this directory") != std::string::npos);
  }
}

TEST_CASE("triage writes one directory per cause, which replay, check and reproduce accept",
          "[reproduce][optional]") {
  const Workspace w("reproduce");
  if (findings(w, "libccd-mpr", "--cases 60 --certificates").empty())
    return skip("no findings: libccd is not installed");
  const auto causes = causes_by_hand(w.dir / "libccd-mpr").causes;
  write_causes_by_hand(w.dir / "libccd-mpr");
  const Run first = w.touchstone("triage libccd-mpr --reproducers kept");
  INFO(first.err);
  REQUIRE(first.code == 1);
  int certificates = 0;
  for (const auto& cause : causes) {
    CAPTURE(cause.id);
    const fs::path kept = w.dir / "kept" / cause.id;
    REQUIRE(fs::exists(kept / "case.json"));
    const std::string engine = cause.path;
    CHECK(w.touchstone("replay " + kept.string() + " --engines " + engine).code == 1);
    CHECK(w.touchstone("reproduce " + kept.string() + " -o r.cpp").code ==
          (is_relation(cause.smallest.key) ? 2 : 0));
    if (!fs::exists(kept / "certificate.json")) continue;
    ++certificates;
    CHECK(w.touchstone("check " + (kept / "certificate.json").string()).code == 0);
    CHECK(w.touchstone("check " + (kept / "finding.json").string()).code == 0);
  }
  CHECK(certificates > 0);
  CHECK(w.touchstone("triage libccd-mpr --reproducers kept").err.find(" 0 written") != std::string::npos);
}

TEST_CASE("reproduce refuses what no program can show", "[reproduce]") {
  const Workspace w("reproduce");
  CHECK(w.touchstone("reproduce nothing_of_this_name").code == 2);
  const Run clean = w.touchstone("reproduce touching_boxes --engine core");
  CHECK((clean.code == 3 || clean.code == 2));
}

TEST_CASE("known faults of optional engines are shown by programs against the engine alone",
          "[optional_engines][reproduce][optional]") {
  const Workspace w("optional_faults");
  const std::string ball = R"({"type": "sphere", "radius": 1})",
                    cube = R"({"type": "box", "half_extents": [1, 1, 1]})";
  struct Known {
    const char *engine, *key;
    std::string text;
  };
  // Truth by hand. Two balls of radius 1 whose centres are 1/2048 apart need 2 - 1/2048, along the line of
  // their centres. A ball of radius 1 about the centre of a cube of side 2 needs 2, along an axis of the
  // cube.
  const Known all[] = {
      {"dart", "dart.contact.normal_not_unit.sphere-sphere.algorithm.solid.gross",
       pair_case(ball, ball, "contact", R"(, "pose": {"translation": [-0.00048828125, 0, 0]})")},
      {"mujoco2", "mujoco2.contact.infeasible.box-sphere.algorithm.solid.gross",
       pair_case(ball, cube, "contact")}};
  std::size_t shown = 0;
  for (const Known& k : all) {
    if (w.touchstone("engines " + std::string(k.engine)).code != 0) continue;
    w.write("known.json", k.text);
    const Run made = w.touchstone("reproduce known.json -o reproduce.cpp --engine " + std::string(k.engine) +
                                  " --key " + k.key);
    INFO(k.engine << made.out << made.err);
    REQUIRE(made.code == 0);
    const Run compiled = w.run(compile_line(read_all(w.dir / "reproduce.cpp")));
    INFO(compiled.out << compiled.err);
    REQUIRE(compiled.code == 0);
    const Run ran = w.run("./reproduce");
    INFO(ran.out << ran.err);
    CHECK(ran.code == 1);
    CHECK(ran.out.find("WRONG") != std::string::npos);
    ++shown;
  }
  if (shown == 0) skip("neither DART nor MuJoCo 2 is installed");
}
