// Who may include whom: every #include line of the product against the table of docs/architecture.md.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/catch.h"

namespace fs = std::filesystem;

namespace {

// What *values* stands for in the table.
const std::set<std::string> values = {"core/base",  "core/math",       "core/shape",
                                      "core/scene", "scenarios/value", "scenarios/text"};

// Headers of foreign engines, and the one folder that may include them.
const std::map<std::string, std::string> engine_headers = {{"fcl/", "oracles/fcl"},
                                                           {"ccd/", "oracles/libccd"},
                                                           {"bullet/", "oracles/bullet"},
                                                           {"bt", "oracles/bullet"},
                                                           {"BulletCollision/", "oracles/bullet"},
                                                           {"ode/", "oracles/ode"}};

using Table = std::map<std::string, std::set<std::string>>;

// Rows "| `room` | *values*, `room`, ... |".
Table table_of(const fs::path& document) {
  static const std::regex row(R"(^\| `((?:core|scenarios|oracles|fuzz|reports)/\w+|cli)` \| (.*) \|$)");
  static const std::regex name("`([^`]+)`");
  std::ifstream in(document);
  Table table;
  std::smatch m;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| room | may include |")) inside = true;
    if (line.empty()) inside = false;
    if (!inside || !std::regex_match(line, m, row)) continue;
    const std::string permitted = m[2];
    auto& may = table[m[1]];
    if (permitted.find("*values*") != std::string::npos) may = values;
    for (std::sregex_iterator i(permitted.begin(), permitted.end(), name), end; i != end; ++i)
      may.insert((*i)[1].str());
  }
  return table;
}

const Table& may_include() {
  static const Table table = table_of(fs::path(TS_SOURCE_DIR) / "docs/architecture.md");
  return table;
}

// The room of the table that holds a file. A file that the table lists by itself (core/tolerance.h) is a
// room.
std::string room_of(const std::string& file) {
  for (const auto& [room, may] : may_include())
    if (file.starts_with(room + "/")) return room;
  return file;
}

struct Include {
  std::string file, header;
  bool system;
};

std::vector<Include> all_includes() {
  static const std::regex line_form(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const char* top : {"core", "scenarios", "oracles", "fuzz", "reports", "cli"})
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

TEST_CASE("no room includes a room that it may not, and no permission is unused", "[arch]") {
  std::set<std::pair<std::string, std::string>> used;
  for (const Include& i : all_includes()) {
    if (i.system) continue;
    if (fs::exists((fs::path(TS_SOURCE_DIR) / i.file).parent_path() / i.header)) {
      FAIL_CHECK(i.file << " includes \"" << i.header << "\" by a relative path");
      continue;
    }
    const std::string from = room_of(i.file), to = room_of(i.header);
    if (from == to || !may_include().contains(from)) continue;
    used.emplace(from, to);
    if (!may_include().at(from).contains(to)) FAIL_CHECK(i.file << " may not include " << i.header);
  }
  CHECK(used.size() > 100);
  for (const auto& [from, rooms] : may_include())
    for (const std::string& to : rooms)
      if (!values.contains(to) && !used.contains({from, to}))
        FAIL_CHECK("docs/architecture.md lets " << from << " include " << to << ", which it does not");
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
  std::set<std::string> rooms;
  for (const Include& i : all_includes()) {
    rooms.insert(room_of(i.file));
    if (!may_include().contains(room_of(i.file)) && i.file != "core/tolerance.h")
      FAIL_CHECK(i.file << " is in no room");
  }
  CHECK(rooms.size() >= may_include().size());
}
