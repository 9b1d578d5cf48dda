// Double first; where it does not tell, steps in extended precision until the gap has opened, then double
// again. A pair that starts in a touch or comes within rounding of one, and goes on, costs a few wide steps
// and not a wide path. Each round moves on: the gap at which a round ends grows until double does.
#pragma once

#include "core/impact/advance.h"
#include "core/impact/filtered/impact_search.h"

namespace touchstone::ccd {

inline bool settled(const fast::Search& s) {
  return s.end == fast::SearchEnd::hit || s.end == fast::SearchEnd::clear;
}

/// `fine` unless the search in double has `settled`; its steps are those of all.
struct Pursuit {
  fast::Search search;
  ImpactAnswer fine;
};

/// search_from(t): fast::search from t on. advance_from(t, leave): advance() likewise. No contact before
/// s.clear_until.
template <class Search, class Wider>
Pursuit pursue(const fast::Sweep& sweep, fast::Search s, const Search& search_from,
               const Wider& advance_from) {
  constexpr int step_cap = 40000;
  int steps = s.steps;
  double leave = 64 * sweep.at(s.clear_until, true).error;
  while (!settled(s)) {
    Advance x = advance_from(s.clear_until, leave);
    steps += x.answer.steps;
    x.answer.steps = steps;
    if (!x.wide_open) return {s, x.answer};
    if (steps > step_cap) {
      x.answer.outcome = Outcome::not_converged;
      return {s, x.answer};
    }
    s = search_from(x.answer.clear_until);
    steps += s.steps;
    if (!(s.clear_until > x.answer.clear_until)) leave *= 4;
  }
  s.steps = steps;
  return {s, {}};
}

}  // namespace touchstone::ccd
