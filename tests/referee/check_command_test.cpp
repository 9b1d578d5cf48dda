// The command `touchstone check`: its exit codes, on a finding as a campaign stores it.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

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

TEST_CASE("check exits 0 for a proof, 1 for none, 2 for bad input", "[referee][checker]") {
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
  CHECK(check(dir / "absent.json") == 2);
  CHECK(check(finding(R"({"kind": "none"})"), "--pair 0 7") == 2);
  std::filesystem::remove_all(dir);
}
