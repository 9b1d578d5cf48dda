// near_minimal_normals: in how many directions a pair separates about equally fast, and how much worse the
// next direction is. Polytopes and their roundings by a ball: every local minimum is a facet normal of the
// Minkowski difference (inner_polytope.h), found in order of value. Curved pairs: descent of w from
// directions spread over the sphere; an estimate, and marked as one.
#include <algorithm>
#include <optional>

#include "oracles/referee/filter/convex.h"
#include "oracles/referee/limits.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

constexpr std::size_t normal_cap = 256;
constexpr int starts = 512;
// Directions count as nearly best within this part of the least depth, and at least this part of the extent.
// Tested by: tests/referee "within the slack faces count as equal, beyond it as second best".
constexpr Real relative_slack = 1e-6L, absolute_slack = 1e-9L;
constexpr Real golden_angle = 2.399963229728653322L;  // π(3 - √5) rad
// A descent stops at a step this short, or when the slope is this small a part of the extent.
constexpr Real least_step = 1e-10L, least_slope = 1e-12L;
constexpr Real first_step = 0.25L;
constexpr int most_steps = 500;
// A descent ends somewhat above its minimum: this part of the extent is allowed on top of the slack.
constexpr Real descent_slack = 1e-7L;
// Directions of descents / of facets that are closer than this are the same.
constexpr Real same_descent = 1e-3L, same_facet = 1e-9L;

struct Minimum {
  Real3 normal;
  Real value;
};

