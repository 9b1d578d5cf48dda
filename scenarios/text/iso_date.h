// Dates from people and files: ISO 8601, "2026-11-23". Such texts compare as the dates do.
#pragma once

#include <algorithm>
#include <chrono>
#include <string_view>

namespace touchstone {

inline constexpr std::size_t iso_date_length = 10;

/// True for the text of a date that exists: "2026-02-29" is none.
inline bool is_iso_date(std::string_view s) {
  if (s.size() != iso_date_length || s[4] != '-' || s[7] != '-') return false;
  const auto number = [&](std::size_t from, std::size_t digits) {
    int n = 0;
    for (const char c : s.substr(from, digits)) n = c >= '0' && c <= '9' && n >= 0 ? 10 * n + (c - '0') : -1;
    return n;
  };
  const int year = number(0, 4), month = number(5, 2), day = number(8, 2);
  if (year < 0 || month < 0 || day < 0) return false;
  return std::chrono::year_month_day(std::chrono::year(year),
                                     std::chrono::month(static_cast<unsigned>(month)),
                                     std::chrono::day(static_cast<unsigned>(day)))
      .ok();
}

/// True for a date, or a date and time ("2026-11-23T02:00:00Z").
inline bool is_iso_time(std::string_view s) {
  const auto is_of_time = [](char c) {
    return (c >= '0' && c <= '9') || c == ':' || c == '.' || c == '+' || c == '-' || c == 'Z';
  };
  return is_iso_date(s.substr(0, iso_date_length)) &&
         (s.size() == iso_date_length ||
          (s[iso_date_length] == 'T' && std::all_of(s.begin() + iso_date_length + 1, s.end(), is_of_time)));
}

}  // namespace touchstone
