// Causes as text, as Markdown and as the data of their page.
#include "tests/support/catch.h"

#include <regex>
#include <sstream>

#include "reports/text/cause_words.h"
#include "reports/text/causes_text.h"
#include "scenarios/text/printable.h"
#include "tests/reports/cause_sample.h"

using namespace touchstone;
using reports::cause_markdown;
using reports::cause_text;
using reports::causes_of_libraries;
using reports::causes_page;
using reports::causes_text;
using test::sample_causes;

namespace {

const std::string command = "./touchstone causes out/nightly";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

// The longest line in bytes that is no command: a command to copy stays on one line.
std::size_t longest_text_line(const std::string& text) {
  std::size_t longest = 0;
  for (const std::string& line : lines(text))
    if (!contains(line, "touchstone")) longest = std::max(longest, line.size());
  return longest;
}

// Lines that open or close a block of code; a line within a block counts if it would close it.
std::vector<std::string> fences(const std::string& markdown) {
  std::vector<std::string> all;
  std::string open;
  for (const std::string& line : lines(markdown)) {
    const std::string ticks = line.substr(0, std::min(line.find_first_not_of('`'), line.size()));
    if (ticks.size() < 3 || (!open.empty() && (ticks.size() < open.size() || line != ticks))) continue;
    open = open.empty() ? ticks : "";
    all.push_back(line);
  }
  return all;
}

// What a reader of Markdown sees as markup or prose: without blocks of code and code within lines.
std::string without_code(const std::string& markdown) {
  std::string out, open;
  for (const std::string& line : lines(markdown)) {
    const std::string ticks = line.substr(0, std::min(line.find_first_not_of('`'), line.size()));
    if (open.empty() && ticks.size() >= 3) {
      open = ticks;
    } else if (!open.empty()) {
      if (line == ticks && ticks.size() >= open.size()) open.clear();
    } else {
      // A run of backticks up to the next run of the same length.
      for (std::size_t i = 0; i < line.size();) {
        if (line[i] == '\\' && i + 1 < line.size()) {
          out += line.substr(i, 2);
          i += 2;
          continue;
        }
        const std::size_t after = std::min(line.find_first_not_of('`', i), line.size());
        const std::size_t run = after - i;
        std::size_t close = run == 0 ? std::string::npos : line.find('`', after);
        while (close != std::string::npos) {
          const std::size_t close_end = std::min(line.find_first_not_of('`', close), line.size());
          if (close_end - close == run) break;
          close = line.find('`', close_end);
        }
        if (run == 0 || close == std::string::npos)
          out += line[i++];
        else
          i = close + run;
      }
      out += '\n';
    }
  }
  return out;
}

}  // namespace

TEST_CASE("the list of causes says what is wrong, how often, and what to do", "[causes]") {
  const std::string text = causes_text(sample_causes(), command);
  INFO(text);
  CHECK(contains(text,
                 " 1. crash  fcl-libccd  7 of 9,000 wrong (0.1 %): corner case\n"
                 "    throws from validateNearestFeatureOfPolytopeBeingEdge: vanishes when turned\n"
                 "    by 1e-9\n    hull-hull; distance\n"));
  CHECK(contains(text, " 2. missed  fcl-libccd  1,204 of 1,880 wrong (64 %): systematic\n"));
  CHECK(contains(text, "    box-box, box-capsule, box-cone, box-cylinder and 8 more; time_of_impact\n"));
  CHECK(contains(text, "    e.g. fcl-libccd: states no impact; the referee has one at t = 0.4725\n"));
  CHECK(contains(text, "    ./touchstone causes out/nightly --cause bullet-query-convex-9ab0\n"));
  CHECK(contains(text, "wrong (7.3 %)\n"));  // neither systematic nor a corner case
  CHECK(contains(text, "    documented: ccdMPRPenetration: the depth is that along the portal's normal\n"));
  CHECK(contains(text,
                 "5 causes behind 6,546 wrong answers (6 keys); chance that the next wrong answer\n"
                 "is of a cause not listed: 0.1 %\nnote: bullet-f64-sim is not installed"));
  CHECK(longest_text_line(text) <= 80);
  // In the order given.
  CHECK(text.find("fcl-libccd-assertion-51") < text.find("fcl-libccd-continuous"));
  CHECK(text.find("ode-box-cylinder") < text.find("libccd-mpr-convex"));
}

