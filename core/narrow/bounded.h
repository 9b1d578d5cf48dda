// Questions about a limit: is the distance at most this, the distance if it is, the contact if it is. Pairs
// that are clearly farther apart are answered from a bound: the gap along the line between the bodies'
// origins.
#pragma once

#include <optional>

#include "core/narrow/narrow_phase.h"

namespace touchstone {

struct BoundedDistanceAnswer {
  Outcome outcome = Outcome::answered;
  /// Set, with `answered`, unless the distance is more than what was asked about.
  std::optional<DistanceAnswer> distance;
  /// Proven: the signed distance is at least this; more than what was asked about if there is no `distance`.
  double lower_bound = 0;
};
/// The signed distance, or a bound that shows it to be more than `at_most` (finite, any sign).
BoundedDistanceAnswer distance(const PlacedShape& a, const PlacedShape& b, double at_most,
                               Arithmetic arithmetic = Arithmetic::float64, PairMemory* memory = nullptr);

struct WithinAnswer {
  Outcome outcome = Outcome::answered;
  bool within = false;
  double error_bound = 0;  // of the distance that decided; 0 if a bound did
};
/// Is the signed distance at most `margin` (finite, any sign)? The boundary belongs to it. A margin of 0 asks
/// whether the closed bodies overlap.
WithinAnswer within(const PlacedShape& a, const PlacedShape& b, double margin,
                    Arithmetic arithmetic = Arithmetic::float64, PairMemory* memory = nullptr);

/// The contact of bodies that are not farther apart than `margin` (finite, any sign): `overlap` says whether
/// they are within it, and `depth`, of the contact and of its points, is negative where they are apart. The
/// points cover what is no farther apart along the normal than the margin; of bodies in `mesh` or
/// `solid_mesh` they are those of contact(), or one between the nearest points. A margin of 0 is contact().
ContactAnswer contact_within(const PlacedShape& a, const PlacedShape& b, double margin,
                             Arithmetic arithmetic = Arithmetic::float64, PairMemory* memory = nullptr);

/// A lower bound of the signed distance, -infinity if the shapes have none along the line between their
/// origins. Much cheaper than a distance.
double distance_lower_bound(const PlacedShape& a, const PlacedShape& b);

}  // namespace touchstone
