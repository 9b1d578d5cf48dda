// The referee's answers about one case, computed on demand and cached. A case is seen in frames: frame 0 is
// the scene as given, further frames are the scenes as engines received them (equal ones share a frame).
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "oracles/referee/referee.h"
#include "oracles/referee/region/contact_region.h"
#include "scenarios/value/observation.h"

namespace touchstone::fuzz {

// Which part of a scene an engine could represent. An engine in floats has infinity for 1e154 in doubles, and
// a faulty plug-in may report NaN: such a body is not a set, so there is no received scene to judge an answer
// against, and its faults are blamed on the representation.

/// Whether the numbers are finite, the sizes >= 0 and the normal not zero.
bool is_a_set(const Shape& shape);

/// The received scene without the shapes and bodies that are not plausible sets: those count as given.
ReceivedScene held_part(const Scene& asked, const ReceivedScene& received);

/// Whether the bodies of the query were held: its two, or all of the scene.
bool is_held(const Scene& asked, const ReceivedScene& received, const Query& query);

/// A shape of another kind, a hull of more or fewer vertices, other triangles: a difference beyond rounding.
bool is_other_shape(const Shape& asked, const Shape& held);
bool holds_other_shape(const Scene& asked, const ReceivedScene& received);

class Truth {
 public:
  explicit Truth(const Scene& asked);

  /// The frame of a received scene; 0 when it equals the given scene.
  int frame_of(const ReceivedScene& received);

  Placed placed(int frame, int body) const;
  const referee::PairTruth& pair(int frame, int a, int b);
  /// The same after b has moved by `way`; not cached.
  referee::PairTruth pair_after(int frame, int a, int b, const Vec3& way) const;
  /// Is the gap at most the scene's margin? overlap: yes; disjoint: no.
  referee::Verdict within(int frame, int a, int b);
  const referee::TimeTruth& motion(int frame, int a, int b);
  /// The region of an overlapping pair, along the referee's normal; cached.
  const referee::ContactRegion& contact_region(int frame, int a, int b);
  referee::Bracket width(int frame, int a, int b, const Vec3& n) const;
  /// The same at time t of b's linear motion, with b's position rounded.
  referee::Bracket width_at(int frame, int a, int b, double t, const Vec3& n) const;
  referee::Bracket distance_to(int frame, int body, const Vec3& p, double enough = 0) const;
  referee::Bracket gap_at(int frame, int a, int b, double t) const;
  /// For a convex body and a mesh that overlap: the certain depth in the deepest triangle, i.e. how far the
  /// body must move at least to leave that triangle; for two meshes, the depth of the deepest pair of
  /// triangles. 0 when neither is a mesh.
  double depth_in_mesh(int frame, int a, int b) const;
  /// The largest depth that is certain at any time up to t (for a mesh: in the deepest triangle); -infinity:
  /// too expensive to find.
  double depth_before(int frame, int a, int b, double t);
  /// The same over the whole step; cached.
  double depth_in_step(int frame, int a, int b);
  /// Upper bound of the distance between any point of the bodies in the frame and its position in the given
  /// scene.
  double displacement(int frame) const;
  /// Upper bound of the approach speed of a point of a and a point of b, in lengths per step.
  double speed(int a, int b) const;
  double scale(int a, int b) const { return scale_of_pair(asked_, a, b); }

  /// Per query step of the script: the bodies present, with their poses (frame 0 only).
  struct StepState {
    std::vector<std::optional<Pose>> pose;  // empty: not present
  };
  const std::vector<StepState>& steps();
  /// Per query step: pairs that truly overlap and that a broad phase must report (not filtered, not both
  /// static), sorted; with the referee's verdict on each.
  struct TruePair {
    BodyPair bodies;
    referee::PairTruth truth;
  };
  const std::vector<std::vector<TruePair>>& true_pairs();
  /// The same for pairs whose gap is at most the scene's margin, which is not negative.
  const std::vector<std::vector<TruePair>>& pairs_within();
  /// Pairs that overlap at the bodies' own poses in the given frame, as above.
  const std::vector<TruePair>& scene_pairs(int frame);
  std::uint64_t undecided_pairs() const { return undecided_pairs_; }
  std::uint64_t undecided_pairs_within() const { return undecided_pairs_within_; }
  /// Pairs that overlap at some time of the step, given the bodies' own poses and motions (frame 0 only), as
  /// above. Pairs for which this is neither certain nor excluded are left out and counted.
  const std::vector<BodyPair>& meeting_pairs();
  std::uint64_t undecided_meetings() const { return undecided_meetings_; }

  const Scene& scene() const { return asked_; }
  /// A direction worth trying first as a certificate, from an engine's answer.
  void hint(int a, int b, const Vec3& direction);

 private:
  struct Frame {
    ReceivedScene received;
    std::map<BodyPair, referee::PairTruth> pairs;
    std::map<BodyPair, referee::TimeTruth> motions;
    std::map<BodyPair, referee::ContactRegion> regions;
    std::map<BodyPair, double> depths;
    double displacement = 0;
    std::optional<std::vector<TruePair>> scene_pairs;
  };
  Placed placed_after(int frame, int body, const Vec3& way) const;
  std::vector<TruePair> overlapping(const std::vector<std::optional<Placed>>& bodies);
  std::vector<TruePair> near(const std::vector<std::optional<Placed>>& bodies);
  std::vector<std::optional<Placed>> present(const StepState& state) const;

  const Scene& asked_;
  std::vector<Frame> frames_;
  std::map<BodyPair, std::vector<Vec3>> hints_;
  std::optional<std::vector<StepState>> steps_;
  std::optional<std::vector<std::vector<TruePair>>> true_pairs_;
  std::optional<std::vector<std::vector<TruePair>>> pairs_within_;
  std::uint64_t undecided_pairs_ = 0, undecided_pairs_within_ = 0;
  std::optional<std::vector<BodyPair>> meeting_pairs_;
  std::uint64_t undecided_meetings_ = 0;
};

}  // namespace touchstone::fuzz
