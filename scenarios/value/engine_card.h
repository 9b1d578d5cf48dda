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

/// By what share of the least depth the normal that an engine chooses for a pair of these kinds (a <= b) may
/// need more.
struct DepthBias {
  ShapeKind a = ShapeKind::sphere, b = ShapeKind::sphere;
  double share = 0;
  bool operator==(const DepthBias&) const = default;
};
/// The unit roundoff of a kind that is computed more coarsely than the others.
struct KindRoundoff {
  ShapeKind kind = ShapeKind::sphere;
  double unit_roundoff = 0;
  bool operator==(const KindRoundoff&) const = default;
};

/// An engine's description of itself: the JSON card of touchstone_engine.h.
/// τ of an answer = tau_factor · unit_roundoff · (L + c) + c, with c its claimed_tolerance (docs/truth.md,
/// section 3).
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
  /// All kinds that it takes; empty: the common ones and more_shapes.
  std::vector<ShapeKind> shapes = {};
  std::vector<KindRoundoff> unit_roundoffs = {};
  /// Bodies apart by at most this are reported as in contact. A length; believed only with a source.
  double contact_offset = 0;
  /// A sweep stops when the gap is at most this. A length; believed only with a source.
  double sweep_skin = 0;
  std::vector<DepthBias> depth_biases = {};  // believed only with a source
  /// A contact with a mesh is that of one of its triangles, as if the others were not there, so that its
  /// normal may be that of an edge inside a flat part; believed only with a source.
  bool separate_triangles = false;
  /// Times include talking to another process, so they are not charted as the engine's.
  bool times_include_pipe = false;
  bool operator==(const EngineCard&) const = default;
};

/// An engine whose card lists no `shapes` is sent the kinds up to this one (TS_LAST_COMMON_SHAPE), and those
/// after it that its card adds.
inline constexpr ShapeKind last_common_shape = ShapeKind::mesh;
inline bool is_sent(const EngineCard& card, ShapeKind k) {
  const auto has = [k](const std::vector<ShapeKind>& list) {
    return std::ranges::find(list, k) != list.end();
  };
  return card.shapes.empty() ? k <= last_common_shape || has(card.more_shapes) : has(card.shapes);
}

/// Of what an engine computes with a shape of this kind.
inline double roundoff_of(const EngineCard& card, ShapeKind k) {
  double u = card.unit_roundoff;
  for (const KindRoundoff& r : card.unit_roundoffs)
    if (r.kind == k) u = std::max(u, r.unit_roundoff);
  return u;
}

}  // namespace touchstone
