// Words of printed commands, quoted for the shell.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace touchstone {

/// `text` as one word for the shell, quoted if necessary. Names from files end up in commands that people
/// copy: unquoted, such a name could be a command of its own.
inline std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-+=./:@,%^").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace touchstone
