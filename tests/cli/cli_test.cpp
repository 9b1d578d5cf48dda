// The command line as a user meets it: exit codes and messages.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/causes_by_hand.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone::test;
namespace fs = std::filesystem;

namespace {

const std::string two_spheres = R"({"touchstone_scene":1,"shapes":[{"type":"sphere","radius":1}],
"bodies":[{"shape":0,"pose":{"translation":[0,0,0],"rotation":[0,0,0,1]}},
{"shape":0,"pose":{"translation":[X,0,0],"rotation":[0,0,0,1]}}]})";

std::string spheres(const std::string& x) {
  std::string s = two_spheres;
  s.replace(s.find('X'), 1, x);
  return s;
}

std::size_t longest_line(const std::string& s) {
  std::size_t longest = 0, start = 0;
  while (start < s.size()) {
    const std::size_t end = std::min(s.find('\n', start), s.size());
    std::size_t columns = 0;
    for (std::size_t i = start; i < end; ++i) columns += (static_cast<unsigned char>(s[i]) & 0xc0) != 0x80;
    longest = std::max(longest, columns);
    start = end + 1;
  }
  return longest;
}

const std::string mutant = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";
const std::string program = TS_BINARY_DIR "/bin/touchstone ";

}  // namespace

TEST_CASE("bad usage and bad input exit with 2 and one line that names the place", "[cli]") {
  const Workspace w("cli");
  w.write("truncated.json", spheres("1").substr(0, 60));
  w.write("nan.json", spheres("NaN"));
  w.write("infinite.json", spheres("1e999"));
  w.write("unknown.json", R"({"touchstone_scene":1,"shapes":[{"type":"torus","radius":1}],"bodies":[]})");
  std::string zero = spheres("1");
  zero.replace(zero.find("[0,0,0,1]"), 9, "[0,0,0,0]");
  w.write("zero_quaternion.json", zero);
  std::string negative = spheres("1");
  negative.replace(negative.find("\"radius\":1"), 10, "\"radius\":-1");
  w.write("negative.json", negative);
  std::ofstream(w.dir / "huge.json").close();
  fs::resize_file(w.dir / "huge.json", std::uintmax_t{1} << 30);
  const char* commands[] = {"replay missing.json",
                            "replay truncated.json",
                            "replay nan.json",
                            "replay infinite.json",
                            "replay unknown.json",
                            "replay zero_quaternion.json",
                            "replay negative.json",
                            "replay huge.json",
                            "fuzz --subject ./libmissing.so",
                            "fuzz --engines core,nothing",
                            "fuzz --family nothing",
                            "fuzz --shard 3/2",
                            "scenarios nothing"};
  for (const std::string command : commands) {
    const Run r = w.touchstone(command);
    INFO(command << " printed: " << r.err);
    CHECK(r.code == 2);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK(r.out.empty());
    const std::string place = command.substr(command.find_last_of(" /,") + 1);
    if (command.starts_with("replay")) CHECK(r.err.find(place) != std::string::npos);
  }
  CHECK(w.touchstone("").code == 2);
  CHECK(w.touchstone("nonsense").code == 2);
  CHECK(w.touchstone("fuzz --cases -3").code == 2);
  CHECK(w.touchstone("plan thousand_balls --error nan").code == 2);
  CHECK(w.touchstone("plan thousand_balls --error 1e-30").code == 2);
  CHECK(w.touchstone("plan thousand_balls --use spheres.json").code == 2);
  CHECK(w.touchstone("--help").code == 0);
}

TEST_CASE("replay shows every engine's answer beside the referee's", "[cli]") {
  const Workspace w("cli");
  w.write("spheres.json", spheres("1.5"));
  const Run r = w.touchstone("replay spheres.json");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find("referee: overlap") != std::string::npos);
  CHECK(r.out.find("core") != std::string::npos);
  CHECK(longest_line(r.out) <= 80);
  const Run j = w.touchstone("replay spheres.json --json --engines core");
  const auto doc = parsed<nlohmann::json>(j.out);
  CHECK(doc.at(0).at("queries").at(2).at("engines").at("core").at("answer").at("depth") == 0.5);
}

