#include "oracles/referee/filter/convex.h"

#include <algorithm>
#include <tuple>

#include "core/math/roundoff.h"
#include "oracles/referee/filter/half_space.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

constexpr Real box_rounding = 0x1p-48L;  // more than a dozen roundings of 2^-64

// Lower and upper bound of the distance of two closed sets inside these boxes, whether or not the sets touch
// the faces. Squares of doubles fit a Real, whatever their size.
Real least_distance(const Aabb& a, const Aabb& b) {
  Real sq = 0;
  for (int k = 0; k < 3; ++k) {
    const Real d = std::max({Real{0}, Real{a.lo[k]} - b.hi[k], Real{b.lo[k]} - a.hi[k]});
    sq += d * d;
  }
  return std::sqrt(sq) * (1 - box_rounding);
}
Real greatest_distance(const Aabb& a, const Aabb& b) {
  Real sq = 0;
  for (int k = 0; k < 3; ++k) {
    const Real d = std::max(Real{a.hi[k]} - b.lo[k], Real{b.hi[k]} - a.lo[k]);
    sq += d * d;
  }
  return std::sqrt(sq) * (1 + box_rounding);
}

struct Candidate {
  Real distance;
  std::size_t i, j;
};

std::vector<Aabb> boxes_of(std::span<const Operand> parts) {
  std::vector<Aabb> r;
  for (const Operand& p : parts) r.push_back(box_of(p.body));
  return r;
}

// Pairs of parts that can hold the least distance, nearest boxes first.
std::vector<Candidate> by_box_distance(std::span<const Operand> a, std::span<const Operand> b) {
  spend(static_cast<std::int64_t>(a.size() * b.size()) * 10);
  const std::vector<Aabb> x = boxes_of(a), y = boxes_of(b);
  Real reached = infinity;
  for (const Aabb& p : x)
    for (const Aabb& q : y) reached = std::min(reached, greatest_distance(p, q));
  std::vector<Candidate> r;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j)
      if (const Real d = least_distance(x[i], y[j]); d <= reached) r.push_back({d, i, j});
  std::sort(r.begin(), r.end(), [](const Candidate& p, const Candidate& q) {
    return std::tie(p.distance, p.i, p.j) < std::tie(q.distance, q.i, q.j);
  });
  return r;
}

// Joins the truth of one more part to that of the union so far.
void join(ConvexTruth& t, ConvexTruth&& part) {
  const Real lo = std::min(t.lo, part.lo);
  const int level = std::max(t.level, part.level);
  if (part.verdict == Verdict::overlap) {
    t = std::move(part);
  } else {
    const bool undecided = t.verdict == Verdict::undecided || part.verdict == Verdict::undecided;
    if (part.hi < t.hi) t = std::move(part);
    if (undecided) t.verdict = Verdict::undecided;
  }
  t.lo = lo;
  t.level = level;
}

ConvexTruth empty_union() {
  ConvexTruth t;
  t.verdict = Verdict::disjoint;
  t.lo = t.hi = infinity;
  return t;
}

void finish_mesh(ConvexTruth& t) {
  t.inner.reset();
  if (t.verdict == Verdict::overlap) {
    t.lo = -infinity;
    t.hi = 0;
  }
}

}  // namespace

std::vector<Operand> parts_of(const Placed& p, const Vec3& origin) {
  std::vector<Operand> r;
  if (const auto* m = std::get_if<TriangleMesh>(p.shape)) {
    spend(static_cast<std::int64_t>(m->triangles.size()) * 500);
    for (std::size_t i = 0; i < m->triangles.size(); ++i) r.push_back(make_operand(p, *m, i, origin));
  } else {
    r.push_back(make_operand(p, origin));
  }
  return r;
}

ConvexTruth judge_parts(std::span<const Operand> a, std::span<const Operand> b, bool surface) {
  if (!surface) return judge_convex(a[0], b[0]);
  ConvexTruth t = empty_union();
  for (const Candidate& c : by_box_distance(a, b)) {
    // All further candidates are farther than the distance already reached.
    if (c.distance > std::max(t.hi, Real{0})) break;
    // A part farther away than the nearest so far changes neither end of the bracket.
    ConvexTruth part = judge_convex(a[c.i], b[c.j], {}, Effort::gap, t.hi);
    if (part.exact) part.exact_operands = {a[c.i].exact_body(), b[c.j].exact_body()};
    join(t, std::move(part));
    if (t.verdict == Verdict::overlap) break;
  }
  finish_mesh(t);
  return t;
}

Bracket gap_of_deepest(std::span<const Operand> a, std::span<const Operand> b) {
  ConvexTruth t = empty_union();
  for (const Candidate& c : by_box_distance(a, b)) {
    if (c.distance > 0) break;
    const ConvexTruth part = judge_convex(a[c.i], b[c.j]);
    t.lo = std::min(t.lo, part.lo);
    t.hi = std::min(t.hi, part.hi);
  }
  return {round_down(t.lo), round_up(t.hi)};
}

ConvexTruth judge_parts_half_space(std::span<const Operand> a, const Placed& half_space, const Vec3& origin,
                                   bool surface) {
  if (!surface) return judge_half_space(half_space, a[0], origin);
  ConvexTruth t = empty_union();
  for (const Operand& part : a) {
    join(t, judge_half_space(half_space, part, origin));
    if (t.verdict == Verdict::overlap) break;
  }
  finish_mesh(t);
  return t;
}

}  // namespace touchstone::referee
