// The command `touchstone check`: its exit codes, on a finding as a campaign stores it.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/catch.h"

namespace {

int check(const std::filesystem::path& file, const std::string& more = "") {
  const std::string command =
      std::string(TS_BINARY_DIR) + "/bin/touchstone check " + file.string() + " " + more + " >/dev/null 2>&1";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::filesystem::path write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

}  // namespace

TEST_CASE("check exits with 0 for a proof, 1 without one, 2 for bad input", "[referee][checker]") {
  const auto dir = std::filesystem::temp_directory_path() / ("touchstone-check-" + std::to_string(getpid()));
  std::filesystem::create_directories(dir);
  write(dir / "case.json", R"({"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 1}],
    "bodies": [{"shape": 0, "pose": {"translation": [0, 0, 0]}},
               {"shape": 0, "pose": {"translation": [3, 0, 0]}}]})");
  const auto finding = [&](const std::string& certificate) {
    return write(dir / "finding.json", "{\"key\": \"k\", \"certificate\": " + certificate + "}");
  };
  CHECK(check(finding(R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 1})")) == 0);
  CHECK(check(finding(R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 2})"),
              "--pair 0 1") == 1);
  CHECK(check(finding(R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 0.99})")) == 1);
  CHECK(check(finding(R"({"kind": "common_point", "point": [1, 0, 0]})")) == 1);
  CHECK(check(finding(R"({"kind": "none"})")) == 1);
  CHECK(check(finding(R"({"kind": "common_point", "rationals": ["1", "0", "1/0"]})")) == 2);
  CHECK(check(finding(R"({"kind": "rumour"})")) == 2);
  CHECK(check(finding(R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 1, "step": -5})")) ==
        2);
  CHECK(check(finding(R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 1, "step": "a"})")) ==
        2);
  CHECK(check(dir / "absent.json") == 2);
  CHECK(check(finding(R"({"kind": "none"})"), "--pair 0 7") == 2);
  std::filesystem::remove_all(dir);
}

TEST_CASE("check makes a deferred certificate and writes it by itself", "[referee][checker]") {
  const auto dir = std::filesystem::temp_directory_path() / ("touchstone-later-" + std::to_string(getpid()));
  std::filesystem::create_directories(dir);
  write(dir / "case.json", R"({"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 1}],
    "bodies": [{"shape": 0, "pose": {"translation": [0, 0, 0]}},
               {"shape": 0, "pose": {"translation": [3, 0, 0]}}]})");
  const auto finding = [&](const std::string& question) {
    return write(dir / "finding.json", R"({"key": "k", "observation": {"outcome": "answered"},
      "certificate": {"kind": "deferred", "question": ")" +
                                           question +
                                           R"(", "bodies": [0, 1], "found": {"kind": "separating_plane",
      "direction": [1, 0, 0], "offset": 7}}})");
  };
  const auto made = dir / "made.json";
  CHECK(check(finding("overlap"), "-o " + made.string()) == 0);
  CHECK(check(made) == 0);
  std::ifstream f(made);
  CHECK(nlohmann::ordered_json::parse(f).at("kind") == "separating_plane");
  CHECK(check(finding("rumour")) == 2);
  write(dir / "finding.json", R"({"certificate": {"kind": "deferred", "question": "overlap"}})");
  CHECK(check(dir / "finding.json") == 2);
  std::filesystem::remove_all(dir);
}

