// Names from the command line: lists separated by commas, and suggestions for a misspelt name.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace touchstone {

/// Calls visit(std::string_view) for each part between commas, including empty ones; an empty list is one
/// empty part.
template <class Visit>
void for_each_in_list(std::string_view list, Visit&& visit) {
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    visit(list.substr(from, comma - from));
    from = comma + 1;
  }
}

/// "; did you mean a, b?", with at most three names, the nearest first; empty when none is near. Near means:
/// equal up to two typing errors (one for words of up to four letters), or one is a prefix of the other.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace touchstone
