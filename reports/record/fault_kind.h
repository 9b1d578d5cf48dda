// The kind of a finding's fault, which stays the same when the engine's code moves.
#pragma once

#include <string_view>

#include "core/base/outcome.h"

namespace touchstone::fuzz {

/// The fault without the site that a failure is named by: "crashed" of "crashed_distance-inl-h-177". A site
/// has a line number or a function's name, so the next version of an engine crashes at "another" site.
constexpr std::string_view kind_of_fault(std::string_view fault) {
  for (const std::string_view outcome : outcome_names)
    if (fault.size() > outcome.size() && fault.starts_with(outcome) && fault[outcome.size()] == '_')
      return outcome;
  return fault;
}

}  // namespace touchstone::fuzz
