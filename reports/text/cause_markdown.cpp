// A cause as Markdown (GitHub's, which GitLab also reads). Everything that comes from data is hostile: it
// must not become markup, end a code block, mention a user or be a command.
#include <fmt/format.h>

#include <algorithm>

#include "reports/text/cause_words.h"
#include "reports/text/causes_text.h"
#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {
namespace {

using fuzz::Cause;
using fuzz::CauseCase;
using fuzz::Json;
using fuzz::Responded;

// An issue of GitHub holds 65,536 characters.
constexpr std::size_t longest_code = 16'000;

std::size_t longest_run_of_backticks(std::string_view text) {
  std::size_t run = 0, longest = 0;
  for (const char c : text) longest = std::max(longest, run = c == '`' ? run + 1 : 0);
  return longest;
}

// Code within a line. A pipe would end a table's cell even there.
std::string code(std::string_view words) {
  std::string s = one_line(words);
  std::replace(s.begin(), s.end(), '|', '/');
  const std::string ticks(longest_run_of_backticks(s) + 1, '`');
  return ticks.size() == 1 && !s.empty() ? ticks + s + ticks : ticks + " " + s + " " + ticks;
}

std::string fenced(std::string_view language, const std::string& text) {
  const std::string fence(std::max<std::size_t>(3, longest_run_of_backticks(text) + 1), '`');
  return fmt::format("{}{}\n{}{}{}\n", fence, language, text, text.ends_with('\n') ? "" : "\n", fence);
}

// Empty if it is too long. Only ASCII: text that runs from right to left would hide what the JSON says.
std::string json_block(const Json& j) {
  const std::string text = j.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > longest_code ? "" : fenced("json", text);
}

std::string folded(std::string_view summary, const std::string& block) {
  return fmt::format("<details><summary>{}</summary>\n\n{}\n</details>\n", summary, block);
}

std::string code_list(const std::vector<std::string>& items, std::size_t most) {
  std::string s;
  for (std::size_t i = 0; i < std::min(most, items.size()); ++i) s += (i > 0 ? ", " : "") + code(items[i]);
  return items.size() > most ? s + fmt::format(" and {} more", items.size() - most) : s;
}

std::string facts(const Cause& c) {
  constexpr std::size_t most = 12;
  std::string s = fmt::format("- **Library:** {}", markdown_prose(c.library));
  if (!c.engines.empty()) s += fmt::format(" ({})", code_list(c.engines, most));
  s += fmt::format("\n- **Severity:** {}; {}\n", to_string(c.severity), rate_text(c));
  if (!c.questions.empty()) s += fmt::format("- **Questions:** {}\n", code_list(c.questions, most));
  if (!c.shapes.empty()) s += fmt::format("- **Shapes:** {}\n", code_list(c.shapes, most));
  if (c.worst_in_l > 0) s += fmt::format("- **Worst error:** {} of the bodies' size\n", small(c.worst_in_l));
  if (!c.documented.empty()) s += fmt::format("- **Documented:** {}\n", markdown_prose(c.documented));
  return s;
}

std::string scene(const CauseCase& shown) {
  const std::string block = json_block(shown.c);
  const std::string size = size_text(shown.size);
  if (block.empty()) return fmt::format("The case ({}) is too long to print here; it is attached.\n", size);
  return fmt::format("The case ({}; `case.json` below):\n\n{}", size, block);
}

std::string responses(const Cause& c) {
  std::string rows;
  for (const Responded& r : telling_responses(c))
    rows += fmt::format("| {} | {} |\n", markdown_prose(r.change), words_of(r.response));
  return rows.empty() ? "" : "\n## What makes it vanish\n\n| change | answer then |\n|---|---|\n" + rows;
}

std::string reproduction(const Cause& c) {
  const std::string engine = shell_word(one_line(c.shown().engine));
  std::string s = "\n## How to reproduce\n\n";
  if (c.program.starts_with('{') && c.program.size() <= longest_code)
    s += "The lines for a command behind a pipe; the last one states what is right:\n\n" +
         fenced("json", printable(c.program, "\n\t")) + "\n";
  else if (!c.program.empty() && c.program.size() <= longest_code)
    s += "A program in the engine's own API; it exits with 1 while the answer is wrong:\n\n" +
         fenced("cpp", printable(c.program, "\n\t")) + "\n";
  else if (!c.program.empty())
    s += "The program in the engine's own API is too long to print here; it is attached.\n\n";
  else if (!c.no_program.empty())
    s += fmt::format("There is no program in the engine's own API: {}.\n\n", markdown_prose(c.no_program));
  return s + "With Touchstone, the case saved as `case.json`:\n\n" +
         fenced("sh", "touchstone replay case.json --engines " + engine);
}

std::string certificate(const Cause& c) {
  if (c.certificate.is_null()) return "";
  const std::string block = json_block(c.certificate);
  if (block.empty()) return "\nThe certificate is too long to print here; it is attached.\n";
  return "\n" +
         folded("Certificate of the right answer",
                "Saved as `certificate.json`, it is verified in exact arithmetic, from the scene alone, by\n"
                "`touchstone check certificate.json --case case.json`.\n\n" +
                    block);
}

}  // namespace

std::string cause_markdown(const Cause& c) {
  const CauseCase& shown = c.shown();
  std::string s = fmt::format("# {}: {}\n\n{}\n", markdown_prose(c.path), markdown_prose(c.title), facts(c));
  s += fmt::format("**Expected:** {}\n\n**Actual:** {}\n\n", expected_of(c.severity), code(shown.words));
  if (!shown.c.is_null()) s += scene(shown);
  s += responses(c);
  if (!c.consequences.empty()) s += fmt::format("\nConsequences: {}.\n", code_list(c.consequences, 12));
  if (!shown.c.is_null()) s += reproduction(c);
  return s + certificate(c) + fmt::format("\nFound by Touchstone; cause {}.\n", code(c.id));
}

}  // namespace touchstone::reports
