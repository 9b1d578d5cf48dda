// A convex part in motion, seen from the frame that travels with the other body: x(t) = x0 + (linear -
// minus)·t.
#pragma once

#include "oracles/referee/exact/ray.h"
#include "oracles/referee/filter/convex.h"

namespace touchstone::referee {

class Mover {
 public:
  /// The part is the whole shape, or one triangle of a mesh.
  Mover(const Placed& p, const Motion& m, const Vec3& minus_linear, std::optional<std::size_t> triangle);

  bool spins() const { return spins_; }
  Real3 velocity() const { return to_real(motion_.linear) - to_real(minus_); }
  Real3 angular() const { return spins_ ? to_real(motion_.angular) : Real3{}; }
  const Placed& placed() const { return placed_; }
  Rational3 exact_velocity() const { return exact(motion_.linear) - exact(minus_); }
  /// Where it is at t = 0, exactly, if it is a single point that does not spin.
  std::optional<Rational3> single_point() const;

  Operand at(double t, const Vec3& origin) const;
  /// The set swept over [from, to]; exact. Precondition: !spins().
  Operand swept(double from, double to, const Vec3& origin) const;
  /// A set that contains the part at time t whatever its rotation; the part itself when it does not spin.
  Operand orbit(double t, const Vec3& origin) const;

 private:
  Frame frame(double t, const Vec3& origin, bool turned) const;
  Solid body(const Frame& f) const;

  Placed placed_;
  Motion motion_;
  Vec3 minus_;
  std::optional<std::vector<Vec3>> core_;
  double radius_ = 0;
  bool spins_ = false;
};

/// The path of a single point past a curved body, where neither spins: seen from the body, whose translation
/// is at centre + t·drift.
struct MovingRay {
  Ray ray;
  Rational3 centre, drift;
  bool is_past_b = false;  // else past a

  Rational3 body_at(const Rational& t) const { return centre + t * drift; }
};
std::optional<MovingRay> ray_between(const Mover& a, const Mover& b);

}  // namespace touchstone::referee
