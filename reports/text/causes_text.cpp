#include "reports/text/causes_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/record/result.h"
#include "reports/text/cause_words.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using fuzz::Cause;
using fuzz::CauseCase;
using fuzz::Causes;
using fuzz::Responded;

constexpr std::size_t line_width = 79;

// At most `most` lines, all but the first indented by `hang`. A word longer than a line is broken.
std::string paragraph(std::string_view words, std::size_t indent, std::size_t most, std::size_t hang) {
  const std::size_t width = line_width - hang;
  std::string broken;
  std::size_t in_word = 0;
  for (std::string_view rest = std::string_view(words); !rest.empty();) {
    const std::size_t n = std::max<std::size_t>(1, utf8_length(rest));
    in_word = rest[0] == ' ' ? 0 : in_word + n;
    if (in_word > width) {
      broken += ' ';
      in_word = n;
    }
    broken += rest.substr(0, n);
    rest.remove_prefix(n);
  }
  const std::string margin(indent, ' ');
  const std::string all = wrapped(margin + broken, line_width, hang) + "\n";
  std::size_t end = 0;
  for (std::size_t i = 0; i < most && end < all.size(); ++i) end = all.find('\n', end) + 1;
  if (end == all.size()) return all;
  constexpr std::string_view mark = " ...";
  const std::size_t last = all.rfind('\n', end - 2) + 1;
  std::string line = all.substr(last, end - 1 - last);
  if (line.size() + mark.size() > line_width) {
    line = cut_utf8(line, line_width - mark.size());
    if (const std::size_t space = line.rfind(' '); space != std::string::npos && space > line_width / 2)
      line.resize(space);
  }
  return all.substr(0, last) + line + std::string(mark) + "\n";
}

std::string text_block(std::string_view words, std::size_t indent, std::size_t most = 3) {
  return paragraph(one_line(words), indent, most, indent);
}

std::string documented_line(const Cause& c, std::size_t indent) {
  return c.documented.empty() ? "" : text_block("documented: " + c.documented, indent);
}

std::string block(const Cause& c, std::size_t number, const std::string& command) {
  constexpr std::size_t indent = 4, list_width = line_width - indent;
  std::string s =
      text_block(fmt::format("{:>2}. {}  {}  {}", number, to_string(c.severity), c.path, rate_text(c)), 0, 2);
  s += text_block(c.title, indent);
  s += documented_line(c, indent);
  const std::string asked = listed(c.questions, list_width / 2);
  const bool are_any =
      c.shapes == std::vector{std::string(fuzz::any_shapes)};  // of failures at one place in the code
  const std::string shapes = are_any ? "any shapes" : listed(c.shapes, list_width - asked.size() - 2);
  s += text_block(shapes + (shapes.empty() || asked.empty() ? "" : "; ") + asked, indent, 1);
  const CauseCase& shown = c.shown();
  if (!shown.words.empty()) s += text_block(fmt::format("e.g. {}: {}", shown.engine, shown.words), indent);
  return s + std::string(indent, ' ') + command_of(c, command) + "\n";
}

std::string ending(const Causes& c) {
  std::string s = text_block(
      fmt::format("{} behind {} ({}); chance that the next wrong answer is of a cause not listed: {}",
                  counted(c.causes.size(), "cause", "causes"),
                  counted(c.answers, "wrong answer", "wrong answers"), counted(c.keys, "key", "keys"),
                  share_text(c.unseen)),
      0);
  for (const std::string& note : c.notes) s += text_block("note: " + note, 0);
  return s;
}

// "name:  a, b, c", all of them.
std::string row_of(std::string_view name, const std::vector<std::string>& items) {
  std::string all;
  for (const std::string& item : items) all += (all.empty() ? "" : ", ") + one_line(item);
  return all.empty() ? "" : paragraph(fmt::format("{}: {}", name, all), 2, 40, 2);
}

std::string case_row(std::string_view name, const CauseCase& c) {
  if (c.c.is_null()) return "";
  std::string s = text_block(fmt::format("{}: {}, {}{}", name, c.engine, size_text(c.size),
                                         c.error_in_l > 0 ? fmt::format(", {} L", small(c.error_in_l)) : ""),
                             2);
  if (!c.words.empty()) s += text_block(c.words, 4);
  return s + text_block(c.key, 4);
}

// Changes after which the answer is still wrong are listed in brief, and those that do not apply are counted.
std::string response_table(const Cause& c) {
  std::vector<Responded> rows = telling_responses(c);
  if (rows.empty()) return "";
  const std::size_t left_out = c.response.size() - rows.size();
  std::string still;
  for (const Responded& r : rows)
    if (r.response == fuzz::Response::stays) still += (still.empty() ? "" : "; ") + one_line(r.change);
  std::erase_if(rows, [](const Responded& r) { return r.response == fuzz::Response::stays; });
  constexpr std::size_t most_width = 55, most_lines = 40;
  std::size_t width = 0;
  for (const Responded& r : rows) width = std::max(width, std::min(most_width, one_line(r.change).size()));
  std::string s = rows.empty() ? "" : "What was changed, and the answer then\n";
  for (const Responded& r : rows)
    s += fmt::format("  {:<{}}  {}\n", cut_utf8(one_line(r.change), most_width), width, words_of(r.response));
  if (!still.empty()) s += "Still wrong when changed thus\n" + paragraph(still, 2, most_lines, 2);
  if (left_out > 0) s += fmt::format("  and {} not applicable\n", left_out);
  return s;
}

