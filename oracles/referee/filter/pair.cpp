// judge_pair: a pair of any two shapes, assembled from convex parts.
#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/certificate.h"
#include "oracles/referee/counters.h"
#include "oracles/referee/exact/exact_point.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/filter/half_space.h"
#include "oracles/referee/filter/wide.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

PairTruth common_part(const ConvexTruth& t, const Vec3& origin) {
  PairTruth r;
  const Real3 o = to_real(origin);
  r.verdict = t.verdict;
  r.gap = {round_down(t.lo), round_up(t.hi)};
  r.normal = to_double(t.normal);
  r.witness = {to_double(t.witness_a + o), to_double(t.witness_b + o)};
  r.level = t.level;
  return r;
}

ConvexTruth mirrored(ConvexTruth t) {
  t.normal = -t.normal;
  std::swap(t.witness_a, t.witness_b);
  return t;
}

PairTruth with_half_space(const Placed& a, const Placed& b) {
  const bool first = is<HalfSpace>(a);
  const Placed &h = first ? a : b, &other = first ? b : a;
  const Vec3 origin = translation_of(other);
  ConvexTruth t = is<HalfSpace>(other)
                      ? judge_half_spaces(h, other, origin)
                      : judge_parts_half_space(parts_of(other, origin), h, origin, is<TriangleMesh>(other));
  const Real3 outward = t.normal;
  if (!first) t = mirrored(t);
  PairTruth r = common_part(t, origin);
  Certificate& c = r.verdict_certificate;
  if (t.verdict == Verdict::overlap) c = point_certificate(t.common, origin);
  if (t.verdict == Verdict::disjoint) {
    c.kind = Certificate::Kind::separating_plane;
    c.direction = r.normal;
    c.offset = static_cast<double>((first ? 1 : -1) *
                                   dot(outward, 0.5L * (t.witness_a + t.witness_b) + to_real(origin)));
    c.note = "plane of the half-space moved half-way to the body, rounded; exact form: checkable_certificate";
  }
  return r;
}

Certificate half_space_depth(const Placed& a, const Placed& b) {
  const bool first = is<HalfSpace>(a);
  const Placed &h = first ? a : b, &other = first ? b : a;
  if (is<HalfSpace>(other) || is<TriangleMesh>(other)) return {};
  const Vec3 origin = translation_of(other);
  const ConvexTruth t = judge_half_space(h, make_operand(other, origin), origin);
  const Real3 core = t.witness_b + static_cast<Real>(core_form(other).radius) * t.normal;
  return core_pair_certificate(core, core, origin, -t.hi);
}

// The normal is returned in doubles, a little off the direction that proved the depth's upper bound. The
// bound is widened to what the doubles prove, so that (normal, -gap.lo) is itself a certificate.
void prove_by_rounded_normal(PairTruth& r, const Difference& d) {
  if (!(r.gap.lo < 0)) return;
  const Real3 n = to_real(r.normal);
  const Real above = d.width_above(d.support(n), n) + d.radius + d.radius_error;
  r.gap.lo = std::min(r.gap.lo, round_down(-above - value_rounding * std::fabs(above)));
}

Certificate rounded_plane(const ExactVerdict& v, const ConvexTruth& t, const Vec3& origin) {
  const Real3 n = -direction_of(v);
  Certificate c;
  c.kind = Certificate::Kind::separating_plane;
  c.direction = to_double(n);
  c.offset = static_cast<double>(dot(n, 0.5L * (t.witness_a + t.witness_b) + to_real(origin)));
  return c;
}

PairTruth convex_pair(const Placed& a, const Placed& b, std::span<const Vec3> hints) {
  const Vec3 origin = translation_of(a);
  const Operand x = make_operand(a, origin), y = make_operand(b, origin);
  std::vector<Real3> directions;
  for (const Vec3& n : hints)
    if (n.allFinite() && !n.isZero(0)) directions.push_back(normalized(to_real(n)));
  const ConvexTruth t = judge_convex(x, y, directions);
  PairTruth r = common_part(t, origin);
  if (t.exact) {
    r.verdict_certificate =
        t.exact->overlap ? point_certificate(t.common, origin) : rounded_plane(*t.exact, t, origin);
    r.verdict_certificate.note = "rounded; exact form: checkable_certificate";
  } else if (t.verdict == Verdict::disjoint) {
    r.verdict_certificate = plane_certificate(Difference(x.body, y.body), t.normal, origin);
  } else if (t.verdict == Verdict::overlap) {
    r.verdict_certificate = point_certificate(t.common, origin);
    if (!x.has_exact() || !y.has_exact())
      r.verdict_certificate.note = "rounded; proven by the inner polytope, which holds the origin";
  }
  const Difference d(x.body, y.body);
  prove_by_rounded_normal(r, d);
  return r;
}

bool is_finite_point(const Vec3& p) { return p.allFinite(); }

// An engine's contact point that lies in both bodies is better evidence than our own rounded one. It is
// optional: taken only when the point is proven to be in both.
void offer_points(PairTruth& r, const Placed& a, const Placed& b, std::span<const Vec3> points) {
  if (r.verdict != Verdict::overlap || r.verdict_certificate.kind != Certificate::Kind::common_point) return;
  for (const Vec3& p : points) {
    if (!is_finite_point(p)) continue;
    if (distance_to(a, p).hi == 0 && distance_to(b, p).hi == 0) {
      r.verdict_certificate.point = p;
      r.verdict_certificate.rationals.clear();
      return;
    }
  }
}

}  // namespace

