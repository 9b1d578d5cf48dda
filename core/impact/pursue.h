// Tries double first. Where it is undecided, continues in extended precision until the gap has opened, then
// returns to double. A pair that starts touching, or comes within rounding of contact and separates again,
// costs a few wide steps instead of a wide path. Every round makes progress: the gap at which a round ends
// grows until double can continue.
#pragma once

#include "core/impact/advance.h"
#include "core/impact/filtered/impact_search.h"

namespace touchstone::impact {

inline bool settled(const filtered::Search& s) {
  return s.end == filtered::SearchEnd::hit || s.end == filtered::SearchEnd::clear;
}

/// `fine` is the result unless the search in double has `settled`; its steps are the total.
struct Pursuit {
  filtered::Search search;
  ImpactAnswer fine;
};

/// search_from(t): filtered::search from t on. advance_from(t, leave): advance() from t on. Precondition: no
/// contact before s.clear_until.
template <class Search, class Wider>
Pursuit pursue(const filtered::Sweep& sweep, filtered::Search s, const Search& search_from,
               const Wider& advance_from) {
  constexpr int step_cap = 40000;
  int steps = s.steps;
  double leave = 64 * sweep.at(s.clear_until, true).error;
  while (!settled(s)) {
    Advance x = advance_from(s.clear_until, leave);
    steps += x.answer.steps;
    x.answer.steps = steps;
    if (!x.gap_opened) return {s, x.answer};
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

}  // namespace touchstone::impact
