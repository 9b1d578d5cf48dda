#include "reports/text/cause_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "reports/text/text.h"
#include "scenarios/text/printable.h"

namespace touchstone::reports {

using fuzz::Cause;
using fuzz::Response;
using fuzz::Severity;

std::string one_line(std::string_view words) {
  std::string s = printable(words, "\n\r\t");
  std::replace_if(
      s.begin(), s.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return s;
}

std::string markdown_prose(std::string_view words) {
  std::string s;
  for (const char c : one_line(words)) {
    if (c == '<')
      s += "&lt;";
    else if (c == '&')
      s += "&amp;";
    else if (c == '@')
      s += "@<!-- -->";  // an escaped @ still mentions a user
    else if (std::string_view("\\`*_{}[]>#|~$").find(c) != std::string_view::npos)
      s += {'\\', c};
    else
      s += c;
  }
  return s;
}

std::string share_text(double share) {
  constexpr double least = 0.05, one_decimal_below = 9.95;  // in %, where the rounding changes
  const double x = 100 * share;
  if (!(x > 0)) return "0 %";
  if (share >= 1) return "100 %";
  if (x < least) return "<0.1 %";
  if (x < one_decimal_below) return fmt::format("{:.1f} %", x);
  return fmt::format("{:.0f} %", std::min(x, 99.0));
}

std::string rate_text(const Cause& c) {
  if (c.asked == 0) return counted(c.wrong, "wrong answer", "wrong answers");
  const double rate = c.rate();
  const std::string_view word = c.asked < fuzz::fewest_for_rate  ? ""
                                : rate >= fuzz::systematic_from  ? ": systematic"
                                : rate < fuzz::corner_case_below ? ": corner case"
                                                                 : "";
  return fmt::format("{} of {} wrong ({}){}", grouped(c.wrong), grouped(c.asked), share_text(rate), word);
}

std::string listed(const std::vector<std::string>& items, std::size_t width) {
  std::string s;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = one_line(items[i]);
    const std::size_t left = items.size() - i - 1;
    const std::string more = left > 0 ? fmt::format(" and {} more", left) : "";
    if (i > 0 && s.size() + 2 + item.size() + more.size() > width)
      return s + fmt::format(" and {} more", left + 1);
    s += (i > 0 ? ", " : "") + cut_utf8(item, width);
  }
  return s;
}

std::string size_text(const CaseSize& s) {
  std::string text = counted(s.bodies, "body", "bodies");
  if (s.steps > 0) text += ", " + counted(s.steps, "step", "steps");
  return text + ", " + counted(s.bits, "bit", "bits");
}

std::string_view expected_of(Severity s) {
  switch (s) {
    case Severity::crash:
      return "The call returns an answer.";
    case Severity::hang:
      return "An answer within the time limit.";
    case Severity::missed:
      return "The overlap, impact or pair exists and is reported.";
    case Severity::ghost:
      return "No overlap, impact or pair is reported, since there is none.";
    case Severity::infeasible:
      return "Moving a body by the stated depth along the stated normal separates the two.";
    case Severity::time:
      return "The first time at which the bodies touch.";
    case Severity::not_minimal:
      return "The least depth of all directions, and the direction in which it is least.";
    case Severity::distance:
      return "The signed distance of the bodies.";
    case Severity::witness:
      return "Points of the bodies, where the answer says they are.";
    case Severity::declined:
      return "An answer.";
    case Severity::unstable:
      return "The same answer to the same question.";
    case Severity::relation:
      return "Answers that agree for two forms of the same scene.";
  }
  return "";
}

std::vector<fuzz::Responded> telling_responses(const Cause& c) {
  std::vector<fuzz::Responded> all;
  for (const Response wanted : {Response::gone, Response::differs, Response::stays, Response::open})
    std::copy_if(c.response.begin(), c.response.end(), std::back_inserter(all),
                 [&](const fuzz::Responded& r) { return r.response == wanted; });
  return all;
}

std::string_view words_of(Response r) {
  switch (r) {
    case Response::stays:
      return "still wrong";
    case Response::gone:
      return "right";
    case Response::differs:
      return "wrong in another way";
    case Response::open:
      return "not decided";
    case Response::not_applicable:
      return "not applicable";
  }
  return "";
}

std::string command_of(const Cause& c, const std::string& command) {
  return command + " --cause " + shell_word(c.id);
}

}  // namespace touchstone::reports
