// First contact of two movers, in double. Conservative advancement (Mirtich 1996), with two-sided bounds at
// each end: the gap from nearest points decides when to stop, and support planes prove every time that is
// passed over.
#pragma once

#include <optional>

#include "core/impact/filtered/follow.h"

namespace touchstone::impact::filtered {

enum class SearchEnd {
  hit,     // the gap at `clear_until` is positive and at most `accuracy`
  clear,   // no contact up to the end
  unsure,  // no contact before `clear_until`; double cannot decide further
  start    // as `unsure`, at the start time: they may already be in contact
};

struct Search {
  SearchEnd end = SearchEnd::unsure;
  double clear_until = 0;                // proven
  double gap = 0;                        // hit: as computed; otherwise from the last look
  Vec normal = Vec::Zero();              // A to B
  Vec a = Vec::Zero(), b = Vec::Zero();  // hit: nearest points then, relative to A's origin, world axes
  bool rough = false;                    // hit: a and b are less accurate than the gap
  int steps = 0;
};

/// Searches from `start` on; precondition: no contact before it. `plane`: B is a half-space, given as a point
/// on its face, with its inward normal.
Search search(const Sweep& sweep, double start, double end, double accuracy, const std::optional<Vec>& plane);

/// Converts to an answer relative to A's start; for `unsure` and `start` it contains only the time that is
/// clear.
ImpactAnswer answer_of(const Search& s, const Vec& linear_a);

/// Recomputes the nearest points of a hit.
Search with_points(const Sweep& sweep, Search hit, double accuracy);

}  // namespace touchstone::impact::filtered