std::string_view to_string(Verdict v) {
  switch (v) {
    case Verdict::disjoint:
      return "disjoint";
    case Verdict::overlap:
      return "overlap";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

namespace {

// Judges by brackets; exact only where both cores are polytopes.
PairTruth judge_by_bracket(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions,
                           std::span<const Vec3> hint_points) {
  if (is<HalfSpace>(a) || is<HalfSpace>(b)) return with_half_space(a, b);
  if (is<TriangleMesh>(a) || is<TriangleMesh>(b)) {
    const Vec3 origin = translation_of(is<TriangleMesh>(a) ? b : a);
    const ConvexTruth t = judge_parts(parts_of(a, origin), parts_of(b, origin), true);
    PairTruth r = common_part(t, origin);
    if (t.verdict == Verdict::overlap) {
      if (t.exact) {
        r.verdict_certificate = exact_certificate(t.exact_pair(), *t.exact);
      } else {
        r.verdict_certificate = point_certificate(t.common, origin);
      }
    }
    r.verdict_certificate.note = "judged triangle by triangle";
    return r;
  }
  PairTruth r = convex_pair(a, b, hint_directions);
  offer_points(r, a, b, hint_points);
  return r;
}

Certificate deepest_inside(const PairTruth& truth, const Placed& a, const Placed& b) {
  if (has_solid(a, b)) return {};  // the checker knows no depth of meshes
  if (truth.verdict != Verdict::overlap || !std::isfinite(truth.gap.lo)) return {};
  if (is<HalfSpace>(a) || is<HalfSpace>(b)) return half_space_depth(a, b);
  if (is<TriangleMesh>(a) || is<TriangleMesh>(b)) return {};
  const Vec3 origin = translation_of(a);
  const Operand x = make_operand(a, origin), y = make_operand(b, origin);
  // The search starts from the direction that is known to be nearly the best.
  const Real3 known = normalized(to_real(truth.normal));
  const ConvexTruth t =
      judge_convex(x, y, std::span<const Real3>(&known, largest(known) > 0 ? 1 : 0), Effort::certificate);
  if (t.verdict != Verdict::overlap) return {};  // touching: exact, with depth 0
  return lower_depth_certificate(t, Difference(x.body, y.body), origin);
}

PairTruth judge(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions,
                std::span<const Vec3> hint_points) {
  PairTruth r = judge_by_bracket(a, b, hint_directions, hint_points);
  if (r.verdict != Verdict::undecided) return r;
  int level = 2;
  Certificate c = guess_common_point(r.witness, a, b, level);
  if (c.kind == Certificate::Kind::none) c = search_wide(a, b);
  if (c.kind == Certificate::Kind::none) return r;
  ++(level == 1 ? counters().extended : counters().exact);
  if (counters().undecided > 0) --counters().undecided;
  r.level = level;
  if (c.kind == Certificate::Kind::separating_plane) {
    r.verdict = Verdict::disjoint;
    r.gap.lo = std::max(r.gap.lo, 0.0);
  } else {
    r.verdict = Verdict::overlap;
    r.gap.hi = std::min(r.gap.hi, 0.0);
    r.gap.lo = std::min(r.gap.lo, 0.0);
    if (is<TriangleMesh>(a) || is<TriangleMesh>(b)) r.gap = {-std::numeric_limits<double>::infinity(), 0};
  }
  r.verdict_certificate = std::move(c);
  return r;
}

// Where surfaces do not meet, one body may be inside the other. A surface that is no solid's has no depth.
PairTruth judge_solids(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions,
                       std::span<const Vec3> hint_points) {
  const AsHulls hulls(a, b);
  const Placed &x = hulls.a(), &y = hulls.b();
  if (hulls.are_plain()) return judge(x, y, hint_directions, hint_points);
  const AsSurface surface_x(x), surface_y(y);
  PairTruth r = judge(*surface_x, *surface_y, hint_directions, hint_points);
  if (r.verdict == Verdict::undecided) r.gap.lo = -infinity;
  if (r.verdict == Verdict::disjoint)
    if (const auto p = point_inside(x, y)) {
      r.verdict = Verdict::overlap;
      r.gap = {-infinity, 0};
      r.verdict_certificate = common_point_certificate(*p);
      r.witness.fill(r.verdict_certificate.point);
    }
  if (r.verdict != Verdict::overlap || is<TriangleMesh>(x) || is<TriangleMesh>(y)) return r;
  const SolidDepth d = depth_of_solids(x, y, hint_directions);
  r.gap = {-d.depth.hi, -d.depth.lo};
  if (!d.normal.isZero(0)) r.normal = d.normal;
  return r;
}

PairTruth nothing_known() {
  PairTruth r;
  r.gap = {-infinity, infinity};
  r.witness.fill(Vec3::Zero());
  r.verdict_certificate.note = too_expensive;
  return r;
}

}  // namespace

Certificate depth_certificate(const PairTruth& truth, const Placed& a, const Placed& b) {
  Certificate none;
  none.note = too_expensive;
  return within_limit(std::move(none), [&] { return deepest_inside(truth, a, b); });
}

PairTruth judge_pair(const Placed& a, const Placed& b, std::span<const Vec3> hint_directions,
                     std::span<const Vec3> hint_points) {
  return within_limit(nothing_known(), [&] {
    return has_solid(a, b) ? judge_solids(a, b, hint_directions, hint_points)
                           : judge(a, b, hint_directions, hint_points);
  });
}

}  // namespace touchstone::referee
