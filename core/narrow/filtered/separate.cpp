#if defined(__GNUC__) && !defined(__clang__)
// A feature with fewer than three corners is copied as a whole; GCC 12 warns about that at -O1.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include "core/narrow/filtered/separate.h"

#include "core/narrow/filtered/box_box.h"
#include "core/narrow/filtered/box_capsule.h"
#include "core/narrow/filtered/epa.h"
#include "core/narrow/filtered/recall.h"
#include "core/narrow/filtered/revolved.h"

namespace touchstone::narrow::filtered {
namespace {

template <class R>
R displacement(const PairScene<R>& s) {
  return displacement_of<R>(s.a.reach + s.a.radius, s.b.reach + s.b.radius, s.at.offset.norm());
}

// L of truth.md for the pair as represented in R.
template <class R>
R scale(const ConvexBody<R>& a, const ConvexBody<R>& b, const RoundedPose<R>& at_a,
        const RoundedPose<R>& at_b) {
  return std::max(std::max(a.extent, b.extent),
                  std::max(at_a.t.cwiseAbs().maxCoeff(), at_b.t.cwiseAbs().maxCoeff()));
}

// A lower bound of its part that does not depend on where the pair is: the target accuracy of a search is
// relative to it.
template <class R>
R local_scale(const PairScene<R>& s) {
  return std::max(std::max(s.a.extent, s.b.extent), s.at.offset.norm() * offset_share<R>);
}

// From A's frame to world axes about A's translation; `unsure` if the value is not accurate enough.
template <class R>
void to_world(Answer<R>& r, const PairScene<R>& s, R l, Asked asked) {
  const M3<R>& m = s.at.a_to_world;
  r.normal = m * r.normal;
  r.a = m * r.a;
  r.b = m * r.b;
  r.found = decide(r.gap, r.bound);
  const bool verdict_is_enough = asked == Asked::contact && r.found == Found::apart;
  if (verdict_is_enough) return;
  const R tau = accuracy(l);
  if (!accepted(r.bound, l)) r.found = Found::unsure;
  if ((asked == Asked::distance || s.has_middle) &&
      !(std::abs((r.b - r.a).norm() - std::abs(r.gap)) <= tau / 4))
    r.found = Found::unsure;
}

template <class R>
void from_gjk(const GjkResult<R>& g, R error, Answer<R>& r, PairScene<R>& s) {
  r.a.setZero();
  V3<R> v = V3<R>::Zero();
  for (int i = 0; i < g.simplex.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    r.a += g.simplex.weight[k] * g.simplex.p[k].a;
    v += g.simplex.weight[k] * g.simplex.p[k].w;
  }
  const R radii = s.a.radius + s.b.radius;
  r.normal = s.normal = g.normal;
  r.gap = g.upper - radii;
  r.b = r.a + v;
  // Inflates along their own difference, so that b − a stays parallel to it.
  const R length = v.norm();
  const V3<R> d = length > 0 ? V3<R>(v / length) : g.normal;
  r.a += s.a.radius * d;
  r.b -= s.b.radius * d;
  r.bound = error + std::max<R>(0, g.upper - g.lower);
  s.middle = (r.a + r.b) / 2;
  s.has_middle = true;
}

// The depth in `e` (Depth, Revolved, RecalledDepth).
template <class R, class D>
void from_depth(const D& e, R error, Answer<R>& r, PairScene<R>& s) {
  s.normal = r.normal = -e.outward;
  r.gap = -e.upper - s.a.radius - s.b.radius;
  r.a = e.a + s.a.radius * r.normal;
  r.b = e.a + e.w - s.b.radius * r.normal;
  r.bound = error + std::max<R>(0, e.upper - e.lower);
  s.middle = (r.a + r.b) / 2;
  s.has_middle = true;
}

// B − A has no interior within rounding. Every direction tried bounds the depth, and the iteration's own
// point, which is as near to the origin as rounding can resolve, shows that the depth is not negative beyond
// that.
template <class R>
void from_flat(const GjkResult<R>& g, const Depth<R>& e, R size, R error, Answer<R>& r, PairScene<R>& s) {
  if (g.status != GjkStatus::touching || !(e.upper < size)) {
    r.bound = std::numeric_limits<R>::infinity();
    return;
  }
  s.normal = r.normal = -e.outward;
  r.gap = -e.upper - s.a.radius - s.b.radius;
  V3<R> a = V3<R>::Zero();
  for (int i = 0; i < g.simplex.size; ++i)
    a += g.simplex.weight[static_cast<std::size_t>(i)] * g.simplex.p[static_cast<std::size_t>(i)].a;
  r.a = a + (e.upper / 2 + s.a.radius) * r.normal;
  r.b = a - (e.upper / 2 + s.b.radius) * r.normal;
  r.bound = error + e.upper + rounding::feature_height * u<R> * size;
  s.middle = (r.a + r.b) / 2;
  s.has_middle = true;
}

// Whether the remembered features have the least depth still; then that is the answer, in A's frame.
template <class R>
bool is_recalled(const Difference<R>& d, R size, R tolerance, R error, Answer<R>& r, PairScene<R>& s) {
  if (!s.features || s.features->corner[0][0] < 0) return false;
  const RecalledDepth<R> e(d, *s.features, s.guess, size, tolerance);
  if (!e.proven) return false;
  r.valued = true;
  from_depth(e, error, r, s);
  s.guess = s.normal;
  return true;
}

// Searches square areas: fourth powers of lengths. Bodies for which these would leave the range of R are
// scaled by a power of two, which is exact. Sizes that need no scaling: at L = 2^-22 the fourth power in
// float still represents slivers of L·2^-18.
template <class R>
constexpr R least_size = R(sizeof(R) == sizeof(float) ? 0x1p-22 : 0x1p-230);
template <class R>
constexpr R largest_size = R(sizeof(R) == sizeof(float) ? 0x1p+30 : 0x1p+250);

template <class R>
bool in_range(R size) {
  return size > least_size<R> && size < largest_size<R>;
}

template <class R>
void separate_scaled(const RoundedPose<R>& a, const RoundedPose<R>& b, Asked asked, R enough, R size,
                     Answer<R>& r, PairScene<R>& s) {
  const R unit = std::ldexp(R(1), -std::ilogb(size)), back = 1 / unit;
  PairScene<R> t = s;
  RoundedPose<R> at_a = a, at_b = b;
  t.a.scale(unit);
  t.b.scale(unit);
  t.at.offset *= unit;
  at_a.t *= unit;
  at_b.t *= unit;
  // Scaling does not help: relative to where they stand, they are so small or large that no scale in R fits
  // both.
  const R fits = at_a.t.cwiseAbs().sum() + at_b.t.cwiseAbs().sum() + unit + back;
  if (!(fits < std::numeric_limits<R>::max())) return;
  separate_cores(at_a, at_b, asked, enough * unit, r, t);
  r.gap *= back;
  r.bound *= back;
  r.a *= back;
  r.b *= back;
  s.normal = t.normal;
  s.middle = t.middle * back;
  s.has_middle = t.has_middle;
  s.guess = t.guess;
}

}  // namespace

template <class R>
void separate_cores(const RoundedPose<R>& a, const RoundedPose<R>& b, Asked asked, R enough, Answer<R>& r,
                    PairScene<R>& s) {
  const Difference<R> d{s.a, s.b, s.at};
  const R error = displacement(s), radii = s.a.radius + s.b.radius;
  const R size = s.a.reach + s.b.reach + s.at.offset.norm();
  if (!in_range(size))
    if (const R exact = s.a.reach + s.b.reach + s.at.offset.stableNorm(); exact > 0)
      return separate_scaled(a, b, asked, enough, exact, r, s);
  const R tolerance = accuracy(local_scale(s)) / 8;
  if (asked != Asked::overlap && is_recalled(d, size, tolerance, error, r, s))
    return to_world(r, s, scale(s.a, s.b, a, b), asked);
  const R certain = error + radii + (asked == Asked::distance ? std::max<R>(0, enough) : R(0));
  const GjkResult<R> g = gjk<R>(d, tolerance, certain, size, s.guess);
  s.guess = g.normal;
  r.bound = error;
  if (g.lower > certain) {
    r.found = Found::apart;
    return;
  }
  // A tetrahedron without room for the origin proves nothing, whatever the radii: it may be a sliver of
  // rounding noise.
  const bool inside =
      g.status == GjkStatus::enclosed && (g.margin > error || (g.margin > 0 && radii > error));
  if (asked == Asked::overlap && (g.upper < radii - error || inside)) {
    r.found = Found::meeting;
    return;
  }
  r.valued = true;
  if (g.status == GjkStatus::enclosed || g.status == GjkStatus::touching) {
    if (const Revolved<R> e(d, size); e.found) {
      from_depth(e, error, r, s);
    } else {
      Expander<R> polytope(d, size, tolerance);
      const Depth<R> depth = polytope.run(g.simplex, g.status == GjkStatus::enclosed);
      if (depth.end == ExpandEnd::flat)
        from_flat(g, depth, size, error, r, s);
      else
        from_depth(depth, error, r, s);
      if (s.features && depth.on_facet) *s.features = touching_features(d, depth);
    }
    s.guess = s.normal;
  } else {
    from_gjk(g, error, r, s);
  }
  to_world(r, s, scale(s.a, s.b, a, b), asked);
}

template <class R>
void convex_pair(const PlacedShape& pa, const PlacedShape& pb, Asked asked, Answer<R>& r, PairScene<R>& s) {
  const RoundedPose<R> a = rounded_pose<R>(pa.pose), b = rounded_pose<R>(pb.pose);
  prepare(pa, a, pb, b, s);
  s.contact = ContactForm::cores;
  separate_cores(a, b, asked, std::numeric_limits<R>::infinity(), r, s);
}

namespace {

template <class R>
bool in_box(const V3<R>& p, const V3<R>& h, R tolerance) {
  return ((p.cwiseAbs() - h).array() <= tolerance).all();
}

// Deepest points of two overlapping boxes, from their manifold; false if it does not contain them.
template <class R>
bool box_witnesses(const BoxPair<R>& p, PairScene<R>& s, Answer<R>& r) {
  const Patch<R> patch = contact_patch<R>(s.a, &s.b, s.at, s.normal, r.gap, 0, nullptr);
  if (patch.size == 0) return false;
  std::size_t best = 0;
  for (std::size_t i = 1; i < static_cast<std::size_t>(patch.size); ++i)
    if (patch.point[i].depth > patch.point[best].depth) best = i;
  r.a = patch.point[best].p - s.normal * (r.gap / 2);
  r.b = r.a + s.normal * r.gap;
  const R tolerance = p.displacement / 4;
  return in_box<R>(r.a, p.ha, tolerance) &&
         in_box<R>(s.at.b_to_a.transpose() * (r.b - s.at.offset), p.hb, tolerance);
}

}  // namespace

template <class R>
void box_box(const PlacedShape& pa, const PlacedShape& pb, Asked asked, Answer<R>& r, PairScene<R>& s) {
  const RoundedPose<R> a = rounded_pose<R>(pa.pose), b = rounded_pose<R>(pb.pose);
  const BoxPair<R> p = box_pair(*pa.shape, a, *pb.shape, b);
  if (!detail::squares_hold(p.size())) return convex_pair(pa, pb, asked, r, s);
  r.bound = p.displacement;
  if (asked == Asked::overlap) {
    r.found = boxes_meet(p);
    return;
  }
  const BoxAxis<R> axis = least_axis(p);
  if (axis.found == Found::apart) {
    r.found = Found::apart;
    // The separation along the axis is only a lower bound of the distance.
    if (asked == Asked::distance) convex_pair(pa, pb, asked, r, s);
    return;
  }
  s.a = pa.body<R>();
  s.b = pb.body<R>();
  s.at = p.at;
  s.contact = ContactForm::cores;
  s.normal = r.normal = axis.normal;
  r.gap = axis.separation;
  r.bound = displacement(s) + p.displacement / 16;
  r.a = r.b = V3<R>::Zero();
  if (asked == Asked::distance && !box_witnesses(p, s, r)) return convex_pair(pa, pb, asked, r, s);
  to_world(r, s, scale(s.a, s.b, a, b), asked);
}

template <class R>
void box_and_capsule(const PlacedShape& pa, const PlacedShape& pb, Asked asked, Answer<R>& r,
                     PairScene<R>& s) {
  const RoundedPose<R> a = rounded_pose<R>(pa.pose), b = rounded_pose<R>(pb.pose);
  const BoxCapsule<R> q = box_capsule(*pa.shape, a, *pb.shape, b);
  if (!detail::squares_hold(q.scale) || !solve(q, asked, r)) return convex_pair(pa, pb, asked, r, s);
  if (asked == Asked::overlap) return;
  const BoxSegment<R>& p = q.cores;
  const R depth = -r.gap, tolerance = rounding::axis_distance * u<R> *
                                      (p.half.sum() + p.h + q.radius + p.c.template lpNorm<1>());
  if (asked == Asked::contact && depth >= -r.bound && detail::lies_along(p, r.normal, depth, tolerance)) {
    prepare(pa, a, pb, b, s);
    s.contact = ContactForm::cores;
    s.normal = r.normal;
    s.middle = (r.a + r.b) / 2;
    s.has_middle = true;
  }
  r.normal = q.to_world * r.normal;
  r.a = q.to_world * r.a;
  r.b = q.to_world * r.b;
}

// A half-space's normal with a length outside this range is left to extended precision: its square comes
// close to the limits of double.
constexpr double least_normal = 1e-100, largest_normal = 1e100;

template <class R>
void convex_half_space(const PlacedShape& pa, const PlacedShape& pb, Asked asked, Answer<R>& r,
                       PairScene<R>& s) {
  const RoundedPose<R> a = rounded_pose<R>(pa.pose), b = rounded_pose<R>(pb.pose);
  s.a = pa.body<R>();
  const UnitHalfSpace plane = pb.half_space();
  if (!(plane.length > least_normal && plane.length < largest_normal)) return;
  const V3<R> m = (matrix(b) * plane.normal.template cast<R>()).normalized();
  const R offset = static_cast<R>(plane.offset);
  s.at.a_to_world = matrix(a);
  s.contact = ContactForm::plane;
  const V3<R> d = b.t - a.t, n = -m;
  if (!detail::squares_hold(std::max(std::max(s.a.extent, std::abs(offset)), detail::largest(d)))) return;
  r.normal = n;
  s.normal = s.at.a_to_world.transpose() * n;
  r.a = s.at.a_to_world * support_local<R>(s.a, s.normal) + s.a.radius * n;
  r.gap = m.dot(r.a) - m.dot(d) - offset;
  r.b = r.a + r.gap * n;
  // The direction of the plane's normal: of the shape's, divided by its length, and turned by the pose if it
  // turns at all.
  const R of_normal = b.x == 0 && b.y == 0 && b.z == 0 ? 10 : 26;
  r.bound = u<R> * ((22 + of_normal) * (s.a.reach + s.a.radius) + (14 + of_normal) * d.norm() +
                    8 * std::abs(offset));
  r.found = decide(r.gap, r.bound);
  s.b.extent = std::abs(offset);
  if (asked != Asked::overlap && !accepted(r.bound, scale(s.a, s.b, a, b))) r.found = Found::unsure;
}

#define TS_INSTANTIATE(R)                                                                                  \
  template void convex_pair(const PlacedShape&, const PlacedShape&, Asked, Answer<R>&, PairScene<R>&);     \
  template void separate_cores(const RoundedPose<R>&, const RoundedPose<R>&, Asked, R, Answer<R>&,         \
                               PairScene<R>&);                                                             \
  template void box_box(const PlacedShape&, const PlacedShape&, Asked, Answer<R>&, PairScene<R>&);         \
  template void box_and_capsule(const PlacedShape&, const PlacedShape&, Asked, Answer<R>&, PairScene<R>&); \
  template void convex_half_space(const PlacedShape&, const PlacedShape&, Asked, Answer<R>&, PairScene<R>&);
TS_INSTANTIATE(double)
TS_INSTANTIATE(float)
#undef TS_INSTANTIATE

}  // namespace touchstone::narrow::filtered
