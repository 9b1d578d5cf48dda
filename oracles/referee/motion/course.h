// One convex part against another, or against a half-space, both in motion: what is certain at one time, and
// for how long afterwards there is certainly no contact.
#pragma once

#include <limits>

#include "oracles/referee/motion/mover.h"

namespace touchstone::referee {

/// Part A against part B, or against a half-space that is at rest in the frame except for turning about its
/// origin.
class Course {
 public:
  Course(const Mover& a, const Mover& b, const Vec3& origin);
  /// `origin` must be the half-space's translation when it turns.
  Course(const Mover& a, const Placed& half_space, const Vec3& angular, const Vec3& origin);

  /// Whether any rotation changes the sets.
  bool turns() const { return a_.spins() || (b_ && b_->spins()) || half_space_turns_; }
  ConvexTruth at(double t, Effort effort = Effort::verdict_only);
  /// A over [from, to] against B. Precondition: !turns().
  ConvexTruth swept(double from, double to, Effort effort = Effort::verdict_only);
  /// As ray_between. Precondition: !turns().
  std::optional<MovingRay> ray() const;
  /// Direction from A to B of what `at` or `swept` returned.
  Real3 a_to_b(const ConvexTruth& g) const { return half_space_ ? -g.normal : g.normal; }

  /// No contact at any time in [t, until), and the gap in that interval is at least `kept`. until > 1: to the
  /// end of the step.
  struct Clear {
    double until = 0;
    Real kept = 0;
  };
  /// Extends what is known at t; `g` must be at(t).
  Clear clear_from(double t, const ConvexTruth& g);
  /// Uses the closing speed along the direction alone, without turning: one Newton step from below.
  double clear_without_turning(double t, const ConvexTruth& g) const;

  /// Frees the storage kept from question to question.
  void forget() { now_.reset(); }

  int evaluations = 0;  // number of calls of at and swept

 private:
  /// Both parts at one time; kept, because one time is asked about several times in a row.
  struct Snapshot {
    double t = 0;
    Operand a, b;  // b: empty for a half-space
  };
  const Snapshot& parts_at(double t);
  ConvexTruth judge(const Operand& x, const Operand& y, Effort effort);
  ConvexTruth against_turned_plane(double t) const;
  Real closing_speed(const Real3& n, bool turning) const;
  std::vector<Real> least_along(const std::vector<Real3>& directions, double t);
  Clear by_speed(double t, const ConvexTruth& g);
  /// Starts from the result of by_speed. Returns a longer or equal interval, or an empty one when the gap is
  /// lost in rounding.
  Clear by_acceleration(double t, const ConvexTruth& g, const Clear& first);

  Mover a_;
  std::optional<Mover> b_;
  std::optional<Placed> half_space_;
  bool half_space_turns_ = false;
  Vec3 angular_ = Vec3::Zero();  // the half-space's angular velocity
  Vec3 origin_;
  Real spin_a_ = 0, spin_b_ = 0;          // core radii about the origins, rounded up
  Real acceleration_ = 0, approach_ = 0;  // bounds of |q'' - p''| and |q' - p'|, q in B, p in A
  double stride_ = 1;                     // first step that by_acceleration tries
  std::optional<Snapshot> now_;
};

}  // namespace touchstone::referee
