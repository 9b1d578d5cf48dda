// The exact level: both cores as integer points in one common unit, and the nearest points of their hulls by
// a finite GJK (Wolfe's 1976 nearest-point algorithm on the Minkowski difference) in which nothing is
// rounded.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "oracles/referee/exact/rational.h"
#include "oracles/referee/referee.h"

namespace touchstone::referee {

/// A placed polytope or rounded shape, perhaps moved along `velocity` (exact doubles): the core is the hull
/// of its points at all `times`. Point k of time i has index i·(number of points) + k.
struct ExactBody {
  std::vector<Vec3> core;  // body frame
  double radius = 0;
  std::variant<Pose, Placement> pose;
  /// velocity = velocity_to - velocity_from, stored separately because the difference may not be a double.
  Vec3 velocity_to = Vec3::Zero(), velocity_from = Vec3::Zero();
  std::vector<double> times{0};
};

/// An integer k stands for k·2^exponent/denominator.
template <class I>
struct BasicExactPair {
  std::vector<Triple<I>> a, b;
  I radius_a, radius_b;
  int exponent = 0;
  I denominator = 1;
};
using ExactPair = BasicExactPair<Integer>;
ExactPair make_exact(const ExactBody& a, const ExactBody& b);

using IndexPair = std::pair<int, int>;

struct ExactVerdict {
  bool overlap = false;
  /// Known to be exactly at gap 0; found only for rounded shapes at positive core distance.
  bool touching = false;
  std::vector<IndexPair> simplex;  // nearest face of the Minkowski difference: vertices a[i] - b[j]
  Integer3 direction;              // disjoint: B to A, d·(a - b) >= d·(simplex) > 0 for all a, b
  Real core_distance = 0;          // set by `nearest` only: distance of the cores, within 16 units
};
/// `seed`: a first guess of the simplex, at most four index pairs.
ExactVerdict decide(const ExactPair& p, std::span<const IndexPair> seed);
/// Like `decide`, but continues to the nearest points of the cores unless the cores meet.
ExactVerdict nearest(const ExactPair& p, std::span<const IndexPair> seed);
/// `decide` in 512-bit integers, without allocation; nullopt when the bodies' numbers need longer ones.
std::optional<ExactVerdict> decide_short(const ExactBody& a, const ExactBody& b,
                                         std::span<const IndexPair> seed);

/// A polytope or rounded shape against a half-space (placed by a Pose) in 512-bit integers; nullopt as above.
std::optional<bool> overlaps_half_space_short(const Vec3& normal, double offset, const Pose& half_space,
                                              const ExactBody& body);

/// v.direction (not zero) as a unit vector, within 8 units.
Real3 direction_of(const ExactVerdict& v);

/// A point in both bodies, world coordinates. Precondition: v.overlap.
Rational3 common_point(const ExactPair& p, const ExactVerdict& v);

struct ExactPlane {
  Rational3 direction;  // A to B
  Rational offset;
};
/// Strictly separating: A on direction·x <= offset, B on direction·x > offset. Precondition: !v.overlap.
ExactPlane separating_plane(const ExactPair& p, const ExactVerdict& v);

// Exact world coordinates in rationals, plain and slow: for half-spaces, certificates and other rare uses.

Rational3 world_point(const std::variant<Pose, Placement>& pose, const Rational3& local);
/// The core points at the first time only.
std::vector<Rational3> world_points(const ExactBody& b);

struct RationalPlane {
  Rational3 normal;  // {x : normal·x <= offset}, world; zero for a singular placement
  Rational offset;
};
RationalPlane world_plane(const Placed& half_space);
/// Signed distance of two half-spaces times the length of x.normal; nullopt: they are not antiparallel, so
/// nothing separates them.
std::optional<Rational> distance_of_half_spaces(const RationalPlane& x, const RationalPlane& y);

}  // namespace touchstone::referee
