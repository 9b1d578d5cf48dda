// One step of a whole scene: discrete contacts at the end pose, and times of impact only for bodies that
// could pass through something undetected (sweep_criterion.h has the criterion, its proof, and how deep an
// unswept pass can be).
//
// For simulations: bodies stay in a broad phase from step to step. The start pose of a step is the end pose
// of the step before, or wherever the caller puts the body after an impact.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/broad/broad_phase.h"
#include "core/impact/impact.h"
#include "core/scene/scene.h"
#include "core/world/fidelity.h"
#include "core/world/planned.h"
#include "core/world/sweep_criterion.h"
#include "core/world/world.h"

namespace touchstone {

/// Why a body is swept. travel or turning: whichever is the larger part of its pass_bound.
enum class SweepReason { by_hand, travel, turning, all };

struct SweptBody {
  int body = 0;
  SweepReason reason = SweepReason::by_hand;
  double pass_bound = 0, inner = 0;  // the bound exceeds share · inner, unless flagged by hand
};

struct PairImpact {
  int a = 0, b = 0;  // a < b
  ImpactAnswer impact;
};

/// A pair within the plan's margin. Without a gap: of a plan for verdicts only.
struct PairNear {
  int a = 0, b = 0;  // a < b
  std::optional<double> gap;
};

struct StepReport {
  /// not_converged when some contact or impact did not converge; the others are still reported.
  Outcome outcome = Outcome::answered;
  std::vector<PairContact> contacts;  // at the end poses, sorted
  std::vector<PairNear> near;       // pairs within the margin that are apart, sorted; with verdicts only, all
  std::vector<PairImpact> impacts;  // pairs with a swept body that meet within the step; by time, a, b
  std::vector<SweptBody> swept;     // by body
  long candidates = 0;              // pairs whose end boxes meet
  long swept_candidates = 0;        // pairs with a swept body whose swept boxes meet
  long asked = 0;                   // those whose time of impact was computed
  long spared = 0;                  // those whose own pass bound is small enough
  long unsupported = 0;             // omitted: contacts or impacts that the narrow phase does not support
};

class StepWorld {
 public:
  /// Start poses and motions are those of the scene. Throws std::invalid_argument on an unknown broad phase.
  explicit StepWorld(Scene scene, std::string_view broad_phase = "automatic");
  /// Runs a plan: contacts are within fidelity.error of the truth (fidelity.h). Throws std::invalid_argument
  /// on an unknown broad phase.
  StepWorld(Scene scene, Fidelity fidelity);

  /// Call before the next step. A body without motion is at rest.
  void set(int body, const Pose& start, const Motion& motion);
  /// Flags a body by hand: it is swept against everything, regardless of the criterion.
  void flag(int body, bool flagged);

  /// Throws broad::Refused when an end pose is not finite.
  StepReport step(const SweepOptions& options);
  StepReport step() { return step(fidelity_.sweep); }

  const Pose& end_pose(int body) const { return end_[static_cast<std::size_t>(body)]; }
  /// The end poses become the start poses.
  void accept();
  const Scene& scene() const { return scene_; }

 private:
  const PlannedShape& planned_shape(int body) const;
  void place_at_end();
  ContactAnswer contact_of(int a, int b, PairMemory* memory) const;
  PlannedNear near_of(int a, int b, PairMemory* memory) const;
  void find_contacts(StepReport& r);
  void choose(const SweepOptions& o, StepReport& r) const;
  void find_impacts(const SweepOptions& o, StepReport& r);
  std::vector<BodyPair> swept_pairs(const StepReport& r);
  void find_impact(const BodyPair& pair, const SweepOptions& o, StepReport& r) const;
  Motion motion_of(int body) const;

  Scene scene_;
  Fidelity fidelity_;
  broad::BroadPhasePtr phase_;
  std::vector<InnerExtent> extent_;  // of each body's shape
  std::vector<double> box_size_;     // of each body's own shape
  std::vector<PlannedShape> shapes_;
  std::vector<Pose> end_;
  std::vector<Aabb> end_box_;  // of the shapes used
  std::vector<PlannedBody> bodies_;
  std::vector<std::pair<broad::IdPair, PairMemory>> memory_;  // by pair of the last step, sorted
  std::vector<char> by_hand_, moved_;
  std::vector<broad::BoxUpdate> updates_;
  std::vector<broad::IdPair> pairs_;
};

}  // namespace touchstone
