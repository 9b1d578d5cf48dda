// First contact of two movers, in double. Conservative advancement (Mirtich 1996), two-sided at each end: the
// gap from nearest points says when to stop, support planes prove every time that is passed over.
#pragma once

#include <optional>

#include "core/impact/filtered/follow.h"

namespace touchstone::ccd::fast {

enum class SearchEnd {
  hit,     // the gap at `clear_until` is positive and at most `accuracy`
  clear,   // no contact up to the end
  unsure,  // none before `clear_until`; double says no more
  start    // the same at the very start: they may already be in contact
};

struct Search {
  SearchEnd end = SearchEnd::unsure;
  double clear_until = 0;                // proven
  double gap = 0;                        // hit: as computed. Otherwise at the last look
  Vec normal = Vec::Zero();              // A to B
  Vec a = Vec::Zero(), b = Vec::Zero();  // hit: nearest points at that time about A's origin, world axes
  bool rough = false;                    // hit: a and b are not as good as the gap
  int steps = 0;
};

/// From `start` on, before which there is no contact. `plane`: B is a half-space, as a point on its face,
/// with its inward normal.
Search search(const Sweep& sweep, double start, double end, double accuracy, const std::optional<Vec>& plane);

/// What is known, in coordinates about A's start; of `unsure` and `start` nothing but the time that is clear.
ImpactAnswer answer_of(const Search& s, const Vec& linear_a);

/// A hit with its nearest points worked out anew.
Search with_points(const Sweep& sweep, Search hit, double accuracy);

}  // namespace touchstone::ccd::fast
