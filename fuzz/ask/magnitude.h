// The size of an error in classes that do not change with the last digits: part of the identity of a finding.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace touchstone::fuzz {

enum class Magnitude : std::uint8_t { none, rounding, small, gross };
inline constexpr auto magnitude_names =
    std::to_array<std::string_view>({"none", "rounding", "small", "gross"});
static_assert(magnitude_names.size() == static_cast<std::size_t>(Magnitude::gross) + 1);
constexpr std::string_view to_string(Magnitude m) { return magnitude_names[static_cast<std::size_t>(m)]; }

/// Class of an error divided by L. Rounding: what single precision or a solver's tolerance explains; gross:
/// visible to the eye. NaN and infinity are gross; zero is for answers without an error to measure (a crash).
constexpr Magnitude magnitude_of(double error_in_l) {
  constexpr double rounding_below = 1e-6, gross_from = 1e-2;
  if (error_in_l == 0) return Magnitude::none;
  if (error_in_l < rounding_below) return Magnitude::rounding;
  return error_in_l < gross_from ? Magnitude::small : Magnitude::gross;
}

}  // namespace touchstone::fuzz
