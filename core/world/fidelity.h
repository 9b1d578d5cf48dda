// The least model that a scene needs: what `touchstone plan` finds and StepWorld runs.
//
// Contract. With `error` E > 0, every pair that is answered has been decided within E: a pair reported in
// contact has a gap of at most E, one that is left out is no deeper than E; the depth along the reported
// normal is right to E and exceeds the least depth by no more than E. (Unsupported and not_converged are
// reported as ever; where the core itself cannot prove that a depth is the least, regret_bound is larger than
// E and says so.) E must be 2^-44 of the scene's largest coordinate or more. Of E, 0.6 at most goes to
// simpler shapes, 0.125 to placing them, the rest to arithmetic: a cheap answer whose proven bound, with the
// rounding of its input, is larger is worked out anew.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/narrow/narrow_phase.h"
#include "core/world/simpler_shape.h"
#include "core/world/sweep_criterion.h"

namespace touchstone {

struct SweepOptions {
  enum class Which { none, by_criterion, all };
  /// none: discrete only. all: every moving body, for comparison.
  Which which = Which::by_criterion;
  double share = 0.5;  // of the inner extents, sweep_criterion.h
};

/// How contacts of two kinds of shapes are found.
struct PairMethod {
  /// Bodies whose bounding balls are apart are apart: not asked.
  bool balls_first = false;
  /// float32, float64_alone: first, and float64, with extended precision behind it, where that does not prove
  /// enough.
  Arithmetic arithmetic = Arithmetic::float64;
  bool operator==(const PairMethod&) const = default;
};

struct Fidelity {
  double error = 0;                                  // E, in the scene's unit; 0: nothing is traded
  std::string broad_phase = "automatic";             // broad/catalog.h
  std::vector<std::optional<SimplerShape>> simpler;  // by shape of the scene; may be shorter. For contacts:
                                                     // times of impact are of the shapes as they are
  bool solid_meshes = false;  // how `simpler` was made: closed convex meshes stand for solids
  /// By the kinds of the shapes as they are run, the lesser first.
  std::array<std::array<PairMethod, shape_kind_count>, shape_kind_count> method{};
  bool loose_boxes = false;  // broad-phase boxes worked out in double, a little larger (broad/body_box.h)
  bool remember = false;     // begin each pair's search where the last step's ended (PairMemory)
  SweepOptions sweep;

  static constexpr double shape_share = 0.3, placing_share = 0.0625, answer_share = 0.85;
  const PairMethod& of(ShapeKind a, ShapeKind b) const {
    const auto [lo, hi] = std::minmax(a, b);
    return method[static_cast<std::size_t>(lo)][static_cast<std::size_t>(hi)];
  }
  PairMethod& of(ShapeKind a, ShapeKind b) {
    return const_cast<PairMethod&>(static_cast<const Fidelity&>(*this).of(a, b));
  }
};

}  // namespace touchstone
