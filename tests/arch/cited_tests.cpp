// A comment that says "Tested by:" names tests that exist: after it, in the same comment, each
// `tests/PLACE "NAME"` must be the beginning of the name of a test case in a file of that place. A place
// whose files hold no test cases (tests/bench) is named alone.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/arch/source_text.h"
#include "tests/support/catch.h"

namespace touchstone::arch {
namespace {

struct TestName {
  std::string file, name;
};

const std::vector<TestName>& test_names() {
  static const auto all = [] {
    static const std::regex form(R"re(TEST_CASE\(\s*"([^"]+)"(?:\s*"([^"]+)")?)re");
    std::vector<TestName> found;
    for (const SourceFile& f : sources({"tests"}))
      for (std::sregex_iterator i(f.text.begin(), f.text.end(), form), last; i != last; ++i)
        found.push_back({f.path, (*i)[1].str() + (*i)[2].str()});
    return found;
  }();
  return all;
}

/// The rest of a comment after `place`, without the slashes of its lines.
std::string rest_of_comment(const SourceFile& f, std::size_t place) {
  std::size_t number = f.line_at(place);
  std::string text = f.text.substr(place, f.text.find('\n', place) - place);
  for (;;) {
    std::string_view line = f.line(++number);
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(' ')));
    if (!line.starts_with("//")) return text;
    text += line.substr(line.find_first_not_of('/'));
  }
}

struct Citation {
  std::string place, name;
};

std::vector<Citation> citations_in(const std::string& text) {
  static const std::regex form(R"re((tests/\w+(?:/\w+)*(?:\.\w+)?)(?: "([^"]+)")?)re");
  std::vector<Citation> found;
  for (std::sregex_iterator i(text.begin(), text.end(), form), last; i != last; ++i)
    found.push_back({(*i)[1], (*i)[2]});
  return found;
}

bool is_in_place(const TestName& t, const std::string& place) {
  return t.file == place || t.file.starts_with(place + "/");
}

bool holds(const Citation& c) {
  const auto& all = test_names();
  const auto in_place = [&](const TestName& t) { return is_in_place(t, c.place); };
  if (c.name.empty())
    return std::filesystem::exists(std::filesystem::path(TS_SOURCE_DIR) / c.place) &&
           std::none_of(all.begin(), all.end(), in_place);
  return std::any_of(all.begin(), all.end(),
                     [&](const TestName& t) { return in_place(t) && t.name.starts_with(c.name); });
}

}  // namespace

TEST_CASE("every test that a comment names as the test of a constant exists", "[arch][cited]") {
  CHECK(test_names().size() > 500);
  CHECK(holds({"tests/arch", "every test that a comment names"}));
  CHECK(holds({"tests/arch/cited_tests.cpp", "every test that a comment names"}));
  CHECK_FALSE(holds({"tests/core", "every test that a comment names"}));
  CHECK_FALSE(holds({"tests/core", ""}));
  CHECK_FALSE(holds({"tests/absent", ""}));
  static const std::regex start(R"(Tested[\s/]+by:)");
  std::size_t comments = 0;
  for (const SourceFile& f : product_sources())
    for (std::sregex_iterator i(f.text.begin(), f.text.end(), start), last; i != last; ++i) {
      ++comments;
      const auto at = static_cast<std::size_t>(i->position() + i->length());
      const std::vector<Citation> cited = citations_in(rest_of_comment(f, at));
      if (cited.empty()) FAIL_CHECK(f.path << ":" << f.line_at(at) << " names no test");
      for (const Citation& c : cited)
        if (!holds(c))
          FAIL_CHECK(f.path << ":" << f.line_at(at) << ": no test case of " << c.place << " is named \""
                            << c.name << "\"");
    }
  CHECK(comments > 10);
}

}  // namespace touchstone::arch
