// The cases of a seed do not depend on the compiler: no expression draws twice from a random generator in an
// order that C++ leaves open (operands of an operator, arguments of a call).
#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/arch/source_text.h"
#include "tests/support/catch.h"

namespace touchstone::arch {
namespace {

struct Token {
  std::string text;
  std::size_t place = 0;
};

std::vector<Token> tokens_of(const std::string& code) {
  static constexpr std::string_view pairs[] = {"&&", "||", "::", "->", "==", "!=", "<=", ">="};
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < code.size();) {
    std::size_t length = 1;
    if (std::isspace(static_cast<unsigned char>(code[i]))) {
      ++i;
      continue;
    }
    if (is_of_name(code[i]))
      while (i + length < code.size() && is_of_name(code[i + length])) ++length;
    for (const std::string_view p : pairs)
      if (std::string_view(code).substr(i, 2) == p) length = 2;
    tokens.push_back({code.substr(i, length), i});
    i += length;
  }
  return tokens;
}

/// The names that draw when they are used: the generator, which every function calls `rng`, and the lambdas
/// that mention it.
std::set<std::string> drawing_names(const std::vector<Token>& t) {
  std::set<std::string> names{"rng"};
  for (std::size_t i = 0; i + 4 < t.size(); ++i) {
    if (t[i].text != "auto" || t[i + 2].text != "=" || t[i + 3].text != "[") continue;
    std::size_t k = i + 3, depth = 0;
    bool draws = false, in_body = false;
    for (; k < t.size(); ++k) {
      if (t[k].text == "{") {
        ++depth;
        in_body = true;
      }
      if (t[k].text == "}" && --depth == 0) break;
      if (!in_body && t[k].text == ";") break;
      draws |= in_body && names.contains(t[k].text);
    }
    if (draws) names.insert(t[i + 1].text);
  }
  return names;
}

class DrawOrder {
 public:
  explicit DrawOrder(const std::string& code) : t_(tokens_of(code)), names_(drawing_names(t_)) { group("{"); }
  /// The places of the second of two draws whose order is open.
  const std::vector<std::size_t>& found() const { return found_; }

 private:
  /// One operand: a name with what follows it in brackets, members and calls included.
  struct Operand {
    std::size_t words = 0;
    bool names_generator = false;  // the word itself
    bool draws = false;            // something within its brackets
    bool counts() const { return draws || (names_generator && words > 1); }
  };

  static bool is_block(const std::string& before) {
    return before == ")" || before == "else" || before == "do" || before == "const" || before == "try" ||
           before == "]" || before == "mutable" || before == "noexcept" || before == ";" || before == "}";
  }

  void expect_one(bool draws, bool& drawn, std::size_t place) {
    if (draws && drawn) found_.push_back(place);
    drawn |= draws;
  }

  /// Reads up to the bracket that closes `open`, and says whether anything in it mentions a generator.
  bool group(const std::string& open) {
    bool mentions = false;
    bool argument_draws = false;    // the argument at hand
    bool an_argument_drew = false;  // one before it
    bool operand_drew = false;      // an operand before this one, in order with nothing in between
    Operand operand;
    const auto end_operand = [&](std::size_t place) {
      mentions |= operand.names_generator || operand.draws;
      argument_draws |= operand.counts();
      expect_one(operand.counts(), operand_drew, place);
      operand = {};
    };
    const auto end_order = [&](std::size_t place) {
      end_operand(place);
      operand_drew = false;
    };
    const auto end_statement = [&](std::size_t place) {
      end_order(place);
      argument_draws = an_argument_drew = false;
    };
    bool in_head = false;      // the next parentheses belong to if, for, while or switch
    bool block_ahead = false;  // the next brace opens a namespace, a type, or a lambda that names its result
    while (at_ < t_.size()) {
      const auto& [text, place] = t_[at_];
      const std::string before = at_ > 0 ? t_[at_ - 1].text : ";";
      ++at_;
      if (text == ")" || text == "]" || text == "}") {
        end_order(place);
        if (open == "(") expect_one(argument_draws, an_argument_drew, place);
        return mentions;
      }
      if (text == "(" || text == "[" || text == "{") {
        const bool block = text == "{" && (block_ahead || is_block(before));
        block_ahead &= text != "{";
        const bool inside = group(text);
        if (block || in_head)
          end_statement(place);
        else {
          ++operand.words;
          operand.draws |= inside;
        }
        in_head = false;
      } else if (text == ";") {
        end_statement(place);
        block_ahead = false;
      } else if (text == ",") {
        end_order(place);
        if (open == "(") expect_one(argument_draws, an_argument_drew, place);
        argument_draws = false;
      } else if (text == "&&" || text == "||" || text == "?" || text == ":" || text == "=") {
        end_order(place);
      } else if (text == "if" || text == "for" || text == "while" || text == "switch") {
        end_statement(place);
        in_head = true;
      } else if (text == "return" || text == "else" || text == "case") {
        end_statement(place);
      } else if (text == "namespace" || text == "struct" || text == "class" || text == "enum" ||
                 (text == "->" && before == ")")) {
        end_statement(place);
        block_ahead = true;
      } else if (is_of_name(text[0])) {
        const bool continues = before == "." || before == "->" || before == "::";
        if (!continues && operand.words > 0) end_operand(place);  // a type before a name
        ++operand.words;
        operand.names_generator |= names_.contains(text);
        if (text != "rng" && names_.contains(text)) operand.words = 2;  // a lambda draws when it is called
      } else if (text != "." && text != "->" && text != "::") {
        end_operand(place);
      }
    }
    end_statement(t_.empty() ? 0 : t_.back().place);
    return mentions;
  }

