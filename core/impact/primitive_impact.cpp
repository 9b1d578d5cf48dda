// Finds the first t in [0,1] at which two primitives with straight vertex paths are within a distance.
//
// Method: inclusion-based root finding (Wang, Ferguson, Schneider, Jiang, Attene, Panozzo 2021, "A Large
// Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision Detection"): a part of the domain
// is discarded only if it provably contains no contact, and what cannot be discarded is contact. Departures:
// * The paper bisects (t, u, v). Here only time is subdivided, and u and v are eliminated by a separating
//   direction: a projection on a fixed direction is linear in time, so the direction towards the nearest
//   point at t proves everything up to the time at which it ceases to separate. Near a contact this is
//   Newton's method from one side, hence a handful of steps instead of thousands of boxes.
// * Distances are Euclidean.
// * With min_separation = 0, the remainder that doubles cannot discard is decided by a proof of crossing in
//   double (primitive_volume.h), otherwise in integers (primitive_exact.h).
// Guarantee: `toi` is never later than the first contact; with min_separation = 0 and tolerance = 0 there are
// no false verdicts. Outcomes: PrimitiveExit.
#include "core/impact/primitive_impact.h"

#include <cmath>

#include "core/impact/primitive_polygon.h"
#include "core/impact/primitive_separate.h"
#include "core/impact/primitive_volume.h"

namespace touchstone {
namespace impact {

MovingPolygon difference_polygon(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                                 const std::array<Vec3, 4>& end) {
  MovingPolygon p;
  const auto fill = [&](const std::array<Vec3, 4>& x, std::array<Vec3, 4>& w) {
    if (kind == PrimitiveKind::vertex_face)
      for (std::size_t k = 0; k < 3; ++k) w[k] = x[0] - x[k + 1];
    else
      w = {x[2] - x[0], x[2] - x[1], x[3] - x[1], x[3] - x[0]};
  };
  p.corners = kind == PrimitiveKind::vertex_face ? 3 : 4;
  fill(start, p.start);
  fill(end, p.end);
  for (std::size_t k = 0; k < p.corners; ++k)
    p.size = p.size.cwiseMax(p.start[k].cwiseAbs()).cwiseMax(p.end[k].cwiseAbs());
  return p;
}

}  // namespace impact

namespace {

using namespace impact;

// Rounding of a difference of coordinates and of the product with it, in u.
constexpr int coordinate_rounding = 4;
// A step to t (1 + this · u) is the rounding of t, not progress.
constexpr int time_rounding = 2;
// Resolution of a separation in doubles, in u and units of the polygon's size: four errors of a projection
// (primitive_separate.cpp).
constexpr int separation_rounding = 64;

// Along a coordinate axis, the sign of a difference is exact and its magnitude off by u.
bool apart_along_an_axis(const MovingPolygon& p, double min_separation) {
  const double need = min_separation * (1 + coordinate_rounding * double_roundoff);
  Vec3 lo = p.start[0].cwiseMin(p.end[0]), hi = p.start[0].cwiseMax(p.end[0]);
  for (std::size_t k = 1; k < p.corners; ++k) {
    lo = lo.cwiseMin(p.start[k]).cwiseMin(p.end[k]);
    hi = hi.cwiseMax(p.start[k]).cwiseMax(p.end[k]);
  }
  return lo.maxCoeff() > need || hi.minCoeff() < -need;
}

struct Advance {
  double t = 0;
  double separation = 0;
  int steps = 0;
  bool reached_end = false, within_tolerance = false, ended = false;  // ended: no direction makes progress
};

Advance advance(const MovingPolygon& p, const PrimitiveOptions& o, int most_steps) {
  Advance a;
  while (a.steps < most_steps) {
    const Directions tries = separating_directions(p, a.t);
    double until = a.t;
    for (std::size_t i = 0; i < tries.count; ++i) {
      ++a.steps;
      const Clearance c = clear_along(p, tries.n[i], a.t, o.min_separation);
      if (i == 0) a.separation = c.separation;
      if (!(c.until > until)) continue;
      until = c.until;
      a.separation = c.separation;
      break;
    }
    a.reached_end = until >= 1;
    a.within_tolerance = o.tolerance > 0 && a.separation <= o.min_separation + o.tolerance;
    if (a.reached_end || a.within_tolerance) return a;
    a.ended = until <= a.t * (1 + time_rounding * double_roundoff);
    if (a.ended) return a;
    a.t = until;
    // Where the polygon rotates, a fixed direction lasts only for distance / (angular speed · reach). The
    // plane of the polygon rotates with it: as long as the origin is proven off that plane, there is no
    // contact.
    if (o.min_separation > 0) continue;
    a.t = volume_clear_until(p, a.t);
    a.reached_end = a.t >= 1;
    if (a.reached_end) return a;
  }
  return a;
}

// Numbers of directions: a contact takes about five, a graze at the rounding of doubles thirty. Where the
// integers can decide, calling them is cheaper than making tiny steps.
constexpr int most_steps_before_integers = 64, most_steps = 1 << 16;

bool finite(const std::array<Vec3, 4>& x) {
  return x[0].allFinite() && x[1].allFinite() && x[2].allFinite() && x[3].allFinite();
}

}  // namespace

PrimitiveImpact primitive_impact(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                                 const std::array<Vec3, 4>& end, const PrimitiveOptions& options) {
  PrimitiveImpact r;
  if (!finite(start) || !finite(end) || !(options.min_separation >= 0 && options.tolerance >= 0)) {
    r.outcome = Outcome::invalid_input;
    return r;
  }
  const auto miss = [&](PrimitiveExit exit) {
    r.clear_until = 1;
    r.exit = exit;
    return r;
  };
  const auto hit = [&](PrimitiveExit exit) {
    r.toi = r.clear_until;
    r.exit = exit;
    return r;
  };
  const MovingPolygon p = difference_polygon(kind, start, end);
  if (apart_along_an_axis(p, options.min_separation)) return miss(PrimitiveExit::box);
  const bool can_be_exact = options.min_separation == 0 && options.tolerance == 0;
  const Advance a = advance(p, options, can_be_exact ? most_steps_before_integers : most_steps);
  r.steps = a.steps;
  r.separation = std::max(0.0, a.separation);
  r.clear_until = a.t;
  if (a.reached_end) return miss(PrimitiveExit::direction);
  if (a.within_tolerance) return hit(PrimitiveExit::tolerance);
  // No direction separates: contact to within the resolution of doubles, unless the nearest point itself was
  // lost.
  const double resolved = separation_rounding * double_roundoff * p.size.sum();
  if (!can_be_exact) {
    if (a.separation <= options.min_separation * (1 + separation_rounding * double_roundoff) + resolved)
      return hit(PrimitiveExit::tolerance);
    r.outcome = Outcome::not_converged;
    r.exit = PrimitiveExit::stuck;
    return r;
  }
  if (a.ended && crosses_near(p, a.t)) return hit(PrimitiveExit::crossing);
  const bool is_there = a.ended && a.separation <= resolved;
  const ExactImpact exact = decide_exactly(kind, start, end, a.t, !is_there);
  if (!exact.collides) return miss(PrimitiveExit::exact);
  r.clear_until = exact.t_below;
  return hit(PrimitiveExit::exact);
}

}  // namespace touchstone