TEST_CASE("a campaign prints its table in 80 columns", "[cli]") {
  const Workspace w("cli");
  const Run r = w.touchstone("fuzz --cases 96 --seed 3 --jobs 2 --out results");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  // A command to copy stays on one line, however long its path.
  const auto command = r.out.find("/touchstone causes ");
  REQUIRE(command != std::string::npos);
  CHECK(longest_line(r.out.substr(0, r.out.rfind('\n', command))) <= 80);
  CHECK(last_line(r.out).starts_with("exit code 0 is about core: 0 wrong in "));
  CHECK(fs::exists(w.dir / "results" / "summary.json"));
}

TEST_CASE("a finding is replayed, shrinks from its directory and still shows", "[cli][optional]") {
  const Workspace w("cli");
  w.touchstone("fuzz --cases 96 --seed 3 --out results");
  if (!fs::exists(w.dir / "results" / "findings")) return skip("no findings: no other engine is installed");
  const auto first = fs::directory_iterator(w.dir / "results" / "findings")->path() / "case.json";
  const Run replayed = w.touchstone("replay " + first.string());
  CHECK(replayed.code == 0);
  const bool shown_again =
      replayed.out.find("WRONG") != std::string::npos || replayed.out.find("FAILED") != std::string::npos;
  CHECK(shown_again);
  std::size_t shrunk = 0, shown = 0;
  for (const auto& entry : fs::directory_iterator(w.dir / "results" / "findings")) {
    const std::string key = entry.path().filename();
    if (key.find("timed_out") != std::string::npos) continue;  // a second per question
    const Run r = w.touchstone("shrink " + entry.path().string() + " -o small.json --json");
    INFO(key << " printed: " << r.err);
    REQUIRE(r.code == 0);
    const auto doc = parsed<nlohmann::json>(r.out);
    CHECK(doc.at("key") == key);
    CHECK(doc.at("after").at("bodies") <= 2);
    const std::string engine = key.substr(0, key.find('.'));
    const Run again = w.touchstone("replay small.json --engines " + engine + " --subject " + engine);
    shown += again.code == 1;
    if (++shrunk == 6) break;
  }
  CHECK(shrunk == 6);
  // One may depend on earlier queries, as FCL's sweeps against meshes do.
  CHECK(shown >= 5);
  const Run clean = w.touchstone("shrink touching_boxes_nothing_of_this_name");
  CHECK(clean.code == 2);
}

TEST_CASE("a second triage of the same campaign finds nothing new", "[cli][optional]") {
  const Workspace w("cli");
  w.touchstone("fuzz --cases 96 --seed 3 --out results");
  if (!fs::exists(w.dir / "results" / "findings")) return skip("no findings: no other engine is installed");
  write_causes_by_hand(w.dir / "results");
  const Run first = w.touchstone("triage results --junit junit.xml");
  INFO(first.err);
  CHECK(first.code == 1);
  CHECK(read_all(w.dir / "junit.xml").find("<failure message=\"new\">") != std::string::npos);
  CHECK(w.touchstone("triage results --ledger other.db --subject core").code == 0);
  const Run second = w.touchstone("triage results --json");
  CHECK(second.code == 0);
  const auto doc = parsed<nlohmann::json>(second.out);
  CHECK(doc.size() > 10);
  for (const auto& f : doc) CHECK(f.at("standing") == "known");
  CHECK(w.touchstone("triage nowhere").code == 2);
}

TEST_CASE("shrink reports that there is nothing to shrink, and asks which finding when there are several",
          "[cli]") {
  const Workspace w("cli");
  w.write("spheres.json", spheres("1.5"));
  const Run clean = w.touchstone("shrink spheres.json");
  CHECK(clean.code == 3);
  CHECK(clean.err == "core is not found wrong\n");
  CHECK(w.touchstone("shrink spheres.json --key nobody.contact.missed.box-box.algorithm").code == 2);
}

