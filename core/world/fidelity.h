// The simplest model that a scene needs: `touchstone plan` finds it, StepWorld runs it.
//
// Contract. With `error` E > 0, every answered pair is decided within E: a pair reported in contact has a gap
// of at most E, an omitted pair is no deeper than E; the depth along the reported normal is correct to E and
// exceeds the least depth by no more than E. (Unsupported and not_converged are reported as usual; when the
// core itself cannot prove that a depth is the least, it reports a regret_bound larger than E.) With `margin`
// M, pairs that are apart are reported too: one reported has a gap of at most M + E, and a gap stated is
// correct to E; one omitted has a gap of more than M − E. E must be at least 2^-44 of the scene's largest
// coordinate. At most 0.6 of E goes to simpler shapes, 0.125 to placing them, and the rest to arithmetic: a
// cheap answer is recomputed when its proven bound, plus the rounding of its input, exceeds that share.
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
  /// none: discrete only. all: sweep every moving body, for comparison.
  Which which = Which::by_criterion;
  double share = 0.5;  // of the inner extents; see sweep_criterion.h
};

/// How contacts of two kinds of shapes are found.
struct PairMethod {
  /// Skip pairs whose bounding balls are apart.
  bool balls_first = false;
  /// float32 and float64_alone are tried first; float64, backed by extended precision, when they do not prove
  /// enough.
  Arithmetic arithmetic = Arithmetic::float64;
  bool operator==(const PairMethod&) const = default;
};

struct Fidelity {
  double error = 0;                                  // E, in the scene's unit; 0: no accuracy is traded
  std::string broad_phase = "automatic";             // broad/catalog.h
  std::vector<std::optional<SimplerShape>> simpler;  // by shape of the scene; may be shorter. For contacts
                                                     // only: times of impact use the original shapes
  bool solid_meshes = false;  // `simpler` treats closed convex meshes as solids
  /// By the kinds of the shapes actually used, the smaller kind first.
  std::array<std::array<PairMethod, shape_kind_count>, shape_kind_count> method{};
  bool loose_boxes = false;   // broad-phase boxes are computed in double, slightly larger (broad/body_box.h)
  double margin = 0;          // M, finite and not negative, in the scene's unit
  bool verdict_only = false;  // only which pairs are within the margin: no depths, normals, points and gaps
  bool remember = false;      // start each pair's search where that of the last step ended (PairMemory)
  SweepOptions sweep;

  /// Shares of E: the error of one simpler shape; the proven error of a pair's answer with its shapes.
  static constexpr double shape_share = 0.3, answer_share = 0.85;
  const PairMethod& of(ShapeKind a, ShapeKind b) const {
    const auto [lo, hi] = std::minmax(a, b);
    return method[static_cast<std::size_t>(lo)][static_cast<std::size_t>(hi)];
  }
  PairMethod& of(ShapeKind a, ShapeKind b) {
    return const_cast<PairMethod&>(static_cast<const Fidelity&>(*this).of(a, b));
  }
};

}  // namespace touchstone
