// One type of a name in a namespace. Two that are defined in different files are undefined behaviour as soon
// as both are linked into one program: the linker keeps one destructor for both.
#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/arch/source_text.h"
#include "tests/support/catch.h"

namespace touchstone::arch {
namespace {

/// The types that a file defines outside of functions and other types, with their namespaces. Those of an
/// unnamed namespace are left out.
std::vector<std::pair<std::string, std::string>> types_of(const SourceFile& file) {
  static const std::regex head(
      R"((namespace\s*([\w:]*)\s*|(?:struct|class)\s+(?:alignas\(\w+\)\s*)?(\w+)(?:\s+final)?\s*(?::[^:;{}][^;{}]*)?)\{|[{}])");
  std::vector<std::pair<std::string, std::string>> found;
  std::vector<std::string> open;  // the namespace of each open bracket; "(" for any other
  const auto is_outside = [&] { return std::find(open.begin(), open.end(), "(") == open.end(); };
  for (std::sregex_iterator m(file.code.begin(), file.code.end(), head), end; m != end; ++m) {
    const std::string text = m->str();
    if (text == "}") {
      if (!open.empty()) open.pop_back();
    } else if (text.starts_with("namespace")) {
      open.push_back((*m)[2].str().empty() ? "?" : (*m)[2].str());
    } else {
      const bool is_type =
          (*m)[3].matched && is_outside() && std::find(open.begin(), open.end(), "?") == open.end();
      if (is_type) {
        std::string name;
        for (const std::string& n : open) name += n + "::";
        found.emplace_back(name + (*m)[3].str(), file.path);
      }
      open.push_back("(");
    }
  }
  return found;
}

}  // namespace

TEST_CASE("no two files define a type of the same name in one namespace", "[arch]") {
  std::map<std::string, std::string> file_of;
  // A program uses the matchers of one test framework. C has no types that a linker joins.
  const auto is_apart = [](const SourceFile& f) {
    return f.path == "library/touchstone_gtest.h" || f.path.ends_with(".c");
  };
  for (const SourceFile& file : product_sources()) {
    if (is_apart(file)) continue;
    for (const auto& [type, path] : types_of(file)) {
      const auto [known, is_new] = file_of.emplace(type, path);
      INFO(type << " is defined in " << known->second << " and in " << path);
      CHECK((is_new || known->second == path));
    }
  }
  CHECK(file_of.size() > 500);
  CHECK(file_of.contains("touchstone::fuzz::NamedFault"));
}

TEST_CASE("the scanner of types sees definitions outside of unnamed namespaces", "[arch]") {
  const SourceFile file =
      as_source("x.h", "namespace a { struct B : C { struct D {}; }; class E; namespace { struct F {}; } }");
  const auto found = types_of(file);
  REQUIRE(found.size() == 1);
  CHECK(found[0].first == "a::B");
}

}  // namespace touchstone::arch
