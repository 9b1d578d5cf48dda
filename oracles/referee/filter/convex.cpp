#include "oracles/referee/filter/convex.h"

#include <algorithm>

#include "oracles/referee/counters.h"
#include "oracles/referee/filter/inner_polytope.h"
#include "oracles/referee/filter/minkowski.h"
#include "oracles/referee/filter/wide.h"
#include "oracles/referee/limits.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

bool is_curved(const Solid& b) { return b.kind != Solid::Kind::points; }

std::int64_t work_of_support(const Solid& a, const Solid& b) {
  return 50 + 2 * static_cast<std::int64_t>(a.points.size() + b.points.size());
}

Real3 between_centres(const Difference& d) {
  const auto centre = [](const Solid& b) { return is_curved(b) ? b.centre : b.points[0]; };
  const Real3 n = normalized(centre(d.b) - centre(d.a));
  return largest(n) == 0 ? Real3{1, 0, 0} : n;
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

// `known`: a bracket of the same gap, which parts of curved bodies may narrow; with `for_certificate` the
// polytope has to prove it by itself. If rounded signs stall or hit the cap, and the bracket is still open,
// retries with exact ones and four times as many facets.
EpaResult grow(const Difference& d, const GjkResult& g, Real target, int cap, CoreGap& known,
               bool for_certificate) {
  EpaResult e = expand(d, g.simplex, target, cap, Orientation::rounded);
  known.raise(e.gap.lo, e.gap.direction);
  known.lower(e.gap.hi);
  const auto is_closed = [&] {
    return (for_certificate ? std::min(e.gap.hi, g.gap.hi) : known.hi) - known.lo <= 8 * target;
  };
  if (e.exit == EpaResult::Exit::flat || is_closed()) return e;
  if (known.lo < 0 && (is_curved(d.a) || is_curved(d.b))) bound_by_parts(d, e.nearest, target, known);
  if (is_closed()) return e;
  ++counters().exact_expansions;
  EpaResult f = expand(d, g.simplex, target, 4 * cap, Orientation::exact);
  f.gap.raise(e.gap.lo, e.gap.direction);
  if (e.gap.hi < f.gap.hi) {
    f.gap.hi = e.gap.hi;
    f.nearest = e.nearest;
    f.polytope = std::move(e.polytope);
  }
  return f;
}

std::vector<IndexPair> index_pairs(const Simplex& s) {
  std::vector<IndexPair> seed;
  for (int i = 0; i < s.size; ++i) {
    const Vertex& v = s.vertex[static_cast<std::size_t>(i)];
    if (v.ia >= 0 && v.ib >= 0) seed.emplace_back(v.ia, v.ib);
  }
  return seed;
}

void settle_exactly(ConvexTruth& t, const Operand& a, const Operand& b, const Simplex& s) {
  const std::vector<IndexPair> seed = index_pairs(s);
  const ExactBody x = a.exact_body(), y = b.exact_body();
  t.exact = decide_short(x, y, seed);
  t.level = t.exact ? 1 : 2;
  if (!t.exact) t.exact = decide(make_exact(x, y), seed);
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

ExactBody Operand::exact_body() const {
  return exact ? *exact : ExactBody{*core_points(placed), core_form(placed).radius, placed.pose};
}

Operand make_operand(const Placed& p, const Vec3& origin) {
  return {make_body(p, frame_of(p, origin)), std::nullopt, p};
}

Operand make_operand(const Placed& p, const TriangleMesh& mesh, std::size_t triangle, const Vec3& origin) {
  std::vector<Vec3> core;
  for (int k : mesh.triangles[triangle]) core.push_back(mesh.vertices[static_cast<std::size_t>(k)]);
  Operand r{make_body(core, 0, frame_of(p, origin)), std::nullopt};
  r.exact = ExactBody{std::move(core), 0, p.pose};
  return r;
}

Real target_width(const Difference& d) {
  const Real noise = chain_rounding * d.extent + 4 * d.error;
  if (!is_curved(d.a) && !is_curved(d.b)) return noise;
  return std::max(noise, static_cast<Real>(limits::width_factor) * d.extent);
}

namespace {

// Whether the origin is inside the tetrahedron and farther than `error` from its faces, so that D contains
// it, given that the vertices are within `error` of D. With v = unit_of<T> and vertices no longer than s: a
// determinant is within 64v·s³ (rational.cpp); all four of one sign, seen from outside, put the origin
// inside. The distance of a face is det/|area vector|, whose computed length is within 32v·s² (edges up to
// 2s, a cross product, a norm).
template <class T>
bool holds_origin(const BasicSimplex<T>& x, T s, T error) {
  constexpr int face[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  if (x.size != 4) return false;
  int sign = 0;
  for (const auto& f : face) {
    const auto w = [&](int k) -> const Triple<T>& { return x.vertex[static_cast<std::size_t>(f[k])].w; };
    const T det = dot(cross(w(0), w(1)), w(2)), slack = chain_rounding_of<T> * s * s * s;
    const T area = norm(triangle_normal(w(0), w(1), w(2))) + chain_rounding_of<T> * s * s;
    if (!(std::abs(det) - slack > error * area * (1 + dot_rounding_of<T>))) return false;
    if (sign != 0 && (det > 0) != (sign > 0)) return false;
    sign = det > 0 ? 1 : -1;
  }
  return true;
}

/// Level 0: the same search in doubles. Its brackets decide most verdicts; its result is the starting point
/// for extended precision, which then needs one step to prove the returned bracket.
struct Level0 {
  BasicSolid<double> a, b;
  std::optional<BasicDifference<double>> d;  // empty: the numbers are out of range for doubles
  BasicGjkResult<double> gjk;
  Verdict verdict = Verdict::undecided;

  void run(const Difference& fine, std::span<const Real3> directions) {
    d.reset();
    verdict = Verdict::undecided;
    if (!round_to_double(fine.a, a) || !round_to_double(fine.b, b)) return;
    d.emplace(a, b);
    std::array<Double3, 8> first;
    const std::size_t n = std::min(directions.size(), first.size());
    for (std::size_t i = 0; i < n; ++i) first[i] = to_double3(directions[i]);
    gjk = referee::gjk(*d, std::span<const Double3>(first.data(), n), target());
    if (gjk.gap.lo - d->radius - d->radius_error > 0) verdict = Verdict::disjoint;
    if (gjk.gap.hi - d->radius + d->radius_error <= 0 || holds_origin(gjk.simplex, d->extent, d->error))
      verdict = Verdict::overlap;
  }
  double target() const { return chain_rounding_of<double> * d->extent + 4 * d->error; }

  /// The simplex as it is in doubles.
  Simplex rounded_simplex() const {
    Simplex s;
    s.size = gjk.simplex.size;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.size); ++i) {
      const auto& v = gjk.simplex.vertex[i];
      s.vertex[i] = {to_real(v.w), to_real(v.a), to_real(v.b), v.ia, v.ib, to_real(v.n)};
      s.weight[i] = gjk.simplex.weight[i];
    }
    return s;
  }

  /// The simplex in extended precision: the same pairs of core vertices, or the support points of curved
  /// cores in the same directions.
  Simplex simplex(const Difference& fine) const {
    Simplex s;
    for (int i = 0; i < gjk.simplex.size; ++i) {
      const auto& v = gjk.simplex.vertex[static_cast<std::size_t>(i)];
      s.vertex[static_cast<std::size_t>(s.size++)] =
          v.ia >= 0 && v.ib >= 0 ? vertex_at(fine, v.ia, v.ib) : fine.support(to_real(v.n));
    }
    return s;
  }
};

class Judge {
 public:
  Judge(const Operand& a, const Operand& b, Effort effort, Real enough)
      : a_(a), b_(b), effort_(effort), enough_(enough), d_(a.body, b.body), target_(target_width(d_)) {}

  ConvexTruth run(std::span<const Real3> hints) {
    if (run_level0(hints) && (effort_ == Effort::verdict_only || is_farther())) return by_doubles();
    run_gjk();
    if (effort_ == Effort::verdict_only && holds_origin(gjk_.simplex, d_.extent, d_.error)) overlaps();
    const bool verdict_suffices = effort_ == Effort::verdict_only && t_.verdict != Verdict::undecided;
    if (gap_.hi - gap_.lo > target_ && gap_.lo > 0 && !verdict_suffices) project();
    if (gap_.hi - gap_.lo > target_ && gap_.lo > 0 && !verdict_suffices) search_wider();
    if (gap_.hi - gap_.lo > target_ && !verdict_suffices) run_epa();
    // Slivers: extended precision may stall among them, 1e-15 of the extent away at most.
    if (gap_.hi - gap_.lo > 64 * target_ && gap_.hi > 0 && !verdict_suffices) measure_exactly();
    t_.normal = normalized(gap_.direction);
    take_witness(t_, d_, gjk_.simplex);
    const Real3 common = t_.common;
    take_witness(t_, d_, nearest_);
    t_.common = common;
    if (t_.verdict == Verdict::undecided && a_.has_exact() && b_.has_exact())
      settle_exactly(t_, a_, b_, nearest_);
    count();
    return std::move(t_);
  }

 private:
  // Whether doubles decide the verdict.
  bool run_level0(std::span<const Real3> hints) {
    directions_.assign(hints.begin(), hints.end());
    directions_.push_back(between_centres(d_));
    level0_.run(d_, directions_);
    return level0_.verdict != Verdict::undecided;
  }

  bool is_farther() const {
    return level0_.verdict == Verdict::disjoint &&
           static_cast<Real>(level0_.gjk.gap.lo) - d_.radius - d_.radius_error > enough_;
  }

  void run_gjk() {
    if (level0_.d) {
      const Simplex seed = level0_.simplex(d_);
      gjk_ = gjk(d_, std::span<const Real3>(directions_), target_, &seed);
      gap_ = gjk_.gap;
      directions_.push_back(to_real(level0_.gjk.gap.direction));
    }
    settle();
    const bool curved = is_curved(a_.body) || is_curved(b_.body);
    const bool open = gap_.hi - gap_.lo > target_ || t_.verdict == Verdict::undecided;
    if (!level0_.d || (curved && gjk_.simplex.size < 4 && open)) {
      gjk_ = gjk(d_, std::span<const Real3>(directions_), target_);
      gap_.raise(gjk_.gap.lo, gjk_.gap.direction);
      gap_.lower(gjk_.gap.hi);
    } else if (curved) {
      for (const Real3& n : directions_) gap_.raise(-d_.width_above(d_.support(n), n), n);
    }
    nearest_ = gjk_.simplex;
    settle();
  }

  // What level 0 proves is proven of the bodies themselves.
  ConvexTruth by_doubles() {
    gap_.raise(level0_.gjk.gap.lo, to_real(level0_.gjk.gap.direction));
    gap_.lower(level0_.gjk.gap.hi);
    settle();
    if (level0_.verdict == Verdict::overlap) overlaps();
    t_.normal = normalized(gap_.direction);
    take_witness(t_, d_, level0_.rounded_simplex());
    count();
    return std::move(t_);
  }

  void overlaps() {
    t_.verdict = Verdict::overlap;
    t_.hi = std::min(t_.hi, Real{0});
  }

  void settle() {
    t_.lo = gap_.lo - d_.radius - d_.radius_error;
    t_.hi = gap_.hi - d_.radius + d_.radius_error;
    t_.verdict = t_.lo > 0 ? Verdict::disjoint : t_.hi <= 0 ? Verdict::overlap : Verdict::undecided;
  }

  void run_epa() {
    ++counters().expansions;
    const bool curved = is_curved(a_.body) || is_curved(b_.body);
    int cap = curved ? limits::curved_facet_cap : limits::facet_cap;
    if (curved) {
      spend(100'000);
      const MeridianBound m = meridian_bound(d_, target_);
      gap_.raise(m.gap.lo, m.gap.direction);
      gap_.lower(m.gap.hi);
      // Symmetry has closed the bracket: only a pair of points is still missing.
      if (gap_.hi - gap_.lo <= target_) cap = limits::witness_facet_cap;
    } else if (effort_ != Effort::certificate && confirm_level0(cap)) {
      return settle();
    }
    CoreGap known = gap_;
    EpaResult e = grow(d_, gjk_, target_, cap, known, effort_ == Effort::certificate);
    take(e.gap, e.nearest);
    take(known, e.nearest);
    if (e.gap.hi < 0 && effort_ == Effort::certificate) {
      t_.inner = std::move(e.polytope);
      t_.inner_depth = d_.radius - d_.radius_error - e.gap.hi;
    }
    settle();
  }

  // When the bodies are apart, the simplex of a smooth body is a sliver of close points whose chord stays
  // inside the body. Alternating projection, from a point of one core to the nearest of the other and back
  // (Cheney and Goldstein 1959, "Proximity maps for convex sets"): every pair of points is an upper bound,
  // and its direction proposes a lower bound.
  void project() {
    constexpr int rounds = 16;
    Real3 b = support(d_.b, -normalized(gap_.direction)).point, a;
    for (int i = 0; i < rounds && gap_.hi - gap_.lo > target_; ++i) {
      const Real before = gap_.hi - gap_.lo;
      const Solid at_b = core_point(b, d_.b.error);
      a = nearest_to(Difference(d_.a, at_b), a, b).a;
      const Solid at_a = core_point(a, d_.a.error);
      b = nearest_to(Difference(at_a, d_.b), a, b).b;
      if (!(gap_.hi - gap_.lo < before)) break;
    }
    settle();
  }

  // What stalls above is the rounding of slivers, which is negligible in 237 bits. A thousandth of the pairs
  // of two smooth bodies get here.
  void search_wider() {
    spend(5'000'000);
    const auto g = wide_gap(a_, b_);
    if (!g) return;
    if (largest(g->direction) > 0)
      gap_.raise(-d_.width_above(d_.support(g->direction), g->direction), g->direction);
    gap_.lower(g->above);
    settle();
  }

  static Solid core_point(const Real3& p, Real error) {
    Solid s;
    s.points = {p};
    s.extent = norm(p) * (1 + dot_rounding);
    s.error = error + dot_rounding * s.extent;
    return s;
  }

  // Nearest points of the two, one of which is a single core point.
  Vertex nearest_to(const Difference& d, const Real3& a, const Real3& b) {
    const Real3 n = normalized(b - a), best = normalized(gap_.direction);
    const std::array<Real3, 2> hints{best, n};
    const GjkResult g = gjk(d, std::span<const Real3>(hints), 0);
    Vertex v;
    for (int i = 0; i < g.simplex.size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      v.a = v.a + g.simplex.weight[k] * g.simplex.vertex[k].a;
      v.b = v.b + g.simplex.weight[k] * g.simplex.vertex[k].b;
    }
    v.w = v.a - v.b;
    if (const Real3 across = normalized(-v.w); largest(across) > 0)
      gap_.raise(-d_.width_above(d_.support(across), across), across);
    if (g.gap.hi < gap_.hi) {
      gap_.lower(g.gap.hi);
      nearest_ = {};
      nearest_.vertex[0] = v;
      nearest_.weight[0] = 1;
      nearest_.size = 1;
      nearest_.nearest = nearest_.outward = v.w;
    }
    return v;
  }

  // When the cores are apart, their nearest points are found in finitely many exact steps.
  void measure_exactly() {
    if (!a_.has_exact() || !b_.has_exact()) return;
    ++counters().exact_distances;
    const ExactPair p = make_exact(a_.exact_body(), b_.exact_body());
    const ExactVerdict v = nearest(p, index_pairs(nearest_));
    if (!(v.core_distance > 0) || !std::isfinite(v.core_distance)) return;
    const Real slack = projection_rounding * v.core_distance;
    gap_.raise(v.core_distance - slack, -direction_of(v));
    gap_.lower(v.core_distance + slack);
    nearest_ = {};
    for (const auto& [i, j] : v.simplex)
      nearest_.vertex[static_cast<std::size_t>(nearest_.size++)] = vertex_at(d_, i, j);
    reduce(nearest_);
    settle();
  }

  void take(const CoreGap& gap, const Simplex& nearest) {
    gap_.raise(gap.lo, gap.direction);
    if (gap.hi < gap_.hi) nearest_ = nearest;
    gap_.lower(gap.hi);
  }

  bool confirm_level0(int cap) {
    if (!level0_.d || level0_.gjk.simplex.size != 4) return false;
    const auto found =
        search(*level0_.d, level0_.gjk.simplex, projection_rounding_of<double> * level0_.d->extent, cap);
    const Confirmed c = confirm(d_, *level0_.d, found, 8 * target_);
    take(c.gap, c.nearest);
    if (c.doubles_prove) level0_.verdict = Verdict::overlap;
    if (!c.closed) ++counters().refinements;
    return c.closed;
  }

  void count() {
    if (t_.level != 2) t_.level = level0_.verdict != Verdict::undecided ? 0 : 1;
    Counters& c = counters();
    if (t_.verdict == Verdict::undecided)
      ++c.undecided;
    else
      ++(t_.level == 0 ? c.doubles : t_.level == 1 ? c.extended : c.exact);
  }

  static Level0& storage() {
    thread_local Level0 s;
    return s;
  }

  const Operand &a_, &b_;
  Effort effort_;
  Real enough_;
  Difference d_;
  Real target_;
  Level0& level0_ = storage();
  std::vector<Real3> directions_;
  GjkResult gjk_;
  CoreGap gap_;
  Simplex nearest_;
  ConvexTruth t_;
};

}  // namespace

ConvexTruth judge_convex(const Operand& a, const Operand& b, std::span<const Real3> hints, Effort effort,
                         Real enough) {
  ++counters().convex_pairs;
  spend(work_of_support(a.body, b.body) * 24);  // a dozen steps in doubles, then a few more
  return Judge(a, b, effort, enough).run(hints);
}

std::optional<std::array<double, 2>> gap_at_most(const Operand& a, const Operand& b, double enough) {
  thread_local Level0 level0;
  const Difference fine(a.body, b.body);
  const Real3 across = between_centres(fine);
  level0.run(fine, std::span<const Real3>(&across, 1));
  if (!level0.d) return std::nullopt;
  const auto& gap = level0.gjk.gap;
  const auto& d = *level0.d;
  const double hi = level0.verdict == Verdict::overlap ? 0.0 : gap.hi - d.radius + d.radius_error;
  if (!(hi <= enough)) return std::nullopt;
  return {{std::min(hi, gap.lo - d.radius - d.radius_error), hi}};
}

}  // namespace touchstone::referee
