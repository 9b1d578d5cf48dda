// Overlaps made shallower, resolved or produced along the referee's normal: which stage of the engine is
// concerned.
#include <algorithm>
#include <cmath>

#include "fuzz/causes/intervention.h"
#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

struct TruePlacement {
  double gap = 0;  // signed
  Vec3 normal = Vec3::Zero();
  double size = 0;  // of the smaller body
};

std::optional<TruePlacement> true_placement(const Case& c) {
  if (c.queries.empty() || c.queries[0].question >= Question::time_of_impact) return std::nullopt;
  const Query& q = c.queries[0];
  Truth truth(c.scene);
  const referee::PairTruth& pair = truth.pair(0, q.a, q.b);
  if (pair.verdict == referee::Verdict::undecided || !std::isfinite(pair.gap.lo) ||
      !std::isfinite(pair.gap.hi) || !(pair.normal.norm() > 0))
    return std::nullopt;
  const double size =
      std::min(bounding_radius(c.scene.shape_of(q.a)), bounding_radius(c.scene.shape_of(q.b)));
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  return TruePlacement{(pair.gap.lo + pair.gap.hi) / 2, pair.normal, size};
}

std::optional<Case> moved_along(const Case& c, const TruePlacement& p, double by) {
  Case r = c;
  r.scene.bodies[static_cast<std::size_t>(c.queries[0].b)].pose.translation += p.normal * by;
  return r;
}

constexpr double clear_share = 1.0 / 16;  // of the smaller body: plainly apart, plainly overlapping

}  // namespace

std::optional<Case> halve_depth(const Case& c) {
  const auto p = true_placement(c);
  if (!p || p->gap >= 0) return std::nullopt;
  return moved_along(c, *p, -p->gap / 2);
}

std::optional<Case> pull_apart(const Case& c) {
  const auto p = true_placement(c);
  if (!p || p->gap >= clear_share * p->size) return std::nullopt;
  return moved_along(c, *p, clear_share * p->size - p->gap);
}

std::optional<Case> push_together(const Case& c) {
  const auto p = true_placement(c);
  if (!p || p->gap <= -clear_share * p->size) return std::nullopt;
  return moved_along(c, *p, -clear_share * p->size - p->gap);
}

}  // namespace touchstone::fuzz