TEST_CASE("shrink keeps a defensible case, and --smallest the minimum", "[cli]") {
  const Workspace w("cli");
  w.write("meeting.json", R"({"touchstone_case":1,"scene":{"touchstone_scene":1,"shapes":[
{"type":"sphere","radius":1.5}],"bodies":[{"shape":0},
{"shape":0,"pose":{"translation":[4.3,0.2,0]},"motion":{"linear":[-3,0,0],"angular":[0,0,0]}}]},
"queries":[{"question":"time_of_impact","a":0,"b":1}]})");
  const std::string shrink = "shrink meeting.json --engine " + mutant + "impact_denied ";
  const Run kept = w.touchstone(shrink + "--json");
  INFO(kept.out << kept.err);
  REQUIRE(kept.code == 0);
  const auto doc = parsed<nlohmann::json>(kept.out);
  CHECK(doc.at("defensible") == true);
  REQUIRE(doc.contains("other"));
  CHECK(doc.at("other").at("defensible") == false);
  CHECK(doc.at("other").at("after").at("bits") < doc.at("after").at("bits"));
  const Run smallest = w.touchstone(shrink + "--smallest -o small.json");
  CHECK(smallest.code == 0);
  CHECK(smallest.err.find("this is the smallest case; the defensible one has 2 bodies") != std::string::npos);
  CHECK(parsed<nlohmann::json>(read_all(w.dir / "small.json")) == doc.at("other").at("case"));
  const Run text = w.touchstone(shrink);
  CHECK(text.err.find("this is the defensible case; the smallest one has 2 bodies") != std::string::npos);
  CHECK(parsed<nlohmann::json>(text.out) == doc.at("case"));
}

TEST_CASE("a flat hull works and is reported as flat", "[cli]") {
  const Workspace w("cli");
  w.write("flat.json", R"({"touchstone_scene":1,"shapes":[
{"type":"hull","vertices":[[0,0,0],[1,0,0],[0,1,0]]},{"type":"hull","vertices":[[0,0,1]]}],
"bodies":[{"shape":0,"pose":{"translation":[0,0,0],"rotation":[0,0,0,1]}},
{"shape":1,"pose":{"translation":[0.25,0.25,0],"rotation":[0,0,0,1]}}]})");
  const Run r = w.touchstone("replay flat.json --engines core");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find("flat: a polygon") != std::string::npos);
  CHECK(r.out.find("flat: a point") != std::string::npos);
  CHECK(r.out.find("right   1\n") != std::string::npos);
}

TEST_CASE("an interrupted campaign keeps what it has and can be resumed", "[cli]") {
  const Workspace w("cli");
  const Run r = w.touchstone("fuzz --engines core --minutes 5 --jobs 1 --out half",
                             "timeout --preserve-status -s INT 2");
  INFO(r.out << r.err);
  CHECK(r.code == 3);
  CHECK(r.out.find("interrupted; resume") != std::string::npos);
  REQUIRE(fs::exists(w.dir / "half" / "state.json"));
  const auto state = parsed<nlohmann::json>(read_all(w.dir / "half" / "state.json"));
  CHECK(state.at("finished") == false);
  CHECK(state.at("result").at("cases") > 0);
  const Run on = w.touchstone("fuzz --engines core --minutes 0.01 --jobs 1 --out half");
  INFO(on.out << on.err);
  CHECK(on.code == 0);
}

TEST_CASE("a lying engine behind the C ABI is found by fuzz", "[cli]") {
  const Workspace w("cli");
  const std::string& plugin = mutant;
  // One for each question.
  for (const std::string name :
       {"boxes_one_ulp_small", "overlap_in_float", "distance_absolute", "normal_second_best",
        "impact_grazing_lost", "contact_depths_shifted", "refuses_flat_hulls"}) {
    const std::string engine = plugin + name;
    INFO(name);
    const Run r =
        w.touchstone("fuzz --cases 208 --subject " + engine + " --engines " + engine + " --out " + name);
    CHECK(r.code == 1);
    CHECK(r.out.find(name + ": WRONG in ") != std::string::npos);
  }
}

TEST_CASE("--error judges by the user's own tolerance", "[cli]") {
  const Workspace w("cli");
  w.write("apart.json", spheres("2.5"));
  const std::string replay =
      "replay apart.json --engines " TS_BINARY_DIR "/lib/libtouchstone_mutants.so:distance_absolute";
  const auto says = [&](const std::string& more, const char* word) {
    const Run r = w.touchstone(replay + more);
    INFO(more << r.out << r.err);
    CHECK(r.out.find(word) != std::string::npos);
  };
  says("", "WRONG");
  says(" --error 1nm", "right   0.5");
  says(" --error '1e-6 mm'", "right   0.5");
  says(" --error 1e-15", "WRONG");
  for (const char* none : {"3parsec", "0", "-1mm", "mm", "1e400"}) {
    const Run r = w.touchstone(replay + " --error " + none);
    INFO(none << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("--error") != std::string::npos);
  }
}

