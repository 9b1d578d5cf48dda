// The project's own core behind the engine interface. Created here its engines run in-process, for tests; the
// program runs them in a worker.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/narrow/narrow_phase.h"
#include "oracles/abi/native_engine.h"

namespace touchstone {

/// `core`, and `core-f32`, its narrow phase entirely in float.
class CoreEngine final : public NativeEngine {
 public:
  explicit CoreEngine(Arithmetic arithmetic = Arithmetic::float64);
  const EngineCard& card() const override { return card_; }
  ReceivedScene received(const Scene& scene) const override;
  void answer(const Case& c, const Tell& tell) override;

 private:
  Arithmetic arithmetic_;
  EngineCard card_;
};
EnginePtr make_core_engine();

/// `core-kept`: the core as used by a program that queries repeatedly, with acceleration structures and
/// caches. Pairs use hull graphs, mesh trees and the cached state of a previous step; motions and scenes use
/// StepWorld; candidate pairs use the broad phases of the catalog in turn; manifolds have at most four
/// points. Every answer depends only on the case: the previous step is synthetic, and nothing is kept between
/// cases.
std::unique_ptr<NativeEngine> make_kept_engine();

/// Alternative methods of the core, for comparison in charts: extended precision for every pair, and
/// speculative contact instead of a time of impact (core-extended, core-speculative@0.25 and so on).
std::span<const std::string_view> core_alternatives();
/// Precondition: a name of core_alternatives().
std::unique_ptr<NativeEngine> make_core_alternative(std::string_view name);

/// Which box represents a body. exact: the body itself, if it is an axis-aligned box (unrotated, or rotated
/// by thirds of a turn about the diagonal) or a half-space perpendicular to an axis; any other body makes the
/// answer `unsupported`. bodies: the core's own AABB of the body, over the whole step for swept_candidates,
/// which exact boxes do not answer.
enum class BroadBoxes { exact, bodies };
/// Names of core/broad/catalog.h.
std::span<const std::string_view> core_broad_phases();
/// One broad phase of the core as an engine that answers `candidates` and `swept_candidates`. Null if there
/// is no such broad phase. Boxes that the broad phase refuses (NaN, inverted) are left out, and the answer's
/// detail says so.
std::unique_ptr<NativeEngine> make_broad_engine(std::string_view name, BroadBoxes boxes);

/// Any of the engines above by name, for the library that a worker loads. Null if there is none of that name.
std::unique_ptr<NativeEngine> make_native_core(std::string_view name);
/// The name under which a worker offers a broad phase with these boxes.
std::string native_name(std::string_view broad_phase, BroadBoxes boxes);

}  // namespace touchstone
