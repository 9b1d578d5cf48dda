#include "reports/web_page.h"

#include "core/base/input_error.h"

namespace touchstone::reports {

std::string json_for_script(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

std::string web_page(std::string built, std::string_view json) {
  constexpr std::string_view placeholder = "__TOUCHSTONE_DATA__";
  const auto at = built.find(placeholder);
  if (at == std::string::npos) throw InputError("page", "has no place for data: built from another version?");
  return built.replace(at, placeholder.size(), json_for_script(json));
}

}  // namespace touchstone::reports
