// The exact level for rays: a point on a straight path past a cylinder, cone or ellipsoid. In the body's own
// coordinates the path is linear in t with rational coefficients, and the body is where a few polynomials of
// degree 1 or 2 are not negative. So where the path is in the body is decided by the signs of polynomials at
// roots of polynomials, and nothing is left undecided.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "oracles/referee/exact/exact_pair.h"
#include "oracles/referee/exact/rational.h"

namespace touchstone::referee {

/// c[0] + c[1]·t + c[2]·t².
struct Quadratic {
  std::array<Rational, 3> c;
};

/// mean + factor·√square, square >= 0: a root of a polynomial of degree 1 (factor 0) or 2.
struct QuadraticRoot {
  Rational mean, factor, square;
};
/// The real roots; none of a constant. A double root comes twice.
std::vector<QuadraticRoot> roots_of(const Quadratic& p);
int sign_at(const Quadratic& p, const QuadraticRoot& t);
/// Neighbouring doubles, or a single one, that enclose a root in [0,1].
void enclose(const QuadraticRoot& t, double& lo, double& hi);

class Ray {
 public:
  /// The point start + t·velocity, t in [0,1], relative to the body's translation in world axes. nullopt: the
  /// body is of another shape, or its placement is singular.
  static std::optional<Ray> past(const Placed& body, const Rational3& start, const Rational3& velocity);

  struct Meeting {
    double lo = 0, hi = 0;            // neighbouring doubles, or 0 and 0, that enclose the first common t
    std::optional<Rational> contact;  // a t in [lo, 1] at which the point is in the body; the first if
                                      // rational; none for a flat ellipsoid
  };
  /// nullopt: the point is never in the body.
  std::optional<Meeting> first_meeting() const;

  Rational3 point_at(const Rational& t) const { return start_ + t * velocity_; }

  /// Relative to the body's translation: the body on direction·x <= offset, the point on direction·x > offset
  /// at all times up to `until`. nullopt: they meet, are apart by less than 2^-200 of their size, or the body
  /// is flat.
  std::optional<ExactPlane> plane_until(const Rational& until) const;

 private:
  Ray() = default;
  /// Polynomials in t, none negative exactly where the point is in the body and t in [0,1].
  std::vector<Quadratic> limits() const;
  bool is_flat_ellipsoid() const;
  bool is_inside(const QuadraticRoot& t) const;
  Rational3 local_at(const Rational& t) const { return local_start_ + t * local_velocity_; }
  Rational support_above(const Rational3& local) const;
  std::vector<Rational3> proposals(const Rational& until) const;

  enum class Kind { cylinder, cone, ellipsoid } kind_ = Kind::cylinder;
  Rational3 size_;  // (radius, half height, -), or the semi-axes
  Rational3 start_, velocity_, local_start_, local_velocity_;
  Rational3 to_local_[3];  // rows
  std::vector<Quadratic> limits_;
};

}  // namespace touchstone::referee
