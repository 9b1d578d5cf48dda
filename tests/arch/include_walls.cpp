// Who may include whom: every #include line of the product against the table of docs/architecture.md.
#include "tests/arch/include_walls.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>

#include "tests/support/catch.h"

namespace fs = std::filesystem;

namespace touchstone::test {
namespace {

// What *values* stands for in the table.
const std::set<std::string> values = {"core/base",  "core/math",       "core/shape",
                                      "core/scene", "scenarios/value", "scenarios/text"};

// The table's row for the folders of engines.
const std::string engines = "oracles/*";

// Libraries that any room may include. Every other header in a folder of its own, or named after Bullet's
// prefix, belongs to the engine that includes it.
const std::set<std::string> shared_libraries = {"Eigen", "boost", "catch2", "fmt", "hwy", "nlohmann", "sys"};

using Table = std::map<std::string, std::set<std::string>>;

// Rows "| `room` | *values*, `room`, ... |".
Table table_of(const fs::path& root) {
  static const std::regex row(
      R"(^\| `((?:core|scenarios|oracles|fuzz|reports)/(?:\w+|\*)|library|cli)` \| (.*) \|$)");
  static const std::regex name("`([^`]+)`");
  std::ifstream in(root / "docs/architecture.md");
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

// The room that holds a file: of the table, or the folder of an engine. A file that the table lists by itself
// (core/tolerance.h) is a room.
std::string room_of(const Table& table, const std::string& file) {
  for (const auto& [room, may] : table)
    if (file.starts_with(room + "/")) return room;
  const auto end = file.find('/', std::string("oracles/").size());
  return file.starts_with("oracles/") && end != std::string::npos ? file.substr(0, end) : file;
}

// The row of the table for a room.
std::optional<std::string> row_of(const Table& table, const std::string& room) {
  if (table.contains(room)) return room;
  if (room.starts_with("oracles/") && table.contains(engines)) return engines;
  return std::nullopt;
}

struct Include {
  std::string file, header;
  bool system;
};

std::vector<Include> all_includes(const fs::path& root) {
  static const std::regex line_form(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const char* top : {"core", "scenarios", "oracles", "fuzz", "reports", "library", "cli"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto ext = entry.path().extension();
      if (ext != ".h" && ext != ".cpp" && ext != ".c") continue;
      std::ifstream in(entry.path());
      std::smatch m;
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, m, line_form))
          found.push_back({fs::relative(entry.path(), root).generic_string(), m[2], m[1] == "<"});
    }
  return found;
}

// The part of a system header's name that tells whose it is; empty for the language's own headers and for
// shared libraries.
std::string owner_of(const std::string& header) {
  if (header.starts_with("bt")) return "bt";
  const auto slash = header.find('/');
  if (slash == std::string::npos || shared_libraries.contains(header.substr(0, slash))) return "";
  return header.substr(0, slash);
}

}  // namespace

std::vector<std::string> broken_walls(const fs::path& root) {
  const Table table = table_of(root);
  const std::vector<Include> includes = all_includes(root);
  std::vector<std::string> broken;
  std::set<std::pair<std::string, std::string>> used;
  for (const Include& i : includes) {
    if (i.system) continue;
    if (fs::exists((root / i.file).parent_path() / i.header)) {
      broken.push_back(i.file + " includes \"" + i.header + "\" by a relative path");
      continue;
    }
    const std::string from = room_of(table, i.file), to = room_of(table, i.header);
    const auto row = row_of(table, from);
    if (!row) {
      if (i.file != "core/tolerance.h") broken.push_back(i.file + " is in no room");
      continue;
    }
    if (from == to) continue;
    used.emplace(*row, to);
    if (!table.at(*row).contains(to)) broken.push_back(i.file + " may not include " + i.header);
  }
  for (const auto& [from, rooms] : table)
    for (const std::string& to : rooms)
      if (!values.contains(to) && !used.contains({from, to}))
        broken.push_back("docs/architecture.md lets " + from + " include " + to + ", which it does not");
  std::map<std::string, std::string> owners;  // of headers of a foreign engine
  for (const Include& i : includes) {
    const std::string room = room_of(table, i.file);
    if (i.system && row_of(table, room) == engines && !owner_of(i.header).empty())
      owners.try_emplace(owner_of(i.header), room);
  }
  for (const Include& i : includes) {
    const auto owner = i.system ? owners.find(owner_of(i.header)) : owners.end();
    if (owner != owners.end() && room_of(table, i.file) != owner->second)
      broken.push_back(i.file + " may not include <" + i.header + ">, which belongs to " + owner->second);
  }
  return broken;
}

}  // namespace touchstone::test

using namespace touchstone::test;

TEST_CASE("no room includes a room or an engine's header that it may not, and no permission is unused",
          "[arch]") {
  for (const std::string& sentence : broken_walls(TS_SOURCE_DIR)) FAIL_CHECK(sentence);
  // The table and the includes were found at all.
  CHECK(table_of(TS_SOURCE_DIR).size() > 35);
  CHECK(all_includes(TS_SOURCE_DIR).size() > 2000);
  std::set<std::string> owners;
  for (const Include& i : all_includes(TS_SOURCE_DIR))
    if (i.system && i.file.starts_with("oracles/")) owners.insert(owner_of(i.header));
  for (const char* engine : {"fcl", "ccd", "bt", "BulletCollision", "ode"}) CHECK(owners.contains(engine));
}
