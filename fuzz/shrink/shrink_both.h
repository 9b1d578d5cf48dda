// The smallest case that shows a finding, and the smallest one that a maintainer cannot wave away.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/shrink.h"

namespace touchstone::fuzz {

/// What a maintainer accepts, best first; a later one is looked for when no case was found for those before.
using Standard = bool (*)(const Case& c);
inline constexpr std::array<Standard, 1> only_defensible{is_defensible};
inline constexpr std::array<Standard, 2> defensible_or_solid{is_defensible, is_solid};

struct ShrunkPair {
  Shrunk minimum;
  /// The smallest case found among those of the first standard that has any; empty if none was found that
  /// shows the finding. It may be equal to the minimum, and is never smaller.
  std::optional<Shrunk> defensible;
  std::size_t tried() const { return minimum.tried + (defensible ? defensible->tried : 0) + forms_tried; }
  std::size_t forms_tried = 0;  // single cases: the given one, and forms of it
};

/// Looks for a defensible case first: c itself, or one of its forms (defensible_forms.h), or one of those of
/// the minimum, and shrinks it as long as it stays defensible. The minimum is what shrink() promises.
/// tried() is at most max_tries, but for the last batch of each search.
ShrunkPair shrink_both(const Case& c, const StillShows& still, std::size_t max_tries = 20000,
                       std::span<const Standard> standards = only_defensible);

}  // namespace touchstone::fuzz