TEST_CASE("a campaign without causes says so", "[causes]") {
  const std::string text = causes_text({}, command);
  CHECK(contains(text, "no causes: no answer was wrong\n0 causes behind 0 wrong answers (0 keys)"));
  CHECK(contains(text, "not listed: 0 %\n"));
}

TEST_CASE("rates are systematic from 30 % and a corner case below 1 %", "[causes]") {
  fuzz::Cause c;
  const auto says = [&](std::uint64_t wrong, std::uint64_t asked) {
    c.wrong = wrong;
    c.asked = asked;
    return reports::rate_text(c);
  };
  CHECK(says(30, 100) == "30 of 100 wrong (30 %): systematic");
  CHECK(says(29, 100) == "29 of 100 wrong (29 %)");
  CHECK(says(1, 100) == "1 of 100 wrong (1.0 %)");
  CHECK(says(1, 101) == "1 of 101 wrong (1.0 %): corner case");
  CHECK(says(9, 9) == "9 of 9 wrong (100 %)");  // too few to call it either
  CHECK(says(10, 10) == "10 of 10 wrong (100 %): systematic");
  CHECK(says(3, 0) == "3 wrong answers");
  CHECK(reports::share_text(0) == "0 %");
  CHECK(reports::share_text(0.0004) == "<0.1 %");
  CHECK(reports::share_text(0.9999) == "99 %");
}

TEST_CASE("a cause in full has its responses, consequences, engines and cases", "[causes]") {
  const std::string text = cause_text(sample_causes().causes.at(2));
  INFO(text);
  CHECK(contains(text, "infeasible  bullet-query  bullet-query-convex-9ab0\n"));
  CHECK(contains(text, "  Bullet 3.24; routine: convex; first seen in case 125\n"));
  CHECK(contains(text, "  engines: bullet-f32-query, bullet-f32-query-tuned, bullet-f64-query,\n"));
  CHECK(contains(text, "  filed under 2 keys\n"));
  CHECK(contains(text, "Consequences\n  contact not_minimal (212)\n  distance points_off_body (31)\n"));
  CHECK(contains(text, "  turned by 1e-6                right\n"));
  CHECK(contains(text, "  A and B exchanged             wrong in another way\n"));
  CHECK(contains(text, "  the depth halved              not decided\n"));
  CHECK(contains(text, "  and 1 not applicable\n"));
  CHECK(contains(text, "Still wrong when changed thus\n  "));
  CHECK(contains(text, "  expected: Moving a body by the stated depth along the stated normal separates\n"));
  CHECK(contains(text, "  actual: bullet-f32-query-tuned: "));
  CHECK(contains(text, "the answer then\n  turned by 1e-6 "));  // what makes it vanish comes first
  CHECK(contains(text, "  smallest: bullet-f32-query-tuned, 2 bodies, 131 bits, 6.1e-01 L\n"));
  CHECK(contains(text, "  defensible: bullet-f32-query-tuned, 2 bodies, 52 bits, 5.0e-02 L\n"));
  CHECK(contains(text, "#include <btBulletCollisionCommon.h>\n"));
  CHECK(longest_text_line(text) <= 80);
  const std::string none = cause_text(sample_causes().causes.at(3));
  CHECK(contains(none, "\nno program: ODE's API has no question for a signed distance\n"));
  CHECK_FALSE(contains(none, "defensible:"));
}

namespace {

std::string first_word(const std::string& path) { return path.substr(0, path.find('-')); }

}  // namespace

