// An engine's name and its description of itself.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/roundoff.h"
#include "core/shape/shape.h"

namespace touchstone {

inline constexpr std::size_t max_engine_name_bytes = 64;

/// At most 64 printable ASCII characters, none of them / or \, the first a letter or digit.
inline bool is_engine_name(std::string_view name) {
  const auto is_letter_or_digit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  if (name.empty() || name.size() > max_engine_name_bytes || !is_letter_or_digit(name.front())) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return c >= ' ' && c <= '~' && c != '/' && c != '\\'; });
}

/// An engine's description of itself: the JSON card of touchstone_engine.h.
/// τ of an answer = tau_factor · unit_roundoff · L + the answer's claimed_tolerance (docs/truth.md §3).
struct EngineCard {
  std::string name;      // catalog name, e.g. "fcl-libccd-tuned"
  std::string library;   // "FCL"
  std::string version;   // "0.7.0"
  std::string settings;  // one line: differences from the default, the code path queried
  double unit_roundoff = double_roundoff;
  double tau_factor = 64;
  std::string source;  // where the tolerance claims come from; empty: they are not accepted
  /// Manifolds span the whole contact region, not just a few points of it.
  bool complete_manifolds = false;
  /// The kinds after last_common_shape that it takes.
  std::vector<ShapeKind> more_shapes = {};
  bool operator==(const EngineCard&) const = default;
};

/// Every engine is sent the kinds up to this one (TS_LAST_COMMON_SHAPE), and those after it that its card
/// lists.
inline constexpr ShapeKind last_common_shape = ShapeKind::mesh;
inline bool is_sent(const EngineCard& card, ShapeKind k) {
  return k <= last_common_shape || std::ranges::find(card.more_shapes, k) != card.more_shapes.end();
}

}  // namespace touchstone
