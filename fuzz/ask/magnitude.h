// How large an error is, in words that do not change with the last digits: part of what a finding is.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace touchstone::fuzz {

enum class Magnitude : std::uint8_t { none, rounding, small, gross };
inline constexpr auto magnitude_names =
    std::to_array<std::string_view>({"none", "rounding", "small", "gross"});
constexpr std::string_view to_string(Magnitude m) { return magnitude_names[static_cast<std::size_t>(m)]; }

/// Of an error divided by L. Rounding: what single precision or a solver's tolerance explains; gross: what a
/// person sees. NaN and infinity are gross; zero is an answer that has no error to measure (a crash).
constexpr Magnitude magnitude_of(double error_in_l) {
  if (error_in_l == 0) return Magnitude::none;
  if (error_in_l < 1e-6) return Magnitude::rounding;
  return error_in_l < 1e-2 ? Magnitude::small : Magnitude::gross;
}

}  // namespace touchstone::fuzz