TEST_CASE("a wide claim of Bullet is named, and --error overrides it", "[cli][optional]") {
  const Workspace w("cli");
  w.write("links.json", R"({"touchstone_scene":1,"shapes":[{"type":"hull","vertices":
[[0,0,0],[0.1,0,0],[0,0.1,0],[0,0,0.1]]}],
"bodies":[{"shape":0,"pose":{"translation":[0,0,0],"rotation":[0,0,0,1]}},
{"shape":0,"pose":{"translation":[0.14,0,0],"rotation":[0,0,0,1]}}]})");
  const Run bullet = w.touchstone("replay links.json --engines bullet-f64-query");
  if (bullet.code == 2) return skip("Bullet is not installed");
  INFO(bullet.out << bullet.err);
  CHECK(bullet.out.find("right within its claimed tolerance of 0.08") != std::string::npos);
  const Run own = w.touchstone("replay links.json --engines bullet-f64-query --error 1mm");
  INFO(own.out << own.err);
  CHECK(own.out.find("claimed") == std::string::npos);
  CHECK(own.out.find("WRONG") != std::string::npos);
}

TEST_CASE("Bullet's margin rounds a cylinder above a half-space, as it claims", "[cli][optional]") {
  const Workspace w("cli");
  // An edge 0.01 deep in the ground; the cylinder is turned by an eighth about x.
  w.write("edge.json", R"({"touchstone_scene":1,"shapes":[{"type":"half_space","normal":[0,0,1],"offset":0},
{"type":"cylinder","radius":0.5,"half_height":1}],
"bodies":[{"shape":0,"static":true},{"shape":1,"pose":{"translation":[0,0,1.05066],
"rotation":[0.41421356237309503,0,0,1]}}]})");
  for (const std::string engine : {"bullet-f64-query", "bullet-f64-sim"}) {
    const Run r = w.touchstone("replay edge.json --engines " + engine);
    if (r.code == 2) return skip("Bullet is not installed");
    INFO(r.out << r.err);
    CHECK(r.code == 0);
    CHECK(r.out.find("WRONG") == std::string::npos);
  }
}

TEST_CASE("merge without arguments prints its usage", "[cli][merge]") {
  const Workspace w("merge");
  for (const char* arguments : {"merge", "merge out", "merge --ledgers all.db"}) {
    const Run r = w.touchstone(arguments);
    INFO(r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("touchstone merge OUT SHARD...") != std::string::npos);
  }
}

TEST_CASE("the exit code is about the chosen engine, by any of its names, and the last line tells which",
          "[cli]") {
  const Workspace w("cli");
  w.write("apart.json", spheres("3"));
  const std::string liar = mutant + "overlap_always";
  const auto replay = [&](const std::string& choice) { return w.touchstone("replay apart.json " + choice); };
  for (const std::string& choice :
       {"--engines " + liar, "--engines core," + liar + " --subject " + liar,
        "--engines core," + liar + " --subject overlap_always", "--engines core --subject " + liar}) {
    const Run r = replay(choice);
    INFO(choice << r.out << r.err);
    CHECK(r.code == 1);
    CHECK(last_line(r.out) == "exit code 1 is about overlap_always: wrong in 1 of 1 cases\n");
  }
  const Run core = replay("--engines core," + liar);
  CHECK(core.code == 0);
  CHECK(last_line(core.out) == "exit code 0 is about core: wrong in 0 of 1 cases\n");
  const Run unsaid = replay("--engines " + liar + "," + mutant + "distance_absolute");
  CHECK(unsaid.code == 2);
  CHECK(unsaid.err.find("--subject: which of ") != std::string::npos);
  const Run nobody = replay("--subject cor");
  CHECK(nobody.code == 2);
  CHECK(nobody.err.find("did you mean core") != std::string::npos);
  const Run silent = replay("--engines core-steps@4");  // answers only times of impact
  CHECK(silent.code == 3);
  CHECK(last_line(silent.out).find("answered nothing") != std::string::npos);
  const Run twice = replay("--subject " + liar + " --engines " + liar + ",./../../" + liar);
  CHECK(twice.code == 2);
  CHECK(twice.err.find("are both called overlap_always") != std::string::npos);
}