TEST_CASE(
    "check finds the two bodies of a crowd, their motion and their place in a script by the certificate",
    "[referee][checker]") {
  const auto dir = std::filesystem::temp_directory_path() / ("touchstone-crowd-" + std::to_string(getpid()));
  std::filesystem::create_directories(dir);
  // Balls of radius 1 at x = 0, 3, 6; the last moves by 2 per step, and the script moves it to x = 4.
  write(dir / "case.json", R"({"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 1}],
    "bodies": [{"shape": 0, "pose": {"translation": [0, 0, 0]}}, {"shape": 0, "pose": {"translation": [3, 0, 0]}},
               {"shape": 0, "pose": {"translation": [6, 0, 0]}, "motion": {"linear": [-2, 0, 0]}}],
    "script": [{"op": "insert", "body": 1}, {"op": "query"}, {"op": "insert", "body": 2},
               {"op": "move", "body": 2, "pose": {"translation": [4, 0, 0]}}, {"op": "query"}]})");
  const auto with = [&](const std::string& certificate) { return write(dir / "c.json", certificate); };
  const std::string plane = R"({"kind": "separating_plane", "direction": [1, 0, 0], "offset": 1)";
  CHECK(check(with(plane + "}")) == 2);  // names no pair
  CHECK(check(with(plane + R"(, "bodies": [0, 1]})")) == 0);
  CHECK(check(with(plane + R"(, "bodies": [0, 2]})")) == 0);
  CHECK(check(with(plane + R"(, "bodies": [1, 2]})")) == 1);
  CHECK(check(with(plane + R"(, "bodies": [1, 2]})"), "--pair 0 1") == 0);
  CHECK(check(with(plane + R"(, "bodies": [1, 7]})")) == 2);
  CHECK(check(with(plane + R"(, "bodies": [1]})")) == 2);
  CHECK(check(with(plane + R"(, "bodies": "both"})")) == 2);
  const std::string point = R"({"kind": "common_point", "point": [3.5, 0, 0], "bodies": [1, 2])";
  CHECK(check(with(point + "}")) == 1);
  CHECK(check(with(point + R"(, "step": 1})")) == 0);
  CHECK(check(with(point + R"(, "step": 0})")) == 2);  // body 2 is not inserted yet
  // Relative to ball 2, ball 1 moves by +2 per step from x = -3: they meet at t = 1/2.
  const auto impact = [](const std::string& until, const std::string& t) {
    return R"({"kind": "impact", "bodies": [1, 2], "clear_until": )" + until +
           R"(, "planes": [[{"t": 0, "direction": ["1", "0", "0"], "offset": "-11/10"}, {"t": )" + until +
           R"(, "direction": ["1", "0", "0"], "offset": "-11/10"}]], "contact": {"t": ")" + t +
           R"(", "point": ["-1", "0", "0"]}})";
  };
  CHECK(check(with(impact("0.4375", "1/2"))) == 0);
  CHECK(check(with(impact("0.5", "1/2"))) == 1);
  CHECK(check(with(impact("0.4375", "7/16"))) == 1);
  CHECK(check(with(impact("0.4375", "0.5"))) == 2);
  CHECK(check(with(R"({"kind": "impact", "bodies": [1, 2]})")) == 1);
  CHECK(check(with(R"({"kind": "impact", "bodies": [1, 2], "planes": []})")) == 2);
  std::filesystem::remove_all(dir);
}

TEST_CASE(
    "what replay --json --certificates prints of a verdict and of a time of impact is accepted by check",
    "[referee][checker]") {
  const auto dir = std::filesystem::temp_directory_path() / ("touchstone-replay-" + std::to_string(getpid()));
  std::filesystem::create_directories(dir);
  write(dir / "case.json", R"({"touchstone_case": 1, "scene": {"touchstone_scene": 1,
    "shapes": [{"type": "sphere", "radius": 0.1}, {"type": "box", "half_extents": [0.1, 0.2, 0.3]}],
    "bodies": [{"shape": 0, "pose": {"translation": [7, 7, 7]}},
               {"shape": 0, "pose": {"translation": [0.3, 0.1, 0]}, "motion": {"linear": [-1, 0, 0]}},
               {"shape": 1, "pose": {"translation": [0, 0, 0], "rotation": [0.1, 0.2, 0.3, 1]},
                "motion": {"angular": [1, 2, 3]}}]},
    "queries": [{"question": "overlap", "a": 1, "b": 2}, {"question": "time_of_impact", "a": 1, "b": 2}]})");
  const std::string replay =
      std::string(TS_BINARY_DIR) + "/bin/touchstone replay --json --certificates --engines core " +
      (dir / "case.json").string() + " > " + (dir / "replay.json").string() + " 2>/dev/null";
  REQUIRE(WEXITSTATUS(std::system(replay.c_str())) <= 1);
  std::ifstream f(dir / "replay.json");
  const auto j = nlohmann::ordered_json::parse(f);
  const auto& queries = j.at(0).at("queries");
  REQUIRE(queries.size() == 2);
  const auto certificate = [&](std::size_t i, const char* key) {
    return check(write(dir / "c.json", queries.at(i).at("referee").at(key).dump()));
  };
  CHECK(queries.at(1).at("referee").at("verdict") == "impact");
  CHECK(certificate(0, "verdict_certificate") == 0);
  CHECK(certificate(1, "certificate") == 0);
  std::filesystem::remove_all(dir);
}
