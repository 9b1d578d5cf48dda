#include "oracles/referee/convex.h"

#include <algorithm>

#include "core/tolerance.h"
#include "oracles/referee/counters.h"
#include "oracles/referee/meridian.h"

namespace touchstone::referee {
namespace {

bool is_curved(const Solid& b) { return b.kind != Solid::Kind::points; }

std::vector<Real3> first_directions(const Difference& d, std::span<const Real3> hints) {
  std::vector<Real3> r(hints.begin(), hints.end());
  const auto centre = [](const Solid& b) { return is_curved(b) ? b.centre : b.points[0]; };
  Real3 n = centre(d.b) - centre(d.a);
  if (largest(n) == 0) n = {1, 0, 0};
  r.push_back(n);
  return r;
}

void take_witness(ConvexTruth& t, const Difference& d, const Simplex& s) {
  t.witness_a = t.witness_b = {};
  for (int i = 0; i < s.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    t.witness_a = t.witness_a + s.weight[k] * s.vertex[k].a;
    t.witness_b = t.witness_b + s.weight[k] * s.vertex[k].b;
  }
  t.common = d.radius > 0 ? t.witness_a + (d.a.radius / d.radius) * (t.witness_b - t.witness_a) : t.witness_a;
  t.witness_a = t.witness_a + static_cast<Real>(d.a.radius) * t.normal;
  t.witness_b = t.witness_b - static_cast<Real>(d.b.radius) * t.normal;
}

// A stall of rounded signs is met once more with exact ones. A cap is not when the bracket is as narrow as
// the capped number of facets makes it on a continuum of near-minima (a circle of 700 chords: 1e-5 of the
// size): then the surface is sound and exact signs do not shorten the work.
constexpr Real continuum_width = 1e-4L;  // in units of the pair's extent

EpaResult grow(const Difference& d, const GjkResult& g, Real target, int cap) {
  EpaResult e = expand(d, g.simplex, target, cap, Orientation::rounded);
  const Real lo = std::max(e.gap.lo, g.gap.lo), hi = std::min(e.gap.hi, g.gap.hi);
  const bool final = e.exit == EpaResult::Exit::flat ||
                     (e.exit == EpaResult::Exit::facet_cap && hi - lo < continuum_width * d.extent);
  if (final || hi - lo <= 8 * target) return e;
  ++counters().exact_expansions;
  EpaResult f = expand(d, g.simplex, target, cap, Orientation::exact);
  f.gap.raise(e.gap.lo, e.gap.direction);
  if (e.gap.hi < f.gap.hi) f.gap.hi = e.gap.hi, f.nearest = e.nearest, f.polytope = std::move(e.polytope);
  return f;
}

void settle_exactly(ConvexTruth& t, const Operand& a, const Operand& b, const Simplex& s) {
  std::vector<IndexPair> seed;
  for (int i = 0; i < s.size; ++i) {
    const Vertex& v = s.vertex[static_cast<std::size_t>(i)];
    if (v.ia >= 0 && v.ib >= 0) seed.emplace_back(v.ia, v.ib);
  }
  t.exact = decide(make_exact(*a.exact, *b.exact), seed);
  t.level = 2;
  t.verdict = t.exact->overlap ? Verdict::overlap : Verdict::disjoint;
  if (t.exact->overlap) {
    t.hi = std::min(t.hi, Real{0});
    t.lo = t.exact->touching ? Real{0} : std::min(t.lo, Real{0});
    if (t.exact->touching) t.hi = 0;
  } else {
    t.lo = std::max(t.lo, Real{0});
  }
}

}  // namespace

Operand make_operand(const Placed& p, const Vec3& origin) {
  Operand r{make_body(p, frame_of(p, origin)), std::nullopt};
  if (auto core = core_points(p)) r.exact = ExactBody{std::move(*core), core_radius(p), p.pose};
  return r;
}

Operand make_operand(const Placed& p, const TriangleMesh& mesh, std::size_t triangle, const Vec3& origin) {
  std::vector<Vec3> core;
  for (int k : mesh.triangles[triangle]) core.push_back(mesh.vertices[static_cast<std::size_t>(k)]);
  Operand r{make_body(core, 0, frame_of(p, origin)), std::nullopt};
  r.exact = ExactBody{std::move(core), 0, p.pose};
  return r;
}

Real target_width(const Difference& d) {
  const Real noise = 64 * unit * d.extent + 4 * d.error;
  if (!is_curved(d.a) && !is_curved(d.b)) return noise;
  return std::max(noise, static_cast<Real>(tolerance::referee_width_factor) * d.extent);
}

ConvexTruth judge_convex(const Operand& a, const Operand& b, std::span<const Real3> hints, Effort effort) {
  ++counters().convex_pairs;
  const Difference d(a.body, b.body);
  const Real target = target_width(d);
  GjkResult g = gjk(d, first_directions(d, hints), target);
  CoreGap gap = g.gap;
  ConvexTruth t;
  Simplex nearest = g.simplex;
  const auto settle = [&] {
    t.lo = gap.lo - d.radius - d.radius_error;
    t.hi = gap.hi - d.radius + d.radius_error;
    t.verdict = t.lo > 0 ? Verdict::disjoint : t.hi <= 0 ? Verdict::overlap : Verdict::undecided;
  };
  settle();
  const bool verdict_suffices = effort == Effort::verdict_only && t.verdict != Verdict::undecided;
  if (gap.hi - gap.lo > target && !verdict_suffices) {
    ++counters().expansions;
    const bool curved = is_curved(a.body) || is_curved(b.body);
    int cap = curved ? tolerance::referee_curved_facet_cap : tolerance::referee_facet_cap;
    if (curved) {
      const MeridianBound m = meridian_bound(d, target);
      gap.raise(m.gap.lo, m.gap.direction);
      gap.lower(m.gap.hi);
      // Symmetry has closed the bracket: what is left to find is a pair of points.
      if (gap.hi - gap.lo <= target) cap = tolerance::referee_witness_facet_cap;
    }
    EpaResult e = grow(d, g, target, cap);
    gap.raise(e.gap.lo, e.gap.direction);
    if (e.gap.hi < g.gap.hi) nearest = e.nearest;
    gap.lower(e.gap.hi);
    if (e.gap.hi < 0) t.inner = std::move(e.polytope), t.inner_depth = d.radius - d.radius_error - e.gap.hi;
    settle();
  }
  t.normal = normalized(gap.direction);
  take_witness(t, d, g.simplex);
  const Real3 common = t.common;
  take_witness(t, d, nearest);
  t.common = common;
  if (t.verdict == Verdict::undecided && a.exact && b.exact) settle_exactly(t, a, b, nearest);
  if (t.level == 2) ++counters().exact;
  if (t.verdict == Verdict::undecided) ++counters().undecided;
  return t;
}

}  // namespace touchstone::referee