TEST_CASE("all may stand in a list of engines beside others", "[cli]") {
  const Workspace w("cli");
  const Run r = w.touchstone("replay spheres_kiss --json --engines all," + mutant + "overlap_always,core");
  const nlohmann::json engines = parsed<nlohmann::json>(r.out)[0]["queries"][0]["engines"];
  CHECK(engines.contains("overlap_always"));
  CHECK(engines.contains("core-f32"));
  CHECK(last_line(r.out + r.err).starts_with("exit code 0 is about core"));
}

TEST_CASE("a library's name stands for its engines", "[cli][optional]") {
  const Workspace w("library");
  const Run listed = w.touchstone("engines libccd");
  if (listed.code == 2) return skip("libccd is not installed");
  const Run replayed = w.touchstone("replay bullet_through_thin_wall --engines core,libccd");
  for (const char* name : {"libccd-gjk", "libccd-mpr-tuned"}) {
    CHECK(listed.out.find(name) != std::string::npos);
    CHECK(replayed.out.find(name) != std::string::npos);
  }
  const Run several = w.touchstone("reproduce bullet_through_thin_wall --engine libccd");
  CHECK(several.code == 2);
  CHECK(several.err.find("engine libccd: names more than one engine: libccd-gjk") != std::string::npos);
}

TEST_CASE("chart and stability refuse an unknown subject", "[cli]") {
  const Workspace w("cli");
  const std::string chart = "chart --from " TS_SOURCE_DIR "/docs/chart.json ";
  const Run liar = w.touchstone(chart + "--subject libccd-gjk");
  CHECK(liar.code == 1);
  CHECK(last_line(liar.out).starts_with("exit code 1 is about libccd-gjk: wrong in "));
  CHECK(w.touchstone(chart).code == 0);
  const Run unknown = w.touchstone(chart + "--subject libccd-gjc");
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("did you mean libccd-gjk") != std::string::npos);
  CHECK(w.touchstone("stability --engines core --subject nothing --out s").code == 2);
  CHECK(w.touchstone("chart --engines core --broad grid --subject nothing --out c").code == 2);
}

TEST_CASE("a misspelt name gets a suggestion, and a bad number an explanation", "[cli]") {
  const Workspace w("cli");
  const auto says = [&](const std::string& command, const std::string& words) {
    const Run r = w.touchstone(command);
    INFO(command << " printed: " << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find(words) != std::string::npos);
    CHECK(r.err.size() < 300);
  };
  says("fuzzz", "fuzzz: unknown command; did you mean fuzz?");
  says("certify --subject gird", "did you mean grid?");
  says("replay drake-1668-cubes-corner-overlp", "did you mean drake-1668-cubes-corner-overlap?");
  says("replay bullet_through_thin_wal", "did you mean bullet_through_thin_wall?");
  says("fuzz --engines fcl-libcd", "did you mean fcl-libccd");
  says("fuzz --cases -3", "-3 is not a positive whole number");
  says("fuzz --cases 1e4", "1e4 is not a positive whole number");
  says("fuzz --minutes 0", "0 is not a positive number");
}

TEST_CASE("cases of the corpus can be given by name", "[cli]") {
  const Workspace w("cli");
  for (const std::string name :
       {"drake-1668-cubes-corner-overlap", "corpus/drake-1668-cubes-corner-overlap"}) {
    const Run r = w.touchstone("replay " + name + " --engines core");
    INFO(r.err);
    CHECK(r.code == 0);
    CHECK(r.out.find("referee: overlap") != std::string::npos);
  }
  CHECK(w.touchstone("shrink drake-1668-cubes-corner-overlap").code == 3);  // the core is right
  fs::create_symlink("loop.json", w.dir / "loop.json");
  CHECK(w.touchstone("replay loop.json --engines core").code == 2);
}

TEST_CASE("one bad file does not affect the others", "[cli]") {
  const Workspace w("cli");
  w.write("apart.json", spheres("3"));
  w.write("bad.json", spheres("NaN"));
  const Run r =
      w.touchstone("replay apart.json bad.json touching_boxes_of_no_name apart.json --json --engines core");
  INFO(r.err);
  CHECK(r.code == 2);
  const auto doc = parsed<nlohmann::json>(r.out);
  REQUIRE(doc.size() == 4);
  CHECK(doc[0].contains("queries"));
  CHECK(doc[1].at("argument") == "bad.json");
  CHECK(doc[3].contains("queries"));
  CHECK(r.err.find("bad.json") != std::string::npos);
  CHECK(
      last_line(r.err).starts_with("exit code 2 is about bad.json: 2 of the arguments could not be judged"));
}

