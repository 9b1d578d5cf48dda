// Overlaps made shallower or deeper, resolved or produced along the referee's normal: which stage of the
// engine is concerned, and up to which depth.
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/interventions/true_pair.h"

namespace touchstone::fuzz {
namespace {

// An impact depends on the motion more than on where it begins.
std::optional<TruePair> pair_at_rest(const Case& c) {
  if (!c.queries.empty() && is_motion_question(c.queries[0].question)) return std::nullopt;
  return true_pair(c);
}

// The gap set to a share of the smaller body.
std::optional<Case> with_share(const Case& c, double share) {
  const auto p = pair_at_rest(c);
  if (!p) return std::nullopt;
  return moved_along(c, *p, share * p->size - p->gap);
}

// Shares of the smaller body: plainly apart or overlapping, then from visible to below the tolerances that
// engines compare with.
constexpr double clear_share = 1.0 / 16;
constexpr double a_256th = 0x1p-8, a_millionth = 0x1p-20, a_billionth = 0x1p-30, a_trillionth = 0x1p-40;

}  // namespace

std::optional<Case> halve_depth(const Case& c) {
  const auto p = pair_at_rest(c);
  if (!p || p->gap >= 0) return std::nullopt;
  return moved_along(c, *p, -p->gap / 2);
}

std::optional<Case> pull_apart(const Case& c) {
  const auto p = pair_at_rest(c);
  if (!p || p->gap >= clear_share * p->size) return std::nullopt;
  return moved_along(c, *p, clear_share * p->size - p->gap);
}

std::optional<Case> push_together(const Case& c) {
  const auto p = pair_at_rest(c);
  if (!p || p->gap <= -clear_share * p->size) return std::nullopt;
  return moved_along(c, *p, -clear_share * p->size - p->gap);
}

std::optional<Case> overlap_by_half(const Case& c) { return with_share(c, -0.5); }
std::optional<Case> overlap_by_quarter(const Case& c) { return with_share(c, -0.25); }
std::optional<Case> overlap_by_256th(const Case& c) { return with_share(c, -a_256th); }
std::optional<Case> overlap_by_millionth(const Case& c) { return with_share(c, -a_millionth); }
std::optional<Case> overlap_by_billionth(const Case& c) { return with_share(c, -a_billionth); }
std::optional<Case> overlap_by_trillionth(const Case& c) { return with_share(c, -a_trillionth); }
std::optional<Case> apart_by_trillionth(const Case& c) { return with_share(c, a_trillionth); }
std::optional<Case> apart_by_millionth(const Case& c) { return with_share(c, a_millionth); }
std::optional<Case> apart_by_256th(const Case& c) { return with_share(c, a_256th); }
std::optional<Case> apart_by_half(const Case& c) { return with_share(c, 0.5); }
std::optional<Case> apart_by_four(const Case& c) { return with_share(c, 4); }

}  // namespace touchstone::fuzz
