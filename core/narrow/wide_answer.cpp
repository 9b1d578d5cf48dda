#include "core/narrow/wide_answer.h"

#include "core/math/roundoff.h"
#include "core/narrow/convex_pair.h"
#include "core/narrow/manifold.h"
#include "core/narrow/mesh.h"
#include "core/narrow/outline.h"
#include "core/narrow/pair_table.h"
#include "core/narrow/solid.h"
#include "core/narrow/unit_scale.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

bool is_bounded_convex(const Shape& s) { return is_convex(kind_of(s)); }

// A gap this small counts as contact: it is within the error of the arithmetic that computed it.
bool touches(const Separation& s) { return s.gap <= tolerance::narrow_contact_factor * s.size; }

// The results are rounded to double once.
double arithmetic_error(const Separation& s) {
  return static_cast<double>(s.local_slack + tolerance::narrow_contact_factor * s.size) +
         double_roundoff * static_cast<double>(abs(s.gap) + s.size);
}

Vec3 world(const WideVec& p, const PlacedShape& a) {
  return (p + a.pose.translation.cast<Wide>()).cast<double>();
}

std::vector<ManifoldVertex> unit_manifold(const PlacedShape& a, const PlacedShape& b, const Separation& s) {
  const WideFrame fa = wide_frame(a.pose), fb = wide_frame(b.pose);
  const WideFrame la{fa.rotation, WideVec::Zero()}, lb{fb.rotation, fb.translation - fa.translation};
  if (is_bounded_convex(*a.shape) && is_bounded_convex(*b.shape)) {
    const auto cb = narrow::make_core(b, lb);
    return narrow::contact_points(narrow::make_core(a, la), &cb, s);
  }
  if (is_bounded_convex(*a.shape) && kind_of(*b.shape) == ShapeKind::half_space)
    return narrow::contact_points(narrow::make_core(a, la), nullptr, s);
  if (is_bounded_convex(*b.shape) && kind_of(*a.shape) == ShapeKind::half_space) {
    const Separation t = narrow::mirrored(s);
    auto points = narrow::contact_points(narrow::make_core(b, lb), nullptr, t);
    for (ManifoldVertex& v : points) v.id = outline::mirrored_id(v.id);
    return points;
  }
  return {{WideVec((s.a + s.b) / 2), 0}};
}

Separation rescaled(Separation s, int exponent) {
  for (Wide* x : {&s.gap, &s.slack, &s.local_slack, &s.size}) *x = ldexp(*x, exponent);
  s.a = scaled(s.a, exponent);
  s.b = scaled(s.b, exponent);
  return s;
}

}  // namespace

std::vector<ManifoldVertex> manifold_of(const PlacedShape& a, const PlacedShape& b, const Separation& s) {
  if (const int e = unit_scale(a, b); e != 0) {
    const ScaledPair<PlacedShape> pair(a, b, e);
    std::vector<ManifoldVertex> points = unit_manifold(pair.a, pair.b, rescaled(s, e));
    for (ManifoldVertex& v : points) v.p = scaled(v.p, -e);
    return points;
  }
  return unit_manifold(a, b, s);
}

OverlapAnswer overlap_of(const Separation& s) {
  return {s.outcome, s.outcome == Outcome::answered && touches(s), arithmetic_error(s)};
}

DistanceAnswer distance_of(const Separation& s, const PlacedShape& a) {
  DistanceAnswer r;
  r.outcome = s.outcome;
  r.error_bound = arithmetic_error(s);
  if (s.outcome != Outcome::answered) return r;
  r.distance = static_cast<double>(s.gap);
  r.normal = s.normal.cast<double>();
  r.witness = {world(s.a, a), world(s.b, a)};
  return r;
}

OverlapAnswer wide_overlap(const PlacedShape& a, const PlacedShape& b) {
  return overlap_of(separation(a, b));
}

DistanceAnswer wide_distance(const PlacedShape& a, const PlacedShape& b) {
  return distance_of(separation(a, b), a);
}

ContactAnswer wide_contact(const PlacedShape& a, const PlacedShape& b) {
  const Separation s = separation(a, b);
  ContactAnswer r;
  r.outcome = s.outcome;
  r.error_bound = arithmetic_error(s);
  r.overlap = s.outcome == Outcome::answered && touches(s);
  if (!r.overlap) return r;
  r.normal = s.normal.cast<double>();
  r.depth = static_cast<double>(std::max<Wide>(0, -s.gap));
  r.regret_bound = static_cast<double>(s.slack) + r.error_bound;
  for (const ManifoldVertex& v : manifold_of(a, b, s)) r.manifold.push_back({world(v.p, a), r.depth, v.id});
  return r;
}

ContactAnswer wide_contact_within(const PlacedShape& a, const PlacedShape& b, double margin) {
  const Separation s = separation(a, b);
  const DistanceAnswer d = distance_of(s, a);
  ContactAnswer r;
  r.outcome = d.outcome;
  r.error_bound = d.error_bound;
  r.regret_bound = static_cast<double>(s.slack) + d.error_bound;
  r.overlap = d.outcome == Outcome::answered && d.distance <= margin;
  if (!r.overlap) return r;
  r.normal = d.normal;
  r.depth = -d.distance;
  for (const ManifoldVertex& v : manifold_of(a, b, s)) r.manifold.push_back({world(v.p, a), r.depth, v.id});
  return r;
}

}  // namespace touchstone::narrow

namespace touchstone {

Separation separation(const PlacedShape& a, const PlacedShape& b) {
  if (narrow::has_solid(a, b)) return narrow::solid_separation(a, b);
  if (const int e = narrow::unit_scale(a, b); e != 0) {
    const narrow::ScaledPair<PlacedShape> pair(a, b, e);
    return narrow::rescaled(separation(pair.a, pair.b), -e);
  }
  return narrow::separate(a, wide_frame(a.pose), b, wide_frame(b.pose));
}

}  // namespace touchstone