TEST_CASE("a result that cannot be written is refused before the work", "[cli]") {
  const Workspace w("cli");
  w.write("apart.json", spheres("3"));
  const std::string liar = mutant + "overlap_always";
  for (const std::string command : {"shrink", "reproduce"}) {
    const Run r = w.touchstone(command + " apart.json --engine " + liar + " -o apart.json/case.json");
    INFO(r.out << r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("cannot be created") != std::string::npos);
    CHECK(r.out.empty());
  }
}

TEST_CASE("the directory of a result is made", "[cli]") {
  const Workspace w("cli");
  const std::string arm = TS_SOURCE_DIR "/tests/scenarios/import/files/arm.urdf";
  CHECK(w.touchstone("import " + arm + " -o new/folder/arm.json").code == 0);
  CHECK(fs::exists(w.dir / "new/folder/arm.json"));
}

TEST_CASE("two campaigns cannot write to one directory; the lock ends with its process", "[cli]") {
  const Workspace w("cli");
  const std::string fuzz = program + "fuzz --engines core --jobs 1 --out one ";
  const Run second =
      w.run(fuzz + "--minutes 5 >/dev/null 2>&1 & p=$!; while [ ! -e one/state.json ]; do sleep 0.1; done; " +
            fuzz + "--minutes 0.01; r=$?; kill -9 $p; wait $p; exit $r");
  INFO(second.out << second.err);
  CHECK(second.code == 2);
  CHECK(second.err.find("one: is in use: process ") != std::string::npos);
  CHECK(w.run(fuzz + "--minutes 0.01").code == 0);
}

TEST_CASE("a finished campaign stays; --fresh moves it aside and loses nothing", "[cli]") {
  const Workspace w("cli");
  const std::string fuzz = "fuzz --engines core --cases 32 --out done ";
  REQUIRE(w.touchstone(fuzz).code == 0);
  const std::string before = read_all(w.dir / "done" / "summary.json");
  const Run again = w.touchstone(fuzz);
  CHECK(again.code == 2);
  CHECK(again.err.find("--fresh") != std::string::npos);
  CHECK(w.touchstone(fuzz + "--seed 2 --fresh").code == 0);
  CHECK(read_all(w.dir / "done.1" / "summary.json") == before);
  CHECK(w.touchstone(fuzz + "--fresh").code == 0);
  CHECK(fs::exists(w.dir / "done.2" / "summary.json"));
  CHECK(fs::exists(w.dir / "done" / "summary.json"));
}

TEST_CASE("a closed terminal interrupts a campaign like a kill", "[cli]") {
  const Workspace w("cli");
  const Run r = w.touchstone("fuzz --engines core --minutes 5 --jobs 1 --out half",
                             "timeout --preserve-status -s HUP 2");
  CHECK(r.code == 3);
  CHECK(last_line(r.out).find("interrupted; resume") != std::string::npos);
}

TEST_CASE("spheres 1e308 apart: derived cases beyond the range of doubles are not asked",
          "[cli][relations]") {
  const Workspace w("cli");
  w.write("far.json", spheres("1e308"));
  const Run r = w.touchstone("replay far.json --engines core");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  CHECK(r.out.find("relation_") == std::string::npos);
}

