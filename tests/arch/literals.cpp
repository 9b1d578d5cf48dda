// Tolerances are named constants with a comment. A literal of the product's code looks like a tolerance, and
// must be in the initialiser of such a constant, when it is
//   1. a floating literal with an exponent, decimal or hexadecimal (1e-6, 0x1p-40);
//   2. a floating literal without one whose value is no multiple of an eighth (0.28);
//   3. any number multiplied by a unit roundoff (4 * unit, 16 * std::numeric_limits<T>::epsilon());
//   4. a whole number of ten or more, in decimal, compared by <, <=, > or >= in the head of a loop (its cap).
// A named constant is a declaration `constexpr` of a variable (in C: `static const`); its comment is on one
// of its lines or above the group of such constants that it belongs to. Where numbers are the content of
// cases (sizes, angles, chances), rules 1 and 2 hold for compared numbers alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "tests/arch/source_text.h"
#include "tests/support/catch.h"

namespace touchstone::arch {
namespace {

struct Exception {
  std::string_view file, literal, reason;
};
constexpr std::size_t most_exceptions = 20;
constexpr Exception exceptions[] = {
    {"core/broad/pack_lanes-inl.h", "256", "all masks of eight lanes: the size of the table that is filled"},
    {"core/broad/pair_kernels.cpp", "16", "the bits of the mask that mask_16 is named after"},
};

// Their numbers are the content of cases.
constexpr std::array case_places{
    std::string_view("scenarios/handmade/"),           std::string_view("scenarios/random/"),
    std::string_view("scenarios/exhaustive/"),         std::string_view("reports/chart/chart_cases.cpp"),
    std::string_view("reports/stability/ladders.cpp"), std::string_view("fuzz/certify/conformance.cpp")};

template <std::size_t n>
bool is_in(const std::array<std::string_view, n>& places, std::string_view path) {
  return std::any_of(places.begin(), places.end(), [&](auto p) { return path.starts_with(p); });
}

struct Range {
  std::size_t begin, end;
};

// Lines from which a comment above them is looked for: other constants of the same group.
bool declares_constant(std::string_view line) {
  return line.find("constexpr ") != line.npos || line.starts_with("template <");
}

bool has_comment(const SourceFile& f, Range r) {
  for (std::size_t n = f.line_at(r.begin); n <= f.line_at(r.end); ++n)
    if (f.line(n).find("//") != std::string_view::npos || f.line(n).find("/*") != std::string_view::npos)
      return true;
  for (std::size_t n = f.line_at(r.begin) - 1; n > 0; --n) {
    const std::string_view line = f.line(n),
                           start = line.substr(std::min(line.size(), line.find_first_not_of(' ')));
    if (start.starts_with("//") || line.find("  // ") != line.npos || line.find("*/") != line.npos)
      return true;
    if (!declares_constant(line)) return false;
  }
  return false;
}

/// The declarations of named constants, from `constexpr` to the semicolon. A function's body is none.
std::vector<Range> named_constants(const SourceFile& f) {
  static const std::regex start(R"(\bconstexpr\b|\bstatic const\b|\bstatic_assert\b)");
  std::vector<Range> found;
  for (std::sregex_iterator i(f.code.begin(), f.code.end(), start), last; i != last; ++i) {
    const Range r{static_cast<std::size_t>(i->position()),
                  f.code.find(';', static_cast<std::size_t>(i->position()))};
    const std::string text = f.code.substr(r.begin, r.end - r.begin);
    if (i->str() == "static_assert") {  // states its reason itself
      found.push_back(r);
      continue;
    }
    if (i->str() == "static const" && !f.path.ends_with(".c")) continue;
    const std::size_t value = text.find_first_of("={(");
    if (value == text.npos || text[value] == '(' || text.find("return") != text.npos) continue;
    if (has_comment(f, r)) found.push_back(r);
  }
  return found;
}

struct Number {
  std::string text;
  std::size_t place;
  bool is_floating, has_exponent;
  long double value;
};

std::vector<Number> numbers_of(const std::string& code) {
  static const std::regex form(R"((^|[^\w.])((?:\d|\.\d)(?:[eEpP][+-]|[\w.']|[\w.'])*))");
  std::vector<Number> found;
  for (std::sregex_iterator i(code.begin(), code.end(), form), last; i != last; ++i) {
    Number n{(*i)[2].str(), static_cast<std::size_t>(i->position(2)), false, false, 0};
    std::string digits = n.text;
    std::erase(digits, '\'');
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    n.has_exponent = digits.find_first_of(hexadecimal ? "pP" : "eE") != digits.npos;
    n.is_floating = n.has_exponent || digits.find('.') != digits.npos;
    n.value = std::strtold(digits.c_str(), nullptr);
    found.push_back(n);
  }
  return found;
}

// How far around a number its operators are looked for.
constexpr std::size_t near = 80;

std::string_view last_of(std::string_view s) { return s.substr(s.size() - std::min(s.size(), near)); }

bool is_compared(std::string_view before, std::string_view after) {
  static const std::regex left_operator(R"(\s[<>]=?\s+[-(]?$)"), right_operator(R"(^\s+[<>]=?\s)");
  const std::string left(last_of(before)), right(after.substr(0, near));
  return std::regex_search(left, left_operator) || std::regex_search(right, right_operator);
}

bool is_in_head_of_loop(std::string_view before) {
  int depth = 0;
  for (std::size_t i = before.size(); i-- > 0 && before[i] != '{' && before[i] != '}';) {
    depth += before[i] == ')' ? 1 : before[i] == '(' ? -1 : 0;
    if (depth < 0) return before.substr(0, i).ends_with("for ") || before.substr(0, i).ends_with("while ");
  }
  return false;
}

bool is_multiple_of_roundoff(std::string_view before, std::string_view after) {
  static const std::regex follows(
      R"(^\s*\*\s(unit\b|unit_of<|u<|eps\b|\w*roundoff\b|std::numeric_limits<\w+>::epsilon))"),
      precedes(R"((\bunit|unit_of<\w+>|\bu<\w+>|\beps|\w*roundoff|epsilon\(\))\s\*\s$)");
  const std::string left(last_of(before)), right(after.substr(0, near));
  return std::regex_search(right, follows) || std::regex_search(left, precedes);
}

bool looks_like_a_tolerance(const SourceFile& f, const Number& n) {
  const std::string_view code = f.code, before = code.substr(0, n.place),
                         after = code.substr(n.place + n.text.size());
  const bool compared = is_compared(before, after);
  const bool is_simple = !n.has_exponent && n.value * 8 == std::floor(n.value * 8);
  if (n.is_floating && !is_simple && (compared || !is_in(case_places, f.path))) return true;
  return is_multiple_of_roundoff(before, after) ||
         (!n.is_floating && n.value >= 10 && compared && is_in_head_of_loop(before));
}

struct Unnamed {
  std::string file, literal;
  std::size_t line;
};

std::vector<Unnamed> unnamed_in(const SourceFile& f) {
  std::vector<Unnamed> found;
  const std::vector<Range> constants = named_constants(f);
  for (const Number& n : numbers_of(f.code)) {
    const auto holds = [&](const Range& r) { return r.begin <= n.place && n.place < r.end; };
    if (!looks_like_a_tolerance(f, n) || std::any_of(constants.begin(), constants.end(), holds)) continue;
    found.push_back({f.path, n.text, f.line_at(n.place)});
  }
  return found;
}

SourceFile file_of(std::string text) { return as_source("core/example.cpp", std::move(text)); }

std::vector<std::string> unnamed_literals(std::string text) {
  std::vector<std::string> all;
  for (const Unnamed& u : unnamed_in(file_of(std::move(text)))) all.push_back(u.literal);
  return all;
}

}  // namespace

TEST_CASE("the scanner of literals sees tolerances and nothing else", "[arch][literals]") {
  using Literals = std::vector<std::string>;
  CHECK(unnamed_literals("bool f(double x) { return x < 1e-6; }") == Literals{"1e-6"});
  CHECK(unnamed_literals("double f(double x) { return x * 0x1p-40 + .28L; }") == Literals{"0x1p-40", ".28L"});
  CHECK(unnamed_literals("double x = 4 * unit * y + 3 * std::numeric_limits<double>::epsilon();") ==
        Literals{"4", "3"});
  CHECK(unnamed_literals("double x = y * unit_of<T> * 8;") == Literals{"8"});
  CHECK(unnamed_literals("void f() { for (int i = 0; i < 64; ++i) g(i); }") == Literals{"64"});
  CHECK(unnamed_literals("void f() { while (g(x) < 200) h(); }") == Literals{"200"});
  CHECK(unnamed_literals("constexpr double f(double x) { return 1e-6 * x; }  // a function") ==
        Literals{"1e-6"});
  CHECK(unnamed_literals("constexpr double x = 1e-6;") == Literals{"1e-6"});
  CHECK(unnamed_literals("// Unit, scale law.\nconstexpr double x = 1e-6, y = 4 * unit;\n"
                         "constexpr double z[] = {0x1p-3,\n  1e-9};\n") == Literals{});
  CHECK(unnamed_literals("constexpr double x = 1e-6;  // unit, scale law") == Literals{});
  CHECK(unnamed_literals("double x = 0.5 * y + 2.0 - 1.25 + 100; f(\"1e-6\"); char c = '\\''; // 1e-6\n"
                         "Matrix<double, 3, 64> m; shift<31>(k); /* 1e-9 */ x = y->z >> 12 << 40;") ==
        Literals{});
  CHECK(unnamed_literals("#define X 1e-6\nconst char* t = R\"(a 1e-6 \" b)\"; x = 0xffe - 5;") == Literals{});
}

TEST_CASE("every literal that looks like a tolerance is a named constant with a comment",
          "[arch][literals]") {
  std::set<std::pair<std::string, std::string>> seen;
  std::size_t files = 0;
  for (const SourceFile& f : product_sources()) {
    ++files;
    for (const Unnamed& u : unnamed_in(f)) {
      seen.emplace(u.file, u.literal);
      const bool excepted =
          std::any_of(std::begin(exceptions), std::end(exceptions),
                      [&](const Exception& e) { return e.file == u.file && e.literal == u.literal; });
      if (!excepted) FAIL_CHECK(u.file << ":" << u.line << ": " << u.literal << " has no name or no comment");
    }
  }
  CHECK(files > 400);
  CHECK(std::size(exceptions) <= most_exceptions);
  for (const Exception& e : exceptions) {
    if (!seen.contains({std::string(e.file), std::string(e.literal)}))
      FAIL_CHECK("the exception " << e.file << ": " << e.literal << " is no longer needed");
    CHECK(!e.reason.empty());
  }
}

}  // namespace touchstone::arch
