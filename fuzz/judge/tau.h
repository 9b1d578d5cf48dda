// τ of an answer: the error up to which it is right (docs/truth.md §3).
#pragma once

#include <cmath>
#include <string_view>

#include "scenarios/value/engine_card.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// Relative widening that covers the roundings of a speed bound (about ten). Tested by: tests/fuzz "time
/// of impact is judged by gaps".
inline constexpr double speed_rounding = 0x1p-40;

/// A claimed tolerance above this share of L is shown beside every verdict, and the engine's accuracy is not
/// compared with that of others.
inline constexpr double wide_claim = 1e-2;

/// `source` of an engine that is judged by the user's own tolerance. Its claims are never wide.
inline constexpr std::string_view claimed_by_user = "--error";

/// The tolerance that the engine claims for the answer; ignored if it has no source or is not a positive
/// length.
inline double believed_claim(const EngineCard& card, const Observation& o) {
  const double c = o.claimed_tolerance;
  return !card.source.empty() && std::isfinite(c) && c > 0 ? c : 0;
}

/// For a pair of scale l.
inline double tau_of(const EngineCard& card, const Observation& o, double l) {
  return card.tau_factor * card.unit_roundoff * l + believed_claim(card, o);
}

}  // namespace touchstone::fuzz