TEST_CASE("a cause that triage could not report is not known in the next run", "[cli][triage]") {
  const Workspace w("cli");
  const std::string liar = mutant + "overlap_always";
  REQUIRE(w.touchstone("fuzz --cases 64 --relations 0 --engines " + liar + " --out lies").code == 1);
  const std::string asked = "triage lies --engines " + liar, triage = asked + " --ledger known.db ";
  // Triage finds and stores the causes if nobody has yet.
  const Run first_of_all = w.touchstone(asked + " --ledger first.db");
  INFO(first_of_all.out << first_of_all.err);
  CHECK(first_of_all.code == 1);
  CHECK(first_of_all.err.find("representative findings reduced") != std::string::npos);
  CHECK(fs::exists(w.dir / "lies/causes.json"));
  write_causes_by_hand(w.dir / "lies");
  CHECK(w.touchstone(triage + "--junit /dev/full").code == 2);
  CHECK(w.run(program + triage + " >/dev/full").code == 3);
  const Run bad = w.touchstone(triage + "--junit lies/state.json/file.xml");
  CHECK(bad.code == 2);
  CHECK(w.touchstone(triage + "--date yesterday").code == 2);
  CHECK(w.touchstone(triage + "--subject overlap_alway").err.find("did you mean overlap_always?") !=
        std::string::npos);
  CHECK(w.touchstone(asked + " --ledger other.db --subject core").code ==
        3);  // the campaign did not query it
  const Run first = w.touchstone(triage + "--subject overlap_always --junit junit.xml --reproducers kept");
  INFO(first.out << first.err);
  CHECK(first.code == 1);
  CHECK(last_line(first.out).starts_with("exit code 1 is about overlap_always: "));
  CHECK(read_all(w.dir / "junit.xml").find("<failure message=\"new\">") != std::string::npos);
  CHECK(!fs::is_empty(w.dir / "kept"));
  const auto kept = fs::directory_iterator(w.dir / "kept")->path().string();
  CHECK(w.touchstone("shrink " + kept + " --engine " + liar + " -o small.json").code ==
        0);  // selected by its key
  // A later run that finds nothing: the plug-in is queried again only when it is named.
  REQUIRE(w.touchstone("fuzz --cases 32 --engines core --out clean").code == 0);
  write_causes_by_hand(w.dir / "clean");
  const auto standings = [&](const std::string& engines, const std::string& standing) {
    const Run r = w.touchstone("triage clean --ledger known.db --json " + engines);
    INFO(r.err);
    CHECK(r.code == 0);
    for (const auto& f : parsed<nlohmann::json>(r.out)) CHECK(f.at("standing") == standing);
  };
  standings("", "not asked");
  standings("--engines " + liar, "still");
  const Run empty = w.touchstone("triage clean --ledger known.db --reproducers none");
  CHECK(empty.err.find("0 written, 0 already there; this run added nothing") != std::string::npos);
}

TEST_CASE("a suppressed cause does not fail triage through its date, and then it does", "[cli][triage]") {
  const Workspace w("cli");
  const std::string liar = mutant + "overlap_always";
  REQUIRE(w.touchstone("fuzz --cases 64 --relations 0 --engines " + liar + " --out lies").code == 1);
  write_causes_by_hand(w.dir / "lies");
  const std::string triage = "triage lies --engines " + liar;
  const Run first = w.touchstone(triage + " --json --date 2026-11-01");
  REQUIRE(first.code == 1);
  const std::string id = parsed<nlohmann::json>(first.out).at(0).at("id");
  const std::string suppress = "triage --suppress " + id;
  for (const std::string& bad : std::initializer_list<std::string>{
           suppress, suppress + " --reason r", suppress + " --until 2099-01-01",
           suppress + " --reason r --until 2026-13-01", suppress + " --reason r --until 2020-01-01",
           suppress + "x --reason r --until 2099-01-01", "triage --suppress '' --reason r --until 2099-01-01",
           suppress + " --reason r --until 2099-01-01 --ledger none.db", "triage --unsuppress " + id,
           "triage lies --suppress " + id + " --reason r --until 2099-01-01", "triage"}) {
    const Run r = w.touchstone(bad);
    INFO(bad << ": " << r.out << r.err);
    CHECK(r.code == 2);
    CHECK_FALSE(fs::exists(w.dir / "none.db"));
  }
  const Run done = w.touchstone(suppress + " --reason 'known upstream' --until 2026-12-31 --date 2026-11-02");
  INFO(done.err);
  CHECK(done.code == 0);
  const Run before = w.touchstone(triage + " --date 2026-12-31 --junit j.xml"),
            after = w.touchstone(triage + " --date 2027-01-01");
  CHECK(before.code == 0);
  CHECK(before.out.find("until 2026-12-31: known upstream") != std::string::npos);
  CHECK(read_all(w.dir / "j.xml").find("suppressed until 2026-12-31: known upstream") != std::string::npos);
  CHECK(after.code == 1);
  CHECK(last_line(after.out).find("1 no longer suppressed") != std::string::npos);
  CHECK(w.touchstone("triage --unsuppress " + id).code == 0);
  CHECK(w.touchstone(triage + " --date 2027-01-01").code == 0);
}
