// An engine's description of itself.
#pragma once

#include <string>

#include "core/math/roundoff.h"

namespace touchstone {

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
  bool operator==(const EngineCard&) const = default;
};

}  // namespace touchstone
