// Lists of names as people write them: a,b,c.
#pragma once

#include <algorithm>
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

}  // namespace touchstone
