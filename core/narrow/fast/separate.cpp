#include "core/narrow/fast/separate.h"

#include "core/narrow/fast/box_box.h"
#include "core/narrow/fast/epa.h"

namespace touchstone::narrow::fast {
namespace {

template <class R>
R displacement(const PairScene<R>& s) {
  return displacement_of<R>(s.a.reach + s.a.radius, s.b.reach + s.b.radius, s.at.offset.norm());
}

// L of truth.md, of the pair as R holds it.
template <class R>
R scale(const Body<R>& a, const Body<R>& b, const Stand<R>& at_a, const Stand<R>& at_b) {
  return std::max(std::max(a.extent, b.extent),
                  std::max(at_a.t.cwiseAbs().maxCoeff(), at_b.t.cwiseAbs().maxCoeff()));
}

// The part of it that does not depend on where the pair is, from below: what a search aims at.
template <class R>
R local_scale(const PairScene<R>& s) {
  return std::max(std::max(s.a.extent, s.b.extent), s.at.offset.norm() * R(0.28));  // 1/(2√3) < 0.2887
}

// From A's frame to world axes about A's translation; unsure when the value is not as good as asked.
template <class R>
void to_world(Answer<R>& r, const PairScene<R>& s, R l, Asked asked) {
  const M3<R>& m = s.at.a_to_world;
  r.normal = m * r.normal, r.a = m * r.a, r.b = m * r.b;
  r.found = decide(r.gap, r.bound);
  const bool verdict_is_enough = asked == Asked::contact && r.found == Found::apart;
  if (verdict_is_enough) return;
  const R tau = accuracy(l);
  if (!(r.bound <= tau)) r.found = Found::unsure;
  if ((asked == Asked::distance || s.has_middle) &&
      !(std::abs((r.b - r.a).norm() - std::abs(r.gap)) <= tau / 4))
    r.found = Found::unsure;
}

template <class R>
Answer<R> from_walk(const Walk<R>& g, PairScene<R>& s, R error) {
  Answer<R> r;
  V3<R> v = V3<R>::Zero();
  for (int i = 0; i < g.simplex.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    r.a += g.simplex.weight[k] * g.simplex.p[k].a, v += g.simplex.weight[k] * g.simplex.p[k].w;
  }
  const R radii = s.a.radius + s.b.radius;
  r.normal = s.normal = g.normal, r.gap = g.upper - radii;
  r.b = r.a + v;
  // Inflated along their own difference, so that b − a stays parallel to it.
  const R length = v.norm();
  const V3<R> d = length > 0 ? V3<R>(v / length) : g.normal;
  r.a += s.a.radius * d, r.b -= s.b.radius * d;
  r.bound = error + std::max<R>(0, g.upper - g.lower);
  s.middle = (r.a + r.b) / 2, s.has_middle = true;
  return r;
}

template <class R>
Answer<R> from_depth(const Depth<R>& e, PairScene<R>& s, R error) {
  Answer<R> r;
  if (e.end == ExpandEnd::flat) return r;
  s.normal = r.normal = -e.outward;
  r.gap = -e.upper - s.a.radius - s.b.radius;
  r.a = e.a + s.a.radius * r.normal, r.b = e.a + e.w - s.b.radius * r.normal;
  r.bound = error + std::max<R>(0, e.upper - e.lower);
  s.middle = (r.a + r.b) / 2, s.has_middle = true;
  return r;
}

}  // namespace

template <class R>
Answer<R> convex_pair(const Shape& sa, const Stand<R>& a, const Shape& sb, const Stand<R>& b, Asked asked,
                      PairScene<R>& s) {
  prepare(sa, a, sb, b, s), s.contact = ContactForm::cores;
  const Difference<R> d{s.a, s.b, s.at};
  const R error = displacement(s), radii = s.a.radius + s.b.radius;
  const R size = s.a.reach + s.b.reach + s.at.offset.norm();
  const R tolerance = accuracy(local_scale(s)) / 8;
  const R certain = asked == Asked::distance ? std::numeric_limits<R>::infinity() : error + radii;
  const Walk<R> g = walk<R>(d, tolerance, certain, 4 * u<R> * size);
  Answer<R> r;
  if (g.lower > certain) {
    r.found = Found::apart, r.bound = error;
    return r;
  }
  if (asked == Asked::overlap &&
      (g.upper < radii - error || (g.end == WalkEnd::enclosed && g.margin + radii > error))) {
    r.found = Found::meeting, r.bound = error;
    return r;
  }
  if (g.end == WalkEnd::enclosed || g.end == WalkEnd::touching) {
    Expander<R> polytope(d, size, tolerance);
    r = from_depth(polytope.run(g.simplex, g.end == WalkEnd::enclosed), s, error);
  } else {
    r = from_walk(g, s, error);
  }
  to_world(r, s, scale(s.a, s.b, a, b), asked);
  return r;
}

template <class R>
Answer<R> box_box(const Shape& sa, const Stand<R>& a, const Shape& sb, const Stand<R>& b, Asked asked,
                  PairScene<R>& s) {
  const BoxPair<R> p = box_pair(sa, a, sb, b);
  Answer<R> r;
  if (asked == Asked::overlap) {
    r.found = boxes_meet(p), r.bound = p.displacement;
    return r;
  }
  const BoxAxis<R> axis = least_axis(p);
  if (axis.found == Found::apart) {
    // Its separation bounds the distance from below only.
    if (asked == Asked::distance) return convex_pair(sa, a, sb, b, asked, s);
    r.found = Found::apart;
    return r;
  }
  s.a = make_body<R>(sa), s.b = make_body<R>(sb), s.at = p.at, s.contact = ContactForm::cores;
  s.normal = r.normal = axis.normal, r.gap = axis.separation, r.bound = displacement(s) + p.displacement / 16;
  if (asked == Asked::distance) {
    const Patch<R> patch = contact_patch<R>(s.a, &s.b, s.at, s.normal, r.gap, nullptr);
    int best = 0;
    for (int i = 1; i < patch.size; ++i)
      if (patch.point[static_cast<std::size_t>(i)].depth > patch.point[static_cast<std::size_t>(best)].depth)
        best = i;
    r.a = patch.point[static_cast<std::size_t>(best)].p - r.normal * (r.gap / 2);
    r.b = r.a + r.normal * r.gap;
  }
  to_world(r, s, scale(s.a, s.b, a, b), asked);
  return r;
}

template <class R>
Answer<R> convex_half_space(const Shape& sa, const Stand<R>& a, const Shape& sb, const Stand<R>& b,
                            Asked asked, PairScene<R>& s) {
  s.a = make_body<R>(sa);
  const HalfSpace& plane = *std::get_if<HalfSpace>(&sb);
  const double length = plane.normal.norm();
  Answer<R> r;
  if (!(length > 1e-100 && length < 1e100)) return r;
  const V3<R> m = (matrix(b) * (plane.normal / length).template cast<R>()).normalized();
  const R offset = static_cast<R>(plane.offset / length);
  s.at.a_to_world = matrix(a), s.contact = ContactForm::plane;
  const V3<R> d = b.t - a.t, n = -m;
  r.normal = n, s.normal = s.at.a_to_world.transpose() * n;
  r.a = s.at.a_to_world * support_local<R>(s.a, s.normal) + s.a.radius * n;
  r.gap = m.dot(r.a) - m.dot(d) - offset;
  r.b = r.a + r.gap * n;
  const R reach = s.a.reach + s.a.radius, far = d.norm();
  r.bound = u<R> * (48 * reach + 40 * far + 8 * std::abs(offset));
  r.found = decide(r.gap, r.bound);
  s.b.extent = std::abs(offset);
  const R l = scale(s.a, s.b, a, b);
  if (asked != Asked::overlap && !(r.bound <= accuracy(l))) r.found = Found::unsure;
  return r;
}

template Answer<double> convex_pair(const Shape&, const Stand<double>&, const Shape&, const Stand<double>&,
                                    Asked, PairScene<double>&);
template Answer<float> convex_pair(const Shape&, const Stand<float>&, const Shape&, const Stand<float>&,
                                   Asked, PairScene<float>&);
template Answer<double> box_box(const Shape&, const Stand<double>&, const Shape&, const Stand<double>&, Asked,
                                PairScene<double>&);
template Answer<float> box_box(const Shape&, const Stand<float>&, const Shape&, const Stand<float>&, Asked,
                               PairScene<float>&);
template Answer<double> convex_half_space(const Shape&, const Stand<double>&, const Shape&,
                                          const Stand<double>&, Asked, PairScene<double>&);
template Answer<float> convex_half_space(const Shape&, const Stand<float>&, const Shape&, const Stand<float>&,
                                         Asked, PairScene<float>&);

}  // namespace touchstone::narrow::fast
