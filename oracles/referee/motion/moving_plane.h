// Planes that keep two moving convex parts apart, as keys of an ImpactCertificate::Track.
#pragma once

#include "oracles/referee/exact/rational.h"
#include "oracles/referee/motion/mover.h"

namespace touchstone::referee {

/// A convex part or a half-space in motion, seen from the frame that travels with the origin of B.
class MovingPart {
 public:
  /// `minus`: linear velocity of B. A half-space must not turn.
  MovingPart(const Placed& p, const Motion& m, const Vec3& minus, const Vec3& origin,
             std::optional<std::size_t> triangle);
  bool is_half_space() const { return half_space_.has_value(); }
  bool turns() const { return turns_; }
  /// Bounds of |z'| and |z''| of its points.
  Real speed() const { return speed_; }
  Real bend() const { return bend_; }
  Operand at(double t) const { return mover_.at(t, origin_); }
  const Mover& mover() const { return mover_; }
  const Vec3& origin() const { return origin_; }
  /// Best known upper bound of n·x over the part at time t; infinite when there is none.
  Real top(const Real3& n, double t) const;
  /// Exact normal·x <= offset of the half-space at time t.
  const Rational3& normal() const { return half_space_->normal; }
  Rational offset(const Rational& t) const;

 private:
  struct Plane {
    Rational3 normal;
    Rational offset;  // at t = 0
    Rational rate;    // of the offset
  };
  Mover mover_;
  Vec3 origin_;
  std::optional<Plane> half_space_;
  bool turns_ = false;
  Real speed_ = 0, bend_ = 0;
};

struct PlaneKey {
  double t = 0;
  Rational3 direction;
  Rational offset;
  Real3 n;     // direction, rounded
  Real o = 0;  // offset, rounded
};

/// Keys from t = 0 on; the parts are apart, and checked to be, up to the last key.
using PlaneTrack = std::vector<PlaneKey>;
/// Gets as close to `until` as it can. Empty when not even the start can be shown.
PlaneTrack track_between(const MovingPart& a, const MovingPart& b, double until);
/// Whether the filter shows that the track keeps the two apart over all of its keys.
bool keeps_apart(const PlaneTrack& track, const MovingPart& a, const MovingPart& b);

}  // namespace touchstone::referee
