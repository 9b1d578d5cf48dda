// Who may include whom: every #include line of the tree against one table.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/catch.h"

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> rooms = {
    "core/base",      "core/math",      "core/shape",    "core/scene",      "core/broad",      "core/narrow",
    "core/ccd",       "core/world",     "oracles/api",   "oracles/host",    "oracles/core",    "oracles/fcl",
    "oracles/bullet", "oracles/libccd", "oracles/ode",   "oracles/referee", "oracles/example", "scenarios",
    "fuzz/record",    "fuzz/judge",     "fuzz/generate", "fuzz/campaign",   "fuzz/shrink",     "fuzz/triage",
    "fuzz/explore",   "fuzz/reproduce", "fuzz/bisect",   "fuzz/certify",    "fuzz/libfuzzer",  "fuzz/cli",
    "reports"};

// The value types: scene.h and what it needs.
const std::vector<std::string> values = {"core/base", "core/math", "core/shape", "core/scene/scene.h",
                                         "core/tolerance.h"};

std::vector<std::string> with_values(std::vector<std::string> more) {
  more.insert(more.end(), values.begin(), values.end());
  return more;
}

const std::map<std::string, std::vector<std::string>> may_include = {
    {"core/base", values},
    {"core/math", values},
    {"core/shape", values},
    {"core/scene", with_values({"core/scene"})},
    {"core/broad", with_values({"core/broad"})},
    {"core/narrow", with_values({"core/narrow"})},
    {"core/ccd", with_values({"core/ccd", "core/narrow", "core/broad"})},
    {"core/world", with_values({"core/world", "core/ccd", "core/narrow", "core/broad"})},
    {"oracles/api", with_values({"oracles/api"})},
    {"oracles/host", with_values({"oracles/host", "oracles/api"})},
    {"oracles/core",
     with_values({"oracles/core", "oracles/api", "core/broad", "core/narrow", "core/ccd", "core/world"})},
    {"oracles/fcl", with_values({"oracles/fcl", "oracles/api"})},
    {"oracles/bullet", with_values({"oracles/bullet", "oracles/api"})},
    {"oracles/libccd", with_values({"oracles/libccd", "oracles/api"})},
    {"oracles/ode", with_values({"oracles/ode", "oracles/api"})},
    {"oracles/example", {"oracles/api/touchstone_engine.h"}},
    {"oracles/referee", with_values({"oracles/referee"})},
    {"scenarios", with_values({"scenarios", "core/scene", "oracles/api/observation.h"})},
    {"fuzz/judge", with_values({"fuzz/judge", "core/scene/odd_numbers.h", "oracles/api",
                                "oracles/referee/referee.h", "oracles/referee/contact_region.h"})},
    // Records are stored: the scene's text form and the one writer of JSON are what they are stored with.
    {"fuzz/record",
     with_values({"fuzz/record", "fuzz/judge", "oracles/api", "scenarios", "core/scene/codec.h",
                  "core/scene/json_file.h", "oracles/referee/impact_certificate.h"})},
    {"fuzz/generate", with_values({"fuzz/generate", "oracles/api/observation.h"})},
    {"fuzz/campaign", with_values({"fuzz/campaign", "fuzz/generate", "fuzz/judge", "fuzz/record",
                                   "core/scene", "scenarios", "oracles/api"})},
    {"fuzz/shrink", with_values({"fuzz/shrink", "fuzz/campaign", "fuzz/generate", "fuzz/record",
                                 "oracles/api", "core/scene/odd_numbers.h"})},
    {"fuzz/libfuzzer", with_values({"fuzz/libfuzzer", "fuzz/generate", "fuzz/campaign", "fuzz/record",
                                    "scenarios", "core/scene", "oracles/api", "oracles/core"})},
    {"fuzz/certify", with_values({"fuzz/certify", "fuzz/generate", "fuzz/judge", "fuzz/record", "fuzz/shrink",
                                  "oracles/api"})},
    {"fuzz/bisect",
     with_values({"fuzz/bisect", "fuzz/shrink", "fuzz/judge", "fuzz/record", "scenarios", "oracles/api"})},
    {"fuzz/reproduce",
     with_values({"fuzz/reproduce", "fuzz/record", "fuzz/judge", "core/scene", "oracles/api"})},
    {"fuzz/triage",
     with_values({"fuzz/triage", "fuzz/shrink", "fuzz/record", "core/scene", "scenarios", "oracles/api"})},
    {"fuzz/explore",
     with_values({"fuzz/explore", "fuzz/campaign", "fuzz/generate", "fuzz/judge", "fuzz/record", "core/scene",
                  "scenarios", "oracles/api", "oracles/referee/referee.h", "core/broad", "core/world"})},
    {"reports", with_values({"reports", "fuzz/record", "fuzz/judge", "fuzz/triage"})},
    {"fuzz/cli", with_values({"fuzz", "reports", "scenarios", "core/scene", "oracles"})},
};

