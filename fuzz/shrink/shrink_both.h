// The smallest case that shows a finding, and the smallest one that a maintainer cannot wave away.
#pragma once

#include <optional>

#include "fuzz/shrink/shrink.h"

namespace touchstone::fuzz {

struct ShrunkPair {
  Shrunk minimum;
  /// The smallest case found among the defensible ones (defensible.h); empty if none was found that shows the
  /// finding. It may be equal to the minimum, and is never smaller.
  std::optional<Shrunk> defensible;
  std::size_t tried() const { return minimum.tried + (defensible ? defensible->tried : 0) + forms_tried; }
  std::size_t forms_tried = 0;  // single cases: the given one, and forms of it
};

/// Looks for a defensible case first: c itself, or one of its forms (defensible_forms.h), or one of those of
/// the minimum, and shrinks it as long as it stays defensible. The minimum is what shrink() promises.
/// tried() is at most max_tries, but for the last batch of each search.
ShrunkPair shrink_both(const Case& c, const StillShows& still, std::size_t max_tries = 20000);

/// The same, and the minimum too has volume and plain numbers (is_solid in defensible.h), if c or one of its
/// nearest forms that show the finding has: a finding that needs bodies to touch is then shown by bodies that
/// touch, and not by points.
ShrunkPair shrink_solid(const Case& c, const StillShows& still, std::size_t max_tries = 20000);

}  // namespace touchstone::fuzz
