// One statement a line: no comma operator in an expression statement or a return. A declaration may declare
// several names, and the head of a loop may advance several.
#include <algorithm>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/arch/source_text.h"
#include "tests/support/catch.h"

namespace touchstone::arch {
namespace {

/// A comma outside all brackets. The bracket of template arguments follows a name without a space.
bool has_bare_comma(std::string_view s) {
  int depth = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const bool opens_template = s[i] == '<' && i > 0 && is_of_name(s[i - 1]);
    const bool closes_template = s[i] == '>' && i > 0 && s[i - 1] != ' ' && s[i - 1] != '-';
    if (s[i] == '(' || s[i] == '[' || opens_template) ++depth;
    if (s[i] == ')' || s[i] == ']' || closes_template) --depth;
    if (s[i] == ',' && depth == 0) return true;
  }
  return false;
}

std::size_t end_of_parentheses(std::string_view s, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < s.size(); ++i) {
    depth += s[i] == '(' ? 1 : s[i] == ')' ? -1 : 0;
    if (depth == 0) return i + 1;
  }
  return s.size();
}

/// Without what precedes the statement that an if, an else or a loop controls.
std::string_view controlled(std::string_view s) {
  for (;;) {
    s.remove_prefix(std::min(s.size(), s.find_first_not_of(" \n")));
    std::size_t head = 0;
    for (const std::string_view word : {"if constexpr (", "if (", "for (", "while (", "alignas("})
      if (head == 0 && s.starts_with(word)) head = end_of_parentheses(s, word.size() - 1);
    if (s.starts_with("else ") || s.starts_with("else\n")) head = 5;
    if (head == 0) return s;
    s.remove_prefix(head);
  }
}

/// An assignment, a call, an increment or a return. A declaration starts with a type, a space and a name.
bool is_expression(std::string_view s) {
  static const std::regex start(
      R"(^(return\s|\+\+|--|\*|[\w.:\[\]]+(->[\w.:\[\]]+)*(\(|\+\+|--|\s*([-+*/%&|^]|<<|>>)?=[^=])))");
  return std::regex_search(s.begin(), s.end(), start);
}

std::vector<std::size_t> comma_statements(const std::string& code) {
  std::vector<std::size_t> found;
  std::size_t begin = 0, depth = 0;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '(') ++depth;
    if (code[i] == ')' && depth > 0) --depth;
    const bool in_head = code[i] == ';' && depth > 0;
    if (in_head || (code[i] != ';' && code[i] != '{' && code[i] != '}')) continue;
    const std::string_view s = controlled(std::string_view(code).substr(begin, i - begin));
    if (code[i] == ';' && is_expression(s) && has_bare_comma(s)) found.push_back(i);
    begin = i + 1;
    depth = 0;
  }
  return found;
}

}  // namespace

TEST_CASE("no statement of the product is sequenced by the comma operator", "[arch][comma]") {
  for (const char* bad : {"a = 1, b = 2;", "f(x), g(y);", "if (a < b) ++i, ++j;", "return x = 1, y;",
                          "for (int i = 0; i < 3; ++i) p->x += i, q[i] = 0;", "else x = 1, y = 2;",
                          "{ x.y.z = std::pair<int, int>(1, 2), f(); }"})
    CHECK(comma_statements(bad).size() == 1);
  for (const char* good :
       {"int a = 1, b = 2;", "f(x, y);", "for (int i = 0, j = 1; i < 3; ++i, ++j) f(i, j);",
        "x = std::pair<int, int>(1, 2);", "auto [a, b] = f();", "A::A(int a) : a_(a), b_(a) {}",
        "return {a, b};", "enum E { a, b = 2 };", "std::sort(a, b, [](int x, int y) { return x < y; });",
        "const auto p = f<A, B>(x), q = p;"})
    CHECK(comma_statements(good).empty());
  std::size_t files = 0;
  for (const SourceFile& f : product_sources()) {
    ++files;
    for (const std::size_t place : comma_statements(f.code))
      FAIL_CHECK(f.path << ":" << f.line_at(place) << ": " << f.line(f.line_at(place)));
  }
  CHECK(files > 400);
}

}  // namespace touchstone::arch
