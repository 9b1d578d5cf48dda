#include "reports/text/web_page.h"

#include <fmt/format.h>

#include <cctype>
#include <map>

#include "core/base/exact_text.h"

namespace touchstone::reports {
namespace {

using fuzz::Json;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t after_digits(const std::string& s, std::size_t i) {
  while (i < s.size() && is_digit(s[i])) ++i;
  return i;
}

// The end of the number that begins at i, or i: [-]digits[.digits][e[±]digits].
std::size_t after_number(const std::string& s, std::size_t i) {
  const std::size_t whole = i + (s[i] == '-' ? 1 : 0);
  std::size_t end = after_digits(s, whole);
  if (end == whole) return i;
  if (end + 1 < s.size() && s[end] == '.' && is_digit(s[end + 1])) end = after_digits(s, end + 1);
  if (end < s.size() && s[end] == 'e') {
    const std::size_t power = end + 1 + (end + 1 < s.size() && (s[end + 1] == '-' || s[end + 1] == '+'));
    if (const std::size_t after = after_digits(s, power); after > power) end = after;
  }
  return end;
}

// Values are sorted by name, so that the same findings give the same page.
Json coded(const std::vector<std::string>& column) {
  std::map<std::string, int> codes;
  for (const auto& value : column) codes[value] = 0;
  Json values = Json::array(), list = Json::array();
  for (auto& [value, code] : codes) {
    code = static_cast<int>(values.size());
    values.push_back(value);
  }
  for (const auto& value : column) list.push_back(codes.at(value));
  return {{"values", std::move(values)}, {"codes", std::move(list)}};
}

Json three_digits(const Json& x) {
  return x.is_number_float()
             ? Json(double_from_text(fmt::format("{:.3g}", x.get<double>())).value_or(x.get<double>()))
             : x;
}

}  // namespace

std::string template_of(const std::string& words, std::string& numbers) {
  std::string text;
  for (std::size_t i = 0; i < words.size();) {
    const bool may_begin = i == 0 || !in_name(words[i - 1]);
    const std::size_t end = may_begin ? after_number(words, i) : i;
    if (end > i) {
      text += number_mark;
      if (!numbers.empty()) numbers += ' ';
      numbers.append(words, i, end - i);
      i = end;
    } else {
      text += words[i] == number_mark ? '?' : words[i];
      ++i;
    }
  }
  return text;
}

Json findings_columns(const Json& findings) {
  Json out = {{"count", findings.size()}, {"coded", Json::object()}};
  for (const char* name : {"engine", "question", "fault", "shapes", "blame", "degeneracy", "magnitude"}) {
    std::vector<std::string> column;
    for (const auto& f : findings) column.push_back(f.at(name).get<std::string>());
    out["coded"][name] = coded(column);
  }
  Json answers = Json::array(), worst = Json::array();
  std::vector<std::string> templates;
  std::string numbers;
  for (const auto& f : findings) {
    answers.push_back(f.at("count"));
    worst.push_back(three_digits(f.at("worst_in_l")));
    templates.push_back(template_of(f.at("words").get<std::string>(), numbers));
  }
  const Json words = coded(templates);
  out["answers"] = std::move(answers);
  out["worst_in_l"] = std::move(worst);
  out["words"] = {{"templates", words["values"]}, {"codes", words["codes"]}, {"numbers", numbers}};
  return out;
}

}  // namespace touchstone::reports
