#include "core/narrow/convex_pair.h"

#include "core/narrow/epa.h"
#include "core/narrow/gjk.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

// GJK on smooth bodies gains a constant factor an iteration; 60 digits of safety over the worst seen
// (tests/core/stress).
constexpr int gjk_cap = 2000;

using Core = ConvexCore<Wide>;

// Witnesses move along their own difference, so that b − a stays parallel to it: the normal of the best
// support plane may differ from it by the root of the tolerance.
void inflate(Separation& s, const Core& a, const Core& b) {
  const WideVec v = s.b - s.a;
  const Wide length = v.norm();
  WideVec d = s.normal;
  if (length > tolerance::narrow_touching_factor * s.size) d = v * ((s.gap > 0 ? 1 : -1) / length);
  s.gap -= a.radius + b.radius;
  s.a += a.radius * d, s.b -= b.radius * d;
}

Separation from_gjk(const GjkResult<Wide>& g, Wide size) {
  Separation s;
  s.size = size, s.gap = g.upper, s.a = g.a, s.b = g.b;
  s.normal = g.normal;
  s.slack = s.local_slack = std::max<Wide>(0, g.upper - g.lower);
  return s;
}

Separation from_epa(const EpaResult<Wide>& e, Wide size) {
  Separation s;
  s.size = size, s.gap = -e.upper, s.normal = e.normal, s.a = e.a, s.b = e.b;
  s.slack = s.local_slack = std::max<Wide>(0, e.upper - std::max<Wide>(0, e.lower));
  if (e.status == EpaStatus::local) s.local_slack = tolerance::narrow_gap_factor * size;
  return s;
}

// A walk that stalled close to contact: the expanding polytope looks for the support plane from the other
// side.
void better_plane(Separation& s, const GjkResult<Wide>& g, const Core& a, const Core& b) {
  Epa<Wide> epa(a, b, s.size, tolerance::narrow_gap_factor * s.size);
  const EpaResult<Wide> e = epa.run(g, EpaBudget{});
  if (-e.upper <= g.lower) return;
  s.normal = e.normal;
  s.slack = s.local_slack = std::max<Wide>(0, s.gap + e.upper);
}

}  // namespace

Wide pair_size(const Core& a, const Core& b) {
  return a.reach + a.radius + b.reach + b.radius + (b.frame.translation - a.frame.translation).norm();
}

Separation separate_convex(const Core& a, const Core& b) {
  const Wide size = pair_size(a, b);
  Separation s;
  const GjkResult<Wide> g =
      gjk<Wide>(a, b, tolerance::narrow_gap_factor * size, tolerance::narrow_touching_factor * size, gjk_cap);
  if (g.status == GjkStatus::enclosed || g.status == GjkStatus::touching) {
    Epa<Wide> epa(a, b, size, tolerance::narrow_gap_factor * size);
    s = from_epa(epa.run(g, EpaBudget{}), size);
  } else {
    s = from_gjk(g, size);
    if (g.status != GjkStatus::separated) better_plane(s, g, a, b);
  }
  inflate(s, a, b);
  if (!(s.local_slack <= tolerance::narrow_accept_factor * size)) s.outcome = Outcome::not_converged;
  return s;
}

Separation certified_or_general(const Core& a, const Core& b, const WideVec& point_a, const WideVec& point_b,
                                const WideVec& normal) {
  Separation s;
  s.size = pair_size(a, b), s.a = point_a, s.b = point_b, s.normal = normal;
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