// Headers of concrete engines and the one room that may name them.
const std::map<std::string, std::string> engine_headers = {{"fcl/", "oracles/fcl"},
                                                           {"ccd/", "oracles/libccd"},
                                                           {"bullet/", "oracles/bullet"},
                                                           {"bt", "oracles/bullet"},
                                                           {"BulletCollision/", "oracles/bullet"},
                                                           {"ode/", "oracles/ode"}};

std::string room_of(const std::string& file) {
  for (const std::string& r : rooms)
    if (file.starts_with(r + "/")) return r;
  return "";
}

bool within(const std::string& header, const std::vector<std::string>& allowed) {
  return std::any_of(allowed.begin(), allowed.end(),
                     [&](const std::string& a) { return header == a || header.starts_with(a + "/"); });
}

struct Include {
  std::string file, header;
  bool system;
};

std::vector<Include> all_includes() {
  static const std::regex line_form(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const char* top : {"core", "oracles", "scenarios", "fuzz", "reports"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TS_SOURCE_DIR) / top)) {
      const auto ext = entry.path().extension();
      if (ext != ".h" && ext != ".cpp" && ext != ".c") continue;
      std::ifstream in(entry.path());
      std::smatch m;
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, m, line_form))
          found.push_back({fs::relative(entry.path(), TS_SOURCE_DIR).generic_string(), m[2], m[1] == "<"});
    }
  return found;
}

}  // namespace

TEST_CASE("no room includes a room that it may not", "[arch]") {
  std::size_t checked = 0;
  for (const Include& i : all_includes()) {
    const std::string room = room_of(i.file);
    if (room.empty() || i.system) continue;
    if (fs::exists((fs::path(TS_SOURCE_DIR) / i.file).parent_path() / i.header)) {
      FAIL_CHECK(i.file << " includes \"" << i.header << "\" by a relative path");
      continue;
    }
    ++checked;
    if (!within(i.header, may_include.at(room))) FAIL_CHECK(i.file << " may not include " << i.header);
  }
  INFO(checked << " include lines checked");
  CHECK(checked > 100);
}

TEST_CASE("a concrete engine's headers stay in its own folder", "[arch]") {
  std::size_t checked = 0;
  for (const Include& i : all_includes()) {
    if (!i.system) continue;
    for (const auto& [prefix, room] : engine_headers) {
      if (!i.header.starts_with(prefix)) continue;
      ++checked;
      if (!i.file.starts_with(room + "/")) FAIL_CHECK(i.file << " may not include <" << i.header << ">");
    }
  }
  CHECK(checked > 3);
}

TEST_CASE("every source file belongs to a room of the table", "[arch]") {
  for (const Include& i : all_includes())
    if (room_of(i.file).empty() && i.file != "core/tolerance.h") FAIL_CHECK(i.file << " is in no room");
  CHECK(may_include.size() == rooms.size());
}
