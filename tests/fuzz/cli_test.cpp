// The command line as a user meets it: exit codes and messages.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/catch.h"
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
    INFO(command << " says: " << r.err);
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
  const auto doc = nlohmann::json::parse(j.out);
  CHECK(doc.at(0).at("queries").at(2).at("engines").at("core").at("answer").at("depth") == 0.5);
}

TEST_CASE("a campaign prints its table in 80 columns and leaves replayable findings", "[cli]") {
  const Workspace w("cli");
  const Run r = w.touchstone("fuzz --cases 96 --seed 3 --jobs 2 --out results");
  INFO(r.out << r.err);
  CHECK(r.code == 0);
  // A command to copy stays on one line, however long its path.
  const auto command = r.out.find("  ./touchstone replay");
  CHECK(longest_line(r.out.substr(0, command)) <= 80);
  CHECK(r.out.find("core: 0 wrong") != std::string::npos);
  REQUIRE(fs::exists(w.dir / "results" / "summary.json"));
  if (!fs::exists(w.dir / "results" / "findings")) {
    WARN("no oracle is installed: no findings to replay");
    return;
  }
  const auto first = fs::directory_iterator(w.dir / "results" / "findings")->path() / "case.json";
  const Run again = w.touchstone("replay " + first.string());
  CHECK(again.code == 0);
  CHECK((again.out.find("WRONG") != std::string::npos || again.out.find("FAILED") != std::string::npos));
}

TEST_CASE("a finding shrinks from its directory and still shows", "[cli]") {
  const Workspace w("cli");
  w.touchstone("fuzz --cases 96 --seed 3 --out results");
  if (!fs::exists(w.dir / "results" / "findings")) {
    WARN("no oracle is installed: no findings to shrink");
    return;
  }
  std::size_t shrunk = 0;
  for (const auto& entry : fs::directory_iterator(w.dir / "results" / "findings")) {
    const std::string key = entry.path().filename();
    if (key.find("timed_out") != std::string::npos) continue;  // a second a question
    const Run r = w.touchstone("shrink " + entry.path().string() + " -o small.json --json");
    INFO(key << " says: " << r.err);
    REQUIRE(r.code == 0);
    const auto doc = nlohmann::json::parse(r.out);
    CHECK(doc.at("key") == key);
    CHECK(doc.at("after").at("bodies") <= 2);
    const std::string engine = key.substr(0, key.find('.'));
    const Run again = w.touchstone("replay small.json --engines " + engine + " --subject " + engine);
    CHECK(again.code == 1);
    if (++shrunk == 6) break;
  }
  CHECK(shrunk == 6);
  const Run clean = w.touchstone("shrink touching_boxes_nothing_of_this_name");
  CHECK(clean.code == 2);
}

TEST_CASE("a second triage of the same campaign finds nothing new", "[cli]") {
  const Workspace w("cli");
  w.touchstone("fuzz --cases 96 --seed 3 --out results");
  if (!fs::exists(w.dir / "results" / "findings")) {
    WARN("no oracle is installed: no findings to triage");
    return;
  }
  const Run first = w.touchstone("triage results --no-shrink --junit junit.xml");
  INFO(first.err);
  CHECK(first.code == 1);
  CHECK(read_all(w.dir / "junit.xml").find("<failure message=\"new\">") != std::string::npos);
  CHECK(w.touchstone("triage results --no-shrink --ledger other.db --subject core").code == 0);
  const Run second = w.touchstone("triage results --json");
  CHECK(second.code == 0);
  const auto doc = nlohmann::json::parse(second.out);
  CHECK(doc.size() > 10);
  for (const auto& f : doc) CHECK(f.at("standing") == "known");
  CHECK(w.touchstone("triage nowhere").code == 2);
}

TEST_CASE("shrink says when there is nothing to shrink, and asks which finding when there are several",
          "[cli]") {
  const Workspace w("cli");
  w.write("spheres.json", spheres("1.5"));
  const Run clean = w.touchstone("shrink spheres.json");
  CHECK(clean.code == 3);
  CHECK(clean.err == "core is not found wrong\n");
  CHECK(w.touchstone("shrink spheres.json --key nobody.contact.missed.box-box.algorithm").code == 2);
}

TEST_CASE("a flat hull works and is called what it is", "[cli]") {
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

TEST_CASE("an interrupted campaign keeps what it has and goes on", "[cli]") {
  const Workspace w("cli");
  const Run r = w.touchstone("fuzz --engines core --minutes 5 --jobs 1 --out half",
                             "timeout --preserve-status -s INT 2");
  INFO(r.out << r.err);
  CHECK(r.code == 3);
  CHECK(r.out.find("interrupted; go on") != std::string::npos);
  REQUIRE(fs::exists(w.dir / "half" / "state.json"));
  const auto state = nlohmann::json::parse(read_all(w.dir / "half" / "state.json"));
  CHECK(state.at("finished") == false);
  CHECK(state.at("result").at("cases") > 0);
  const Run on = w.touchstone("fuzz --engines core --minutes 0.01 --jobs 1 --out half");
  INFO(on.out << on.err);
  CHECK(on.code == 0);
}

TEST_CASE("a lying engine behind the C ABI is found by fuzz", "[cli]") {
  const Workspace w("cli");
  const std::string plugin = TS_BINARY_DIR "/lib/libtouchstone_mutants.so:";
  // One of each question.
  for (const std::string name :
       {"boxes_one_ulp_small", "overlap_in_float", "distance_absolute", "normal_second_best",
        "impact_grazing_lost", "contact_depths_shifted", "refuses_flat_hulls"}) {
    const std::string engine = plugin + name;
    INFO(name);
    const Run r =
        w.touchstone("fuzz --cases 96 --subject " + engine + " --engines " + engine + " --out " + name);
    CHECK(r.code == 1);
    CHECK(r.out.find(name + ": WRONG in ") != std::string::npos);
  }
}

TEST_CASE("merge without arguments says what it wants", "[cli][merge]") {
  const Workspace w("merge");
  for (const char* arguments : {"merge", "merge out", "merge --ledgers all.db"}) {
    const Run r = w.touchstone(arguments);
    INFO(r.err);
    CHECK(r.code == 2);
    CHECK(r.err.find("touchstone merge OUT SHARD...") != std::string::npos);
  }
}
