// What the documents name exists: links to files, and paths of this repository in `code`.
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/workspace.h"

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> documents() {
  std::vector<fs::path> all = {TS_SOURCE_DIR "/README.md", TS_SOURCE_DIR "/CONTRIBUTING.md",
                               TS_SOURCE_DIR "/corpus/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(TS_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  return all;
}

std::vector<std::string> matches(const std::string& text, const std::regex& form) {
  std::vector<std::string> all;
  for (std::sregex_iterator i(text.begin(), text.end(), form), end; i != end; ++i) all.push_back((*i)[1]);
  return all;
}

// The fragment by which GitHub links to a heading.
std::string fragment_of(const std::string& heading) {
  std::string r;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') r += '-';
    if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80)
      r += static_cast<char>(std::tolower(byte));
  }
  return r;
}

std::set<std::string> fragments_in(const fs::path& document) {
  std::set<std::string> all;
  std::istringstream in(touchstone::test::read_all(document));
  bool is_code = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (is_code || !line.starts_with("#")) continue;
    const std::size_t text = line.find_first_not_of('#');
    if (text != line.npos && line[text] == ' ') all.insert(fragment_of(line.substr(text + 1)));
  }
  return all;
}

}  // namespace

TEST_CASE("headings that the documents link to exist", "[arch]") {
  const std::regex link(R"(\]\(([^):]*#[^)]*)\))");
  std::size_t checked = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& target : matches(touchstone::test::read_all(document), link)) {
      const std::size_t hash = target.find('#');
      const fs::path page = hash == 0 ? document : document.parent_path() / target.substr(0, hash);
      INFO(document << ": " << target);
      CHECK(fragments_in(page).count(target.substr(hash + 1)) == 1);
      ++checked;
    }
  }
  CHECK(checked > 5);
}

TEST_CASE("files that the documents name exist", "[arch]") {
  // No fragment, no address on the web.
  const std::regex link(R"(\]\(([^)#:]+)(?:#[^)]*)?\))");
  // No placeholder.
  const std::regex path("`((?:cli|core|docs|fuzz|oracles|reports|scenarios|tests)/[A-Za-z0-9_./-]*)`");
  const std::regex placeholder("NAME");
  std::size_t checked = 0;
  for (const fs::path& document : documents()) {
    const std::string text = touchstone::test::read_all(document);
    INFO(document);
    for (const std::string& target : matches(text, link)) {
      INFO(target);
      CHECK(fs::exists(document.parent_path() / target));
      ++checked;
    }
    for (const std::string& target : matches(text, path)) {
      if (std::regex_search(target, placeholder)) continue;
      INFO(target);
      CHECK(fs::exists(fs::path(TS_SOURCE_DIR) / target));
      ++checked;
    }
  }
  CHECK(checked > 100);
}
