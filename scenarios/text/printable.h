// Makes text from outside safe to show or store. Names in files, engine cards and the last output of a
// crashing process can be any bytes: some would end a JSON document, others move the cursor of a terminal or
// reverse its text.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

namespace touchstone {

/// The length of the well-formed UTF-8 sequence at the start of s; 0 when there is none.
inline std::size_t utf8_length(std::string_view s) {
  const auto byte = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0U; };
  const unsigned a = byte(0), b = byte(1);
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  if (s.empty()) return 0;
  if (a < 0x80) return 1;
  if (a >= 0xC2 && a <= 0xDF) return follows(1) ? 2 : 0;
  // Not overlong, not a surrogate, not beyond U+10FFFF.
  if (a >= 0xE0 && a <= 0xEF) {
    const bool second = a == 0xE0 ? b >= 0xA0 && b <= 0xBF : a == 0xED ? b >= 0x80 && b <= 0x9F : follows(1);
    return second && follows(2) ? 3 : 0;
  }
  if (a >= 0xF0 && a <= 0xF4) {
    const bool second = a == 0xF0 ? b >= 0x90 && b <= 0xBF : a == 0xF4 ? b >= 0x80 && b <= 0x8F : follows(1);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

inline constexpr std::string_view replacement_character = "\xEF\xBF\xBD";  // U+FFFD

/// Each byte that is not part of a well-formed sequence becomes U+FFFD.
inline std::string valid_utf8(std::string_view s) {
  std::string r;
  r.reserve(s.size());
  while (!s.empty()) {
    const std::size_t n = utf8_length(s);
    r += n == 0 ? replacement_character : s.substr(0, n);
    s.remove_prefix(n == 0 ? 1 : n);
  }
  return r;
}

/// At most `bytes` of valid UTF-8, cut between characters.
inline std::string cut_utf8(std::string s, std::size_t bytes) {
  if (s.size() <= bytes) return s;
  while (bytes > 0 && (static_cast<unsigned char>(s[bytes]) & 0xC0U) == 0x80U) --bytes;
  s.resize(bytes);
  return s;
}

namespace printable_detail {
// Unicode controls that move the cursor (C0, C1, DEL) or change the direction of text.
inline bool is_control(std::string_view c) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(c[i]); };
  if (c.size() == 1) return at(0) < 0x20 || at(0) == 0x7F;
  if (c.size() == 2) return (at(0) == 0xC2 && at(1) < 0xA0) || c == "\xD8\x9C";  // U+0080-009F, U+061C
  if (c.size() != 3 || at(0) != 0xE2) return false;
  return (at(1) == 0x80 && ((at(2) >= 0x8E && at(2) <= 0x8F) || (at(2) >= 0xA8 && at(2) <= 0xAE))) ||
         (at(1) == 0x81 && at(2) >= 0xA6 && at(2) <= 0xA9);  // U+200E-200F, 2028-202E, 2066-2069
}
}  // namespace printable_detail

/// Valid UTF-8 in which each control character becomes U+FFFD, except those in `keep`, such as "\n".
inline std::string printable(std::string_view s, std::string_view keep = "") {
  std::string r;
  r.reserve(s.size());
  while (!s.empty()) {
    const std::size_t n = utf8_length(s);
    const std::string_view c = s.substr(0, n == 0 ? 1 : n);
    const bool stays = n != 0 && (!printable_detail::is_control(c) || keep.find(c) != std::string_view::npos);
    r += stays ? c : replacement_character;
    s.remove_prefix(c.size());
  }
  return r;
}

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
