// τ of an answer: the error up to which it is right (docs/truth.md §3).
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/scene/scene.h"
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

/// The coarser unit roundoff of the bodies a and b.
inline double pair_roundoff(const EngineCard& card, const Scene& s, int a, int b) {
  return std::max(roundoff_of(card, kind_of(s.shape_of(a))), roundoff_of(card, kind_of(s.shape_of(b))));
}
/// For the bodies a and b of the scene, a pair of scale l. The engine computes with what it claims, a margin
/// for example, as with the lengths of the bodies, and rounds it too.
inline double tau_of(const EngineCard& card, const Observation& o, const Scene& s, int a, int b, double l) {
  const double claim = believed_claim(card, o);
  return card.tau_factor * pair_roundoff(card, s, a, b) * (l + claim) + claim;
}

// What an engine claims about its settings rather than about one answer (docs/truth.md §3). Zero unless its
// card names a source; the user's own tolerance replaces it.

inline bool are_believed(const EngineCard& card) {
  return !card.source.empty() && card.source != claimed_by_user;
}
/// Bodies apart by at most this may be reported as in contact.
inline double contact_offset(const EngineCard& card) { return are_believed(card) ? card.contact_offset : 0; }
/// A sweep may stop when the gap is at most this.
inline double sweep_skin(const EngineCard& card) { return are_believed(card) ? card.sweep_skin : 0; }
/// A contact with a mesh is that of one of its triangles.
inline bool takes_triangles_apart(const EngineCard& card) {
  return are_believed(card) && card.separate_triangles;
}
/// By what share of the least depth the chosen normal may need more.
inline double depth_bias(const EngineCard& card, ShapeKind a, ShapeKind b) {
  if (!are_believed(card)) return 0;
  for (const DepthBias& d : card.depth_biases)
    if (std::pair(d.a, d.b) == std::pair(std::min(a, b), std::max(a, b))) return d.share;
  return 0;
}

}  // namespace touchstone::fuzz
