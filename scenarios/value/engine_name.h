// What an engine may call itself: a name is part of keys, of file names, and of what terminals show.
#pragma once

#include <algorithm>
#include <string_view>

namespace touchstone {

inline constexpr std::size_t max_engine_name_bytes = 64;

/// At most 64 printable ASCII characters, none of them / or \, the first a letter or digit.
inline bool is_engine_name(std::string_view name) {
  const auto is_letter_or_digit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (name.empty() || name.size() > max_engine_name_bytes || !is_letter_or_digit(name.front())) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return c >= ' ' && c <= '~' && c != '/' && c != '\\'; });
}

}  // namespace touchstone