  std::vector<Token> t_;
  std::set<std::string> names_;
  std::size_t at_ = 0;
  std::vector<std::size_t> found_;
};

std::vector<std::size_t> open_draws(const std::string& code) { return DrawOrder(code).found(); }

}  // namespace

TEST_CASE("no expression draws twice from a generator in an order that the compiler chooses",
          "[arch][draws]") {
  for (const char* bad :
       {"x = rng.vector(0, 1) - n * rng.uniform(0, 1);", "f(rng.uniform(), rng.uniform());",
        "f(rng.chance(0.5) ? 1 : 2, g(rng));", "Motion m{rng.vector(0, 1) * rng.uniform(), z};",
        "return std::max(rng.below(3), rng.below(3));",
        "auto a = [&] { return rng.uniform(); }; f(a(), a());", "if (rng.below(2) + rng.below(3) > 1) g();",
        "s.push_back(f(rng, g(rng, 1), h(rng)));"})
    CHECK(open_draws(bad).size() == 1);
  for (const char* good :
       {"x = rng.vector(0, 1); y = rng.uniform();", "Vec3{rng.uniform(), rng.uniform()};",
        "f(rng, g(rng), 1);", "x = rng.chance(0.5) ? rng.uniform() : rng.binary_scale(1, 2);",
        "if (rng.chance(0.4)) m = rng.vector(0, 1);", "a[rng.below(3)] = rng.uniform();",
        "rng.below(rng.chance(0.5) ? 1 : 2);",
        "double f(Rng& rng) { return rng.uniform(); } void g(Rng& rng) {}",
        "for (i = rng.below(2); i < rng.below(3); ++i) g(rng);", "rng.chance(0.5) && rng.chance(0.5);",
        "double a = rng.uniform(), b = rng.uniform();",
        "const auto f = [&](int i) { return g(rng, i); }; f(1);"})
    CHECK(open_draws(good).empty());
  // The cases of the core's digest, which is compared between machines, are drawn in these too.
  static constexpr std::string_view digest[] = {"tests/core/digest.cpp", "tests/core/random_course.h",
                                                "tests/core/random_pair.h"};
  std::vector<SourceFile> files = sources({"tests/core"});
  std::erase_if(files, [](const SourceFile& f) { return std::ranges::count(digest, f.path) == 0; });
  CHECK(files.size() == std::size(digest));
  files.insert(files.end(), product_sources().begin(), product_sources().end());
  std::size_t drawing = 0;
  for (const SourceFile& f : files) {
    if (f.path == "core/math/rng.h" || f.code.find("Rng") == std::string::npos) continue;
    ++drawing;
    for (const std::size_t place : open_draws(f.code))
      FAIL_CHECK(f.path << ":" << f.line_at(place) << ": " << f.line(f.line_at(place)));
    // The scanner knows a generator by its name.
    for (std::size_t at = f.code.find("Rng& "); at != std::string::npos; at = f.code.find("Rng& ", at + 1))
      if (!f.code.substr(at + 5).starts_with("rng"))
        FAIL_CHECK(f.path << ":" << f.line_at(at) << ": " << f.line(f.line_at(at)));
  }
  CHECK(drawing > 20);
}

}  // namespace touchstone::arch