TEST_CASE("the last lines of a campaign have the first causes of each library, one a line but crashes",
          "[causes]") {
  const std::string text = causes_of_libraries(sample_causes(), 1, first_word);
  INFO(text);
  CHECK(text ==
        "bullet: 1 cause behind 31 wrong answers\n"
        "  9ab0      31 infeasible: bullet-query: wrong only where faces are ...\n"
        "fcl: 2 causes behind 1,211 wrong answers\n"
        "  51       7 crash: fcl-libccd: throws from\n"
        "                 validateNearestFeatureOfPolytopeBeingEdge: vanishes when ...\n"
        "  and 1 more\n"
        "libccd: 1 cause behind 5,260 wrong answers\n"
        "  77e2   5,260 not minimal: libccd-mpr: states a depth that is not the ...\n"
        "ode: 1 cause behind 44 wrong answers\n"
        "  0c0c      44 distance: routine box-cylinder: vanishes when the box is ...\n");
  CHECK(lines(causes_of_libraries(sample_causes(), 5, first_word)).size() == 4 + 5 + 1);
  CHECK(causes_of_libraries({}, 5, first_word).empty());
}

TEST_CASE("answers that an engine declined are not counted as wrong", "[causes]") {
  fuzz::Causes c;
  c.causes.resize(2);
  for (fuzz::Cause& one : c.causes) {
    one.path = "core";
    one.wrong = 2;
    one.severity = fuzz::Severity::declined;
  }
  CHECK(causes_of_libraries(c, 0, first_word).starts_with("core: 2 causes behind 4 declined answers\n"));
  c.causes[0].severity = fuzz::Severity::crash;
  CHECK(causes_of_libraries(c, 0, first_word).starts_with("core: 2 causes behind 2 wrong and 2 declined"));
}

TEST_CASE("a code has as many words of the id as tell it from all others", "[causes]") {
  fuzz::Causes all;
  for (const char* id : {"ode-depth-c9e889", "ode-points-c9e889", "ode-depth-2cd519",
                         "fcl-libccd-depth-aaaaaa", "fcl-indep-depth-aaaaaa", "aaaaaa"}) {
    all.causes.emplace_back();
    all.causes.back().id = id;
  }
  const auto code = [&](std::size_t i) { return std::string(reports::code_of(all.causes[i], all)); };
  CHECK(code(0) == "depth-c9e889");
  CHECK(code(1) == "points-c9e889");
  CHECK(code(2) == "2cd519");
  CHECK(code(3) == "libccd-depth-aaaaaa");
  CHECK(code(4) == "indep-depth-aaaaaa");
  for (const fuzz::Cause& c : all.causes) CHECK(reports::is_named(c, reports::code_of(c, all)));
  CHECK(reports::is_named(all.causes[0], "c9e889"));
  CHECK_FALSE(reports::is_named(all.causes[0], "9e889"));
  CHECK_FALSE(reports::is_named(all.causes[0], ""));
}

TEST_CASE("Markdown has all that a maintainer needs", "[causes]") {
  const fuzz::Cause c = sample_causes().causes.at(2);
  const std::string text = cause_markdown(c);
  INFO(text);
  CHECK(text.starts_with(
      "# bullet-query: wrong only where faces are parallel: vanishes when turned by 1e-6\n"));
  CHECK(contains(text, "- **Library:** Bullet 3.24 (`bullet-f32-query`, "));
  CHECK(contains(text, "**Expected:** Moving a body by the stated depth"));
  CHECK(contains(text, "**Actual:** `moving by the stated depth 0.5 along the stated normal leaves 0.5 of"));
  CHECK(contains(text, "```json\n" + c.defensible.c.dump() + "\n```\n"));
  CHECK(contains(text, "|---|---|\n| turned by 1e-6 | right |\n"));
  CHECK(contains(text, "```cpp\n" + c.program + "```\n"));
  CHECK(contains(text, "```sh\ntouchstone replay case.json --engines bullet-f32-query-tuned\n```\n"));
  CHECK(contains(text, "<details><summary>Certificate of the right answer</summary>\n"));
  CHECK(contains(text, c.certificate.dump()));
  CHECK(fences(text).size() == 8);
  const std::string none = cause_markdown(sample_causes().causes.at(3));
  CHECK(contains(none, "There is no program in the engine's own API: ODE's API has no question"));
  CHECK_FALSE(contains(none, "<details>"));
}

