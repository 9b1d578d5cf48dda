// What the documents name exists: links to files, and paths of this repository in `code`.
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/workspace.h"

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> documents() {
  std::vector<fs::path> all = {TS_SOURCE_DIR "/README.md", TS_SOURCE_DIR "/CONTRIBUTING.md",
                               TS_SOURCE_DIR "/corpus/README.md"};
  for (const auto& entry : fs::directory_iterator(TS_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  return all;
}

std::vector<std::string> matches(const std::string& text, const std::regex& form) {
  std::vector<std::string> all;
  for (std::sregex_iterator i(text.begin(), text.end(), form), end; i != end; ++i) all.push_back((*i)[1]);
  return all;
}

}  // namespace

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
