// Suggestions for names that nobody knows.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace touchstone {

/// "; did you mean a, b?", at most three names, the nearest first; empty when none is near: equal but for two
/// typing errors (one in a word of up to four letters), or one the beginning of the other.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace touchstone