TEST_CASE("what is too long for an issue tracker is left out of the Markdown, and said so", "[causes]") {
  fuzz::Cause c = sample_causes().causes.at(2);
  c.defensible.c["description"] = std::string(100'000, 'x');
  c.program = std::string(100'000, 'y');
  c.certificate["note"] = std::string(100'000, 'z');
  const std::string text = cause_markdown(c);
  CHECK(text.size() < 6'000);
  CHECK(contains(text, "The case (2 bodies, 52 bits) is too long to print here; it is attached."));
  CHECK(contains(text, "The program in the engine's own API is too long to print here"));
  CHECK(contains(text, "The certificate is too long to print here"));
}

TEST_CASE("hostile text stays text in the terminal, within 80 columns", "[causes]") {
  const fuzz::Causes c = test::hostile_causes();
  std::string all = causes_text(c, command) + causes_of_libraries(c, 5, first_word);
  for (const fuzz::Cause& cause : c.causes) {
    fuzz::Cause without = cause;  // a program is printed as it is
    without.program.clear();
    const std::string text = cause_text(without);
    CHECK(longest_text_line(text) <= 80);
    all += text + cause_text(cause);
  }
  CHECK(longest_text_line(causes_text(c, command)) <= 80);
  CHECK(printable(all, "\n\t") == all);
  CHECK_FALSE(contains(all, "\x1b"));
  // The campaign's name is one word of the page's command.
  const std::string on_page = causes_page(c)["command"];
  CHECK(on_page.starts_with("./touchstone causes 'out/nightly ``` "));
  CHECK(contains(on_page, "'\\''; touch owned; '\\''"));
}

TEST_CASE("hostile text in Markdown is no markup, no mention and no command", "[causes]") {
  for (const fuzz::Cause& cause : test::hostile_causes().causes) {
    const std::string text = cause_markdown(cause);
    INFO(text);
    CHECK(printable(text, "\n\t") == text);
    CHECK(fences(text).size() % 2 == 0);
    const std::string seen = without_code(text);
    CHECK_FALSE(contains(seen, "<img"));
    CHECK_FALSE(contains(seen, "<script"));
    CHECK_FALSE(contains(seen, "</script"));
    CHECK_FALSE(contains(seen, "@everyone"));
    // The only tags are ours: one certificate.
    std::size_t closed = 0;
    for (std::size_t at = seen.find("</details>"); at != std::string::npos;
         at = seen.find("</details>", at + 1))
      ++closed;
    CHECK(closed == 1);
    // Every row of the table has two cells.
    static const std::regex bar("(^|[^\\\\])\\|");
    for (const std::string& line : lines(text))
      if (line.starts_with("| "))
        CHECK(std::distance(std::sregex_iterator(line.begin(), line.end(), bar), std::sregex_iterator()) ==
              3);
    // The engine's name is one word of the command.
    const std::size_t replay = text.find("touchstone replay case.json --engines '");
    REQUIRE(replay != std::string::npos);
    CHECK(contains(text.substr(replay), "'\\''; touch owned; '\\''"));
  }
}

TEST_CASE("the page has every cause with its Markdown, its command and the case that it draws", "[causes]") {
  const fuzz::Causes c = sample_causes();
  const fuzz::Json page = causes_page(c);
  CHECK(page["page"] == "causes");
  CHECK(page["title"] == "causes of out/nightly");
  const fuzz::Json& causes = page["record"]["causes"];
  REQUIRE(causes.size() == c.causes.size());
  for (std::size_t i = 0; i < causes.size(); ++i) {
    CHECK(causes[i]["id"] == c.causes[i].id);
    CHECK(causes[i]["markdown"] == cause_markdown(c.causes[i]));
    CHECK(causes[i]["command"] == "./touchstone causes out/nightly --cause " + c.causes[i].id);
    CHECK(causes[i]["key_count"] == c.causes[i].keys.size());
    const bool defensible = !c.causes[i].defensible.c.is_null();
    CHECK(causes[i]["smallest"].contains("case") != defensible);
    CHECK(causes[i][defensible ? "defensible" : "smallest"]["case"] == c.causes[i].shown().c);
  }
}
