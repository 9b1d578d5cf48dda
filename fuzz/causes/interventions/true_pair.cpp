#include "fuzz/causes/interventions/true_pair.h"

#include <algorithm>
#include <cmath>

#include "fuzz/judge/truth.h"

namespace touchstone::fuzz {
namespace {

// The scene with every body where the script leaves it; nothing if one is then absent.
std::optional<Scene> at_end_of_script(const Scene& s) {
  Scene r = s;
  r.script.clear();
  if (s.script.empty()) return r;
  Truth truth(s);
  if (truth.steps().empty()) return std::nullopt;
  const auto& last = truth.steps().back().pose;
  for (std::size_t i = 0; i < r.bodies.size(); ++i) {
    if (i >= last.size() || !last[i]) return std::nullopt;
    r.bodies[i].pose = *last[i];
  }
  return r;
}

double size_of_smaller(const Scene& s, const BodyPair& p) {
  const double a = bounding_radius(s.shape_of(p.first)), b = bounding_radius(s.shape_of(p.second));
  return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b);
}

}  // namespace

std::optional<BodyPair> pair_of(const Case& c) {
  if (c.queries.empty()) return std::nullopt;
  const Query& q = c.queries[0];
  if (is_pair_question(q.question)) return BodyPair{q.a, q.b};
  if (c.scene.bodies.size() != 2) return std::nullopt;
  return BodyPair{0, 1};
}

std::optional<TruePair> true_pair(const Case& c) {
  const auto bodies = pair_of(c);
  if (!bodies) return std::nullopt;
  const auto placed = at_end_of_script(c.scene);
  if (!placed) return std::nullopt;
  Truth truth(*placed);
  const referee::PairTruth& pair = truth.pair(0, bodies->first, bodies->second);
  if (pair.verdict == referee::Verdict::undecided || !std::isfinite(pair.gap.lo) ||
      !std::isfinite(pair.gap.hi) || !(pair.normal.norm() > 0))
    return std::nullopt;
  const double size = size_of_smaller(*placed, *bodies);
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  return TruePair{bodies->first, bodies->second, (pair.gap.lo + pair.gap.hi) / 2, pair.normal, size};
}

Case moved_along(const Case& c, const TruePair& p, double by) {
  Case r = c;
  const Vec3 move = p.normal * by;
  r.scene.bodies[static_cast<std::size_t>(p.b)].pose.translation += move;
  for (Step& s : r.scene.script)
    if (s.pose && s.body == p.b) s.pose->translation += move;
  return r;
}

std::optional<Case> with_gap(const Case& c, double gap) {
  const auto p = true_pair(c);
  if (!p) return std::nullopt;
  return moved_along(c, *p, gap - p->gap);
}

}  // namespace touchstone::fuzz
