#include <cmath>

#include "core/impact/pair.h"
#include "core/narrow/pair_table.h"
#include "core/narrow/wide_answer.h"

namespace touchstone::impact {
namespace {

using narrow::filtered::Asked;
using narrow::filtered::Found;

narrow::filtered::Answer<double> in_double(const MovingShape& a, const MovingShape& b, Asked asked) {
  narrow::FastAnswer<double> f;
  narrow::separate_fast<double>(a, b, asked, f);
  return f.answer;
}

}  // namespace

std::optional<ImpactAnswer> contact_at_start(const MovingShape& a, const MovingShape& b,
                                             ImpactDetail detail) {
  ImpactAnswer r;
  r.toi = 0;
  const Found found = in_double(a, b, Asked::overlap).found;
  if (found == Found::apart) return std::nullopt;
  if (found == Found::meeting && detail == ImpactDetail::time) return r;
  const auto x = in_double(a, b, Asked::distance);
  if (x.valued && x.gap < -x.bound) {
    r.separation = x.gap;
    r.normal_ab = x.normal;
    r.witness_w = {Vec3(x.a + a.pose.translation), Vec3(x.b + a.pose.translation)};
    return r;
  }
  std::optional<Separation> wide;
  if (found != Found::meeting) {
    wide = separation(a, b);
    if (!narrow::overlap_of(*wide).overlap) return std::nullopt;
  }
  if (detail == ImpactDetail::time) return r;
  const bool is_decided = x.found == Found::apart || x.found == Found::meeting;
  const DistanceAnswer d =
      is_decided ? distance(a, b) : narrow::distance_of(wide ? *wide : separation(a, b), a);
  r.separation = d.distance;
  r.normal_ab = d.normal;
  r.witness_w = d.witness;
  if (d.outcome != Outcome::answered) {
    r.outcome = d.outcome;
    r.toi.reset();
  }
  return r;
}

}  // namespace touchstone::impact
