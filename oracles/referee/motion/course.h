// One convex part against another, or against a half-space, both in motion: what is certain at one time, and
// for how long after it there is certainly no contact.
#pragma once

#include <limits>

#include "oracles/referee/motion/mover.h"

namespace touchstone::referee {

/// Part A against part B, or against a half-space that rests in the frame but for turning about its origin.
class Course {
 public:
  Course(const Mover& a, const Mover& b, const Vec3& origin);
  /// `origin` must be the half-space's translation when it turns.
  Course(const Mover& a, const Placed& half_space, const Vec3& angular, const Vec3& origin);

  /// Whether a rotation shows.
  bool turns() const { return a_.spins() || (b_ && b_->spins()) || half_space_turns_; }
  ConvexTruth at(double t, Effort effort = Effort::verdict_only);
  /// A over [from, to] against B. Precondition: !turns().
  ConvexTruth swept(double from, double to, Effort effort = Effort::verdict_only);
  /// Direction from A to B of what `at` or `swept` returned.
  Real3 a_to_b(const ConvexTruth& g) const { return half_space_ ? -g.normal : g.normal; }

  /// No contact at any time in [t, until), and the gap there is at least `kept`. until above 1: to the end.
  struct Clear {
    double until = 0;
    Real kept = 0;
  };
  /// From what is known at t: `g` must be at(t).
  Clear clear_from(double t, const ConvexTruth& g);
  /// By the closing speed along the direction alone, no turning: the root of Newton's step from below.
  double clear_without_turning(double t, const ConvexTruth& g) const;

  int evaluations = 0;  // of at and swept

 private:
  Operand b_at(double t) const { return b_ ? b_->at(t, origin_) : Operand{}; }
  ConvexTruth judge(const Operand& x, const Operand& y, Effort effort);
  ConvexTruth against_turned_plane(double t) const;
  Real closing_speed(const Real3& n, bool turning) const;
  std::vector<Real> least_along(const std::vector<Real3>& directions, double t);
  Clear by_speed(double t, const ConvexTruth& g);
  /// From what by_speed found: more, as much, or (the gap is lost in rounding) none.
  Clear by_acceleration(double t, const ConvexTruth& g, const Clear& first);

  Mover a_;
  std::optional<Mover> b_;
  std::optional<Placed> half_space_;
  bool half_space_turns_ = false;
  Vec3 angular_ = Vec3::Zero();  // of the half-space
  Vec3 origin_;
  Real spin_a_ = 0, spin_b_ = 0;          // core radii about the origins, rounded up
  Real acceleration_ = 0, approach_ = 0;  // bounds of |q'' - p''| and |q' - p'|, q of B, p of A
  double stride_ = 1;                     // what by_acceleration tries first
};

}  // namespace touchstone::referee