// What the answer should be, and what it is, in the case that is shown.
std::string expected_and_actual(const Cause& c) {
  const CauseCase& shown = c.shown();
  std::string s = text_block(fmt::format("expected: {}", expected_of(c.severity)), 2);
  if (!shown.words.empty()) s += text_block(fmt::format("actual: {}: {}", shown.engine, shown.words), 2);
  return s;
}

}  // namespace

std::string causes_text(const Causes& c, const std::string& command) {
  std::string s;
  std::size_t number = 0;
  for (const Cause& cause : c.causes) s += block(cause, ++number, command) + "\n";
  if (c.causes.empty()) s = "no causes: no answer was wrong\n";
  return s + ending(c);
}

std::string cause_text(const Cause& c) {
  std::string s = text_block(fmt::format("{}  {}  {}", to_string(c.severity), c.path, c.id), 0);
  s += text_block(c.title, 2);
  s += documented_line(c, 2);
  s += expected_and_actual(c);
  s += text_block(rate_text(c), 2);
  if (c.worst_in_l > 0) s += text_block(fmt::format("worst error: {} L", small(c.worst_in_l)), 2);
  s += text_block(fmt::format("{}{}routine: {}; first seen in case {}", c.library,
                              c.library.empty() ? "" : "; ", c.route, c.first_index),
                  2);
  s += row_of("engines", c.engines) + row_of("questions", c.questions) + row_of("faults", c.faults);
  s += row_of("shapes", c.shapes) + row_of("families", c.families);
  s += text_block(fmt::format("filed under {}", counted(c.keys.size(), "key", "keys")), 2);
  if (!c.consequences.empty()) {
    s += "\nConsequences\n";
    for (const std::string& one : c.consequences) s += text_block(one, 2);
  }
  s += "\nCases\n" + case_row("defensible", c.defensible) + case_row("smallest", c.smallest) +
       case_row("worst", c.worst);
  if (const std::string table = response_table(c); !table.empty()) s += "\n" + table;
  if (!c.program.empty())
    return s + "\nProgram in the engine's own API\n" + printable(c.program, "\n\t") + "\n";
  return s + (c.no_program.empty() ? "" : "\n" + text_block("no program: " + c.no_program, 0));
}

bool is_named(const Cause& c, std::string_view code) {
  return c.id == code || (c.id.ends_with(code) && c.id[c.id.size() - code.size() - 1] == '-');
}

std::string_view code_of(const Cause& c, const Causes& all) {
  const std::string_view id = c.id;
  for (std::size_t dash = id.rfind('-'); dash != std::string_view::npos && dash > 0;
       dash = id.rfind('-', dash - 1)) {
    const std::string_view code = id.substr(dash + 1);
    if (std::ranges::count_if(all.causes, [&](const Cause& one) { return is_named(one, code); }) == 1)
      return code;
  }
  return id;
}

// A place in code is never cut off: a crash may have two lines.
static std::string in_brief(const Cause& c, const Causes& all, bool with_path) {
  constexpr std::size_t indent = 2, hang = 17;  // further lines begin under the words
  const std::string words =
      fmt::format("{} {:>7} {}: {}{}{}", code_of(c, all), grouped(c.wrong), to_string(c.severity),
                  with_path ? c.path + ": " : "", c.title, c.documented.empty() ? "" : " (documented)");
  return paragraph(one_line(words), indent, c.severity == fuzz::Severity::crash ? 2 : 1, hang);
}

// What an engine declined is no wrong answer.
static std::string answers_behind(const std::vector<const Cause*>& causes) {
  std::uint64_t wrong = 0, declined = 0;
  for (const Cause* c : causes) (c->severity == fuzz::Severity::declined ? declined : wrong) += c->wrong;
  if (declined == 0) return counted(wrong, "wrong answer", "wrong answers");
  if (wrong == 0) return counted(declined, "declined answer", "declined answers");
  return fmt::format("{} wrong and {} declined answers", grouped(wrong), grouped(declined));
}

std::string causes_of_libraries(const Causes& c, std::size_t most, const LibraryOf& library_of) {
  std::map<std::string, std::vector<const Cause*>> libraries;
  for (const Cause& cause : c.causes) libraries[library_of(cause.path)].push_back(&cause);
  std::string s;
  for (const auto& [library, causes] : libraries) {
    s += text_block(fmt::format("{}: {} behind {}", library, counted(causes.size(), "cause", "causes"),
                                answers_behind(causes)),
                    0, 1);
    const std::size_t shown = std::min(most, causes.size());
    for (std::size_t i = 0; i < shown; ++i) s += in_brief(*causes[i], c, causes[i]->path != library);
    if (causes.size() > shown) s += fmt::format("  and {} more\n", causes.size() - shown);
  }
  return s;
}

}  // namespace touchstone::reports
