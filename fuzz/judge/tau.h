// τ of an answer: the error up to which it is right (docs/truth.md §3).
#pragma once

#include <cmath>
#include <string_view>

#include "scenarios/value/engine_card.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

/// Relative widening that covers the roundings of a speed bound (about ten). Bites: tests/fuzz judge, late
/// impacts.
inline constexpr double speed_rounding = 0x1p-40;

/// A claimed tolerance above this share of L is shown beside every verdict, and its engine is not compared in
/// accuracy with others.
inline constexpr double wide_claim = 1e-2;

/// Source of the claims of an engine that is judged by the user's own tolerance. They are never wide.
inline constexpr std::string_view claimed_by_user = "--error";

/// The tolerance that the engine claims for the answer; a claim without a source, or that is no length, is
/// not believed.
inline double believed_claim(const EngineCard& card, const Observation& o) {
  const double c = o.claimed_tolerance;
  return !card.source.empty() && std::isfinite(c) && c > 0 ? c : 0;
}

/// For a pair of scale l.
inline double tau_of(const EngineCard& card, const Observation& o, double l) {
  return card.tau_factor * card.unit_roundoff * l + believed_claim(card, o);
}

}  // namespace touchstone::fuzz