/// Evenly spread: the golden-angle spiral.
Real3 direction(int i) {
  const Real z = 1 - (2 * i + 1.0L) / starts, r = std::sqrt(1 - z * z), angle = i * golden_angle;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Real width_along(const Difference& d, const Real3& n) { return dot(n, d.support(n).w) + d.radius; }

// The shortest vector on the segment between u and v.
Real3 nearest_to_origin(const Real3& u, const Real3& v) {
  const Real3 along = v - u;
  const Real length_sq = dot(along, along);
  const Real at = length_sq > 0 ? std::clamp(-dot(u, along) / length_sq, Real{0}, Real{1}) : 0;
  return u + at * along;
}

// w is a maximum of dot products, so n moves against the perpendicular part of its support point. Where that
// does not lower w, n is near an edge between two support points, and moves along it; a step that fails then
// is halved. Where three or more meet at a sharp minimum, steps lower w ever less: their number is bounded.
Minimum descend(const Difference& d, Real3 n) {
  spend(20'000 + 400 * static_cast<std::int64_t>(d.a.points.size() + d.b.points.size()));
  Real value = width_along(d, n);
  std::optional<Real3> other;  // the support point of the last step that failed
  Real step = first_step;
  for (int k = 0; k < most_steps && step > least_step; ++k) {
    const auto across = [&](const Real3& v) { return v - dot(n, v) * n; };
    const Real3 steepest = across(d.support(n).w);
    const Real3 against = other ? nearest_to_origin(steepest, across(*other)) : steepest;
    if (!(norm(against) > least_slope * d.extent)) {
      if (!other) break;
      other.reset();  // on both sides of a minimum, or at an edge's
      step /= 2;
      continue;
    }
    const Real3 next = normalized(n - step * normalized(against));
    const Real3 there = d.support(next).w;
    const Real lower = dot(next, there) + d.radius;
    if (lower < value) {
      n = next;
      value = lower;
      continue;
    }
    if (other) step /= 2;
    other = there;
  }
  return {n, value};
}

// Keeps one of each cluster of directions closer than `apart`.
std::vector<Minimum> distinct(std::vector<Minimum> all, Real apart) {
  std::sort(all.begin(), all.end(), [](const Minimum& x, const Minimum& y) { return x.value < y.value; });
  std::vector<Minimum> r;
  for (const Minimum& m : all)
    if (std::none_of(r.begin(), r.end(), [&](const Minimum& k) { return norm(k.normal - m.normal) < apart; }))
      r.push_back(m);
  return r;
}

// If w is as small half-way to the nearest other minimum, the minima form a continuum.
bool runs_together(const Difference& d, const std::vector<Minimum>& near, Real limit) {
  if (near.size() < 3) return false;
  std::size_t joined = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Minimum* closest = nullptr;
    for (std::size_t j = 0; j < near.size(); ++j)
      if (j != i &&
          (!closest || norm(near[j].normal - near[i].normal) < norm(closest->normal - near[i].normal)))
        closest = &near[j];
    const Real3 between = near[i].normal + closest->normal;
    joined += largest(between) > 0 && width_along(d, normalized(between)) <= limit;
  }
  return 2 * joined > near.size();
}

void list(NearMinimalNormals& r, const std::vector<Minimum>& minima, Real limit) {
  for (const Minimum& m : minima) {
    if (m.value > limit) {
      r.second_best = static_cast<double>(m.value);
      break;
    }
    if (r.normals.size() == normal_cap) {
      r.capped = true;
      continue;
    }
    r.normals.push_back(to_double(m.normal));
    r.widths.push_back(static_cast<double>(m.value));
  }
  r.conditioning = r.second_best - r.depth;
}

void estimate(NearMinimalNormals& r, const Difference& d, const Real3& best) {
  std::vector<Minimum> all{{best, width_along(d, best)}};
  for (int i = 0; i < starts; ++i) all.push_back(descend(d, direction(i)));
  const Real limit = static_cast<Real>(r.depth) + static_cast<Real>(r.slack) + descent_slack * d.extent;
  const std::vector<Minimum> minima = distinct(std::move(all), same_descent);
  std::vector<Minimum> near;
  for (const Minimum& m : minima)
    if (m.value <= limit) near.push_back(m);
  r.continuum = runs_together(d, near, limit);
  list(r, minima, limit);
}

NearMinimalNormals all_of(const Placed& a, const Placed& b) {
  if (const AsHulls hulls(a, b); has_solid(a, b) && hulls.are_plain()) return all_of(hulls.a(), hulls.b());
  const PairTruth t = judge_pair(a, b);
  NearMinimalNormals r;
  r.second_best = r.conditioning = std::numeric_limits<double>::infinity();
  const bool bounded = !is<HalfSpace>(a) && !is<HalfSpace>(b) && !is_mesh(*a.shape) && !is_mesh(*b.shape);
  r.depth = std::isfinite(t.gap.lo) ? -0.5 * (t.gap.lo + t.gap.hi) : std::numeric_limits<double>::infinity();
  if (t.verdict != Verdict::overlap || !bounded) {
    r.normals = {t.normal};
    r.widths = {r.depth};
    r.certified = t.verdict == Verdict::disjoint;
    return r;
  }
  const Vec3 origin = translation_of(a);
  const Operand x = make_operand(a, origin), y = make_operand(b, origin);
  const Difference d(x.body, y.body);
  const Real3 best = normalized(to_real(t.normal));
  r.slack = static_cast<double>(
      std::max(relative_slack * static_cast<Real>(r.depth), absolute_slack * (d.extent + d.radius)));
  if (!x.has_exact() || !y.has_exact()) {
    estimate(r, d, best);
    return r;
  }
  const GjkResult g = gjk(d, std::span<const Real3>(&best, 1), target_width(d));
  const Real core_depth = static_cast<Real>(r.depth) - d.radius;
  const Minima m = local_minima(d, g.simplex, core_depth, static_cast<Real>(r.slack), 8 * target_width(d),
                                limits::facet_cap);
  if (m.flat) {
    estimate(r, d, best);
    return r;
  }
  std::vector<Minimum> minima;
  // When the cores are apart, their own direction need not be a facet normal.
  if (core_depth < 0) minima.push_back({best, static_cast<Real>(r.depth)});
  for (const auto& f : m.found) minima.push_back({f.normal, f.value + d.radius});
  list(r, distinct(std::move(minima), same_facet), static_cast<Real>(r.depth) + static_cast<Real>(r.slack));
  r.certified = m.complete;
  return r;
}

}  // namespace

NearMinimalNormals near_minimal_normals(const Placed& a, const Placed& b) {
  NearMinimalNormals open;  // no normal is known, so none is known to be unique
  open.continuum = true;
  return within_limit(std::move(open), [&] { return all_of(a, b); });
}

}  // namespace touchstone::referee
