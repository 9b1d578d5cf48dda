// Suggestions for unknown names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace touchstone {

/// "; did you mean a, b?", with at most three names, the nearest first; empty when none is near. Near means:
/// equal up to two typing errors (one for words of up to four letters), or one is a prefix of the other.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace touchstone
