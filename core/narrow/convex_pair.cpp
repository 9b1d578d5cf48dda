#include "core/narrow/convex_pair.h"

#include "core/narrow/extended/descend.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

// On smooth bodies GJK converges linearly; this leaves 60 digits of margin over the worst case seen
// (tests/core/stress).
constexpr int gjk_cap = 2000;
// Expansions before a ring of minima is suspected: isolated minima close within 50 to 250. Polytopes have no
// rings, but concentric ones with thousands of vertices need thousands of expansions.
constexpr int epa_budget = 400, epa_budget_of_polytopes = 16384;

using Core = ConvexCore<Wide>;

// Witness points move along their own difference, so that b − a stays parallel to it: the normal of the best
// support plane may deviate from it by the square root of the tolerance.
void inflate(Separation& s, const Core& a, const Core& b) {
  const WideVec v = s.b - s.a;
  const Wide length = v.norm();
  WideVec d = s.normal;
  if (length > tolerance::narrow_touching_factor * s.size) d = v * ((s.gap > 0 ? 1 : -1) / length);
  s.gap -= a.radius + b.radius;
  s.a += a.radius * d;
  s.b -= b.radius * d;
}

Separation from_gjk(const extended::Distance<Wide>& g, Wide size) {
  Separation s;
  s.size = size;
  s.gap = g.upper;
  s.a = g.a;
  s.b = g.b;
  s.normal = g.normal;
  s.slack = s.local_slack = std::max<Wide>(0, g.upper - g.lower);
  return s;
}

extended::EpaResult<Wide> expand(const extended::Distance<Wide>& g, const Core& a, const Core& b, Wide size) {
  const Wide tolerance = tolerance::narrow_gap_factor * size;
  const bool polytopes = is_polytope(a) && is_polytope(b);
  return extended::Epa<Wide>(a, b, size, tolerance).run(g, polytopes ? epa_budget_of_polytopes : epa_budget);
}

Separation from_epa(extended::EpaResult<Wide> e, const Core& a, const Core& b, Wide size) {
  const Wide tolerance = tolerance::narrow_gap_factor * size, proven = std::max<Wide>(0, e.lower);
  bool local = false;
  if (e.status == extended::EpaStatus::explored) {
    extended::descend<Wide>(e, a, b, size, tolerance);
    local = e.status == extended::EpaStatus::closed;
  } else if (e.status == extended::EpaStatus::broken) {
    extended::part_a_little<Wide>(e, a, b, size, tolerance);
  }
  Separation s;
  s.size = size;
  s.gap = -e.upper;
  s.normal = e.normal;
  s.a = e.a;
  s.b = e.b;
  s.slack = std::max<Wide>(0, e.upper - proven);
  s.local_slack = local ? tolerance : s.slack;
  return s;
}

// For a GJK run that stalled close to contact: EPA examines the same boundary from the other side. The signed
// planes of its polytope decide whether the origin is inside; if it is not, their direction and point tighten
// both bounds of the distance.
Separation second_opinion(const extended::Distance<Wide>& g, const Core& a, const Core& b, Wide size) {
  const extended::EpaResult<Wide> e = expand(g, a, b, size);
  if (e.status != extended::EpaStatus::broken && e.upper >= 0 &&
      e.lower >= -tolerance::narrow_gap_factor * size)
    return from_epa(e, a, b, size);
  Separation s = from_gjk(g, size);
  Wide lower = g.lower;
  if (-e.upper > lower) {
    lower = -e.upper;
    s.normal = e.normal;
  }
  if (const Wide d = (e.b - e.a).norm(); d < s.gap) {
    s.gap = d;
    s.a = e.a;
    s.b = e.b;
  }
  s.slack = s.local_slack = std::max<Wide>(0, s.gap - lower);
  return s;
}

// Where bodies only touch, the iteration has found the same point of both; a facet of a polytope that is flat
// there knows its points less well than its depth (a rim on a cone's side: 1.5e-13 apart, depth 4e-16).
void prefer_common_point(Separation& s, const extended::Distance<Wide>& g) {
  const Wide tolerance = tolerance::narrow_gap_factor * s.size;
  if (!(abs(s.gap) <= tolerance && g.upper <= tolerance && (s.b - s.a).norm() > tolerance)) return;
  s.a = g.a;
  s.b = g.b;
}

}  // namespace

Wide pair_size(const Core& a, const Core& b) {
  return a.reach + a.radius + b.reach + b.radius + (b.frame.translation - a.frame.translation).norm();
}

Separation separate_convex(const Core& a, const Core& b) {
  const Wide size = pair_size(a, b);
  Separation s;
  const extended::Distance<Wide> g = extended::gjk<Wide>(a, b, tolerance::narrow_gap_factor * size,
                                                         tolerance::narrow_touching_factor * size, gjk_cap);
  if (g.status == GjkStatus::enclosed || g.status == GjkStatus::touching) {
    s = from_epa(expand(g, a, b, size), a, b, size);
    if (g.status == GjkStatus::touching) prefer_common_point(s, g);
  } else {
    s = g.status == GjkStatus::separated ? from_gjk(g, size) : second_opinion(g, a, b, size);
  }
  inflate(s, a, b);
  if (!(s.local_slack <= tolerance::narrow_accept_factor * size)) s.outcome = Outcome::not_converged;
  return s;
}

Separation certified_or_general(const Core& a, const Core& b, const WideVec& point_a, const WideVec& point_b,
                                const WideVec& normal) {
  Separation s;
  s.size = pair_size(a, b);
  s.a = point_a;
  s.b = point_b;
  s.normal = normal;
  s.gap = (point_b - point_a).norm();
  const Wide lower = normal.dot(support<Wide>(b, -normal)) - normal.dot(support<Wide>(a, normal));
  s.slack = s.local_slack = std::max<Wide>(0, s.gap - lower);
  if (!(s.slack <= tolerance::narrow_gap_factor * s.size)) return separate_convex(a, b);
  inflate(s, a, b);
  return s;
}

Separation mirrored(Separation s) {
  s.normal = -s.normal;
  std::swap(s.a, s.b);
  return s;
}

}  // namespace touchstone::narrow
