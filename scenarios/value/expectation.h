// The true answers of a case, derived on paper.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace touchstone {

/// The truth, independent of any engine and of the referee. Pair fields refer to bodies 0 (A) and 1 (B).
struct Expectation {
  /// |truth - value| <= tolerance, in the scene's unit. 0: the closed form is exact for the scene's doubles.
  struct Value {
    double value = 0, tolerance = 0;
    bool operator==(const Value&) const = default;
  };
  struct Impact {
    bool hit = false;
    double time = 0, tolerance = 0;  // of a hit
    bool operator==(const Impact&) const = default;
  };
  std::optional<bool> overlap;  // of the closed bodies: touching counts
  std::optional<Value> gap;     // signed: minus the depth when the bodies overlap
  std::optional<Vec3>
      normal;  // a direction A to B of least depth (or of the gap); one of several when they tie
  std::optional<Impact> impact;
  std::optional<int> all_pairs;  // n(n-1)/2
  std::optional<int> box_pairs;  // pairs whose tight axis-aligned boxes share a point
  std::optional<int>
      overlapping_pairs;  // pairs that share a point, at the bodies' own poses, filtered ones excluded
  /// For each query of the script, exactly the pairs that share a point, sorted, filtered ones excluded.
  std::vector<std::vector<BodyPair>> pairs_at_query;
  std::string reason;
  bool operator==(const Expectation& o) const {
    return overlap == o.overlap && gap == o.gap && normal == o.normal && impact == o.impact &&
           all_pairs == o.all_pairs && box_pairs == o.box_pairs && overlapping_pairs == o.overlapping_pairs &&
           pairs_at_query == o.pairs_at_query && reason == o.reason;
  }
};

}  // namespace touchstone
