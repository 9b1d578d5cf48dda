// The gap at one time of a motion, and the deepest time of a step.
#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/limits.h"
#include "oracles/referee/motion/motion.h"
#include "oracles/referee/solid/solid.h"
#include "oracles/referee/work.h"

namespace touchstone::referee {
namespace {

std::vector<Mover> movers(const Placed& p, const Motion& m, const Vec3& minus) {
  const auto* mesh = std::get_if<TriangleMesh>(p.shape);
  std::vector<Mover> r;
  if (!mesh) r.emplace_back(p, m, minus, std::nullopt);
  for (std::size_t i = 0; mesh && i < mesh->triangles.size(); ++i) r.emplace_back(p, m, minus, i);
  return r;
}

Bracket gap_to_half_space(const std::vector<Mover>& parts, const Placed& b, const Vec3& turn,
                          const Vec3& origin, double t) {
  Bracket r{infinity, infinity};
  for (const Mover& x : parts) {
    const ConvexTruth g = Course(x, b, turn, origin).at(t, Effort::gap);
    r.lo = std::min(r.lo, round_down(g.lo));
    r.hi = std::min(r.hi, round_up(g.hi));
  }
  return r;
}

struct Sample {
  double t, gap;
};

// Golden-section steps, to 2^-31 of the interval: the value at a smooth minimum is then right to 62 bits.
constexpr int golden_steps = 46;

// Golden-section search on (from, to); keeps the least sample it meets.
Sample refined(const auto& gap, double from, double to, Sample best) {
  const auto evaluate = [&](double t) {
    const double g = gap(t);
    if (g < best.gap) best = {t, g};
    return g;
  };
  double x = to - limits::golden * (to - from), y = from + limits::golden * (to - from);
  double gx = evaluate(x), gy = evaluate(y);
  for (int i = 0; i < golden_steps; ++i) {
    if (gx <= gy) {
      to = y;
      y = x;
      gy = gx;
      x = to - limits::golden * (to - from);
      gx = evaluate(x);
    } else {
      from = x;
      x = y;
      gx = gy;
      y = from + limits::golden * (to - from);
      gy = evaluate(y);
    }
  }
  return best;
}

// Bound of the rate of change of the gap: no two points of A and B approach faster. Only guides the search.
double rate_of_gap(const Placed& a, const Motion& ma, const Placed& b, const Motion& mb) {
  const auto turning = [](const Placed& p, const Motion& m) {
    const double radius = bounding_radius(*p.shape);
    return m.angular.isZero(0) || !std::isfinite(radius) ? 0.0 : m.angular.stableNorm() * radius;
  };
  return (ma.linear - mb.linear).stableNorm() + turning(a, ma) + turning(b, mb);
}

}  // namespace

namespace {

Bracket gap_at_time(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                    double t) {
  if (is<HalfSpace>(a) && is<HalfSpace>(b)) return gap_of_half_spaces(a, motion_a, b, motion_b, t);
  if (is<HalfSpace>(a)) return gap_at_time(b, motion_b, a, motion_a, t);
  const bool surface = is<TriangleMesh>(a) || is<TriangleMesh>(b);
  const std::vector<Mover> movers_a = movers(a, motion_a, motion_b.linear);
  if (is<HalfSpace>(b)) {
    const Vec3 turn = visible_turn(b, motion_b.angular);
    return gap_to_half_space(movers_a, b, turn, translation_of(turn.isZero(0) ? a : b), t);
  }
  const Vec3 origin = translation_of(a);
  Motion turning = motion_b;
  turning.linear = Vec3::Zero();
  std::vector<Operand> x, y;
  for (const Mover& m : movers_a) x.push_back(m.at(t, origin));
  for (const Mover& m : movers(b, turning, Vec3::Zero())) y.push_back(m.at(t, origin));
  const ConvexTruth g = judge_parts(x, y, surface);
  if (surface && g.verdict == Verdict::overlap) return gap_of_deepest(x, y);
  return {round_down(g.lo), round_up(g.hi)};
}

// Whether a point of each body at time t, rounded, is inside the other, which rests if it is a solid.
bool is_inside_at(const Placed& solid, const Placed& other, const Motion& motion, double t) {
  const Vec3 at = translation_of(other);
  for (const Mover& m : movers(other, motion, Vec3::Zero())) {
    const Solid s = m.at(t, at).body;
    const Real3 p = s.kind == Solid::Kind::points ? s.points.front() : s.centre;
    if (is_inside(solid, exact(to_double(p + to_real(at))))) return true;
  }
  return false;
}

// Surfaces farther apart than rounding say nothing about which is inside the other.
Bracket gap_of_solids(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                      double t) {
  constexpr double rounding =
      0x1p-48;  // of coordinates and sizes: what a point is moved by when it is rounded
  const AsHulls hulls(a, b);
  if (hulls.are_plain()) return gap_at_time(hulls.a(), motion_a, hulls.b(), motion_b, t);
  const AsSurface x(a), y(b);
  Bracket r = gap_at_time(*x, motion_a, *y, motion_b, t);
  const double size = bounding_radius(*a.shape) + bounding_radius(*b.shape) + translation_of(a).stableNorm() +
                      translation_of(b).stableNorm() + motion_a.linear.stableNorm() +
                      motion_b.linear.stableNorm();
  if (r.lo <= rounding * size) {
    r.lo = -infinity;
    return r;
  }
  if ((is_solid(a) && is_inside_at(a, *y, motion_b, t)) || (is_solid(b) && is_inside_at(b, *x, motion_a, t)))
    return {-infinity, 0};
  return r;
}

}  // namespace

Bracket gap_at(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b, double t) {
  return within_limit(Bracket{-infinity, infinity}, [&] {
    return has_solid(a, b) ? gap_of_solids(a, motion_a, b, motion_b, t)
                           : gap_at_time(a, motion_a, b, motion_b, t);
  });
}

namespace {

/// Minimise gap(s) over s in [0, t]. `turning`: upper bound of the angle turned; 0 means that the gap is
/// convex in s.
struct Stretch {
  double t = 0, turning = 0, rate = 0;
};

// Every sample is a certified bound at its own time, so the largest of them bounds the largest depth from
// below, whatever the search misses. Without turning the gap is convex in t (the signed distance of a point
// on a line from a convex set), and one golden-section search finds the minimum. With turning: even samples
// first; then the interval in which the gap could be least, given how fast it can change, is halved, at most
// `halvings` times or until no interval can hold less than what is known; then a golden-section search around
// the minimum.
Sample least(const auto& gap, const Stretch& on) {
  const double t = on.t;
  if (on.turning == 0) {
    Sample best{t, gap(t)};
    if (const double g = gap(0); g < best.gap) best = {0, g};
    return refined(gap, 0, t, best);
  }
  constexpr double about_two_pi = 6.28;  // eight samples a turn
  const int samples = std::min(512, 24 + static_cast<int>(8 * on.turning / about_two_pi));
  std::vector<Sample> known;
  for (int i = 0; i <= samples; ++i) {
    const double s = i == samples ? t : t * i / samples;
    known.push_back({s, gap(s)});
  }
  const auto less = [](const Sample& x, const Sample& y) { return x.gap < y.gap; };
  const auto lowest_between = [&](std::size_t i) {
    return 0.5 * (known[i].gap + known[i + 1].gap - on.rate * (known[i + 1].t - known[i].t));
  };
  constexpr int halvings = 40;
  for (int k = 0; k < halvings; ++k) {
    std::size_t at = 0;
    for (std::size_t i = 1; i + 1 < known.size(); ++i)
      if (lowest_between(i) < lowest_between(at)) at = i;
    const double so_far = std::min_element(known.begin(), known.end(), less)->gap;
    if (lowest_between(at) >= std::min(so_far, 0.0)) break;
    const double middle = known[at].t + (known[at + 1].t - known[at].t) / 2;
    known.insert(known.begin() + static_cast<std::ptrdiff_t>(at) + 1, {middle, gap(middle)});
  }
  const auto best = std::min_element(known.begin(), known.end(), less);
  const double from = best == known.begin() ? 0 : (best - 1)->t;
  const double to = best + 1 == known.end() ? t : (best + 1)->t;
  return best->gap > on.rate * (to - from) ? *best : refined(gap, from, to, *best);
}

// For a surface: the pairs of parts among which to search for the deepest. Pairs that translate without
// meeting are dropped; of the rest, keeps the `max_parts` that are nearest or deepest at `contact`, at t or
// midway.
std::vector<PartPair> worth_searching(std::vector<PartPair> parts, double t, double contact) {
  constexpr std::size_t max_parts = 64;
  if (parts.size() == 1) return parts;
  std::erase_if(parts, [&](PartPair& p) {
    return !p.course.turns() && p.course.swept(0, t).verdict == Verdict::disjoint;
  });
  if (parts.size() <= max_parts) return parts;
  const double first = std::min(contact, t);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    double near = infinity;
    for (const double s : {first, first + (t - first) / 2, t})
      near = std::min(near, round_up(parts[i].course.at(s, Effort::gap).hi));
    order.emplace_back(near, i);
    parts[i].course.forget();
  }
  std::sort(order.begin(), order.end());
  std::vector<PartPair> r;
  for (std::size_t i = 0; i < max_parts; ++i) r.push_back(std::move(parts[order[i].second]));
  return r;
}

DepthInTime deepest(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                    double t, double contact) {
  DepthInTime r;
  if (!(t > 0)) return r;
  const double turning = t * std::max(motion_a.angular.stableNorm(), motion_b.angular.stableNorm());
  const double rate = rate_of_gap(a, motion_a, b, motion_b);
  const auto take = [&](const Sample& s, std::size_t part_a, std::size_t part_b) {
    if (-s.gap > r.depth) r = {-s.gap, s.t, part_a, part_b};
  };
  if (is<HalfSpace>(a) && is<HalfSpace>(b)) {
    const auto gap = [&](double s) { return gap_of_half_spaces(a, motion_a, b, motion_b, s).hi; };
    take(least(gap, {t, turning, rate}), 0, 0);
    return r;
  }
  if (is<HalfSpace>(a)) {
    r = deepest(b, motion_b, a, motion_a, t, contact);
    std::swap(r.part_a, r.part_b);
    return r;
  }
  for (PartPair& p : worth_searching(part_pairs(a, motion_a, b, motion_b), t, contact)) {
    const auto gap = [&](double s) { return round_up(p.course.at(s, Effort::gap).hi); };
    take(least(gap, {t, p.course.turns() ? turning : 0, rate}), p.a, p.b);
  }
  return r;
}

// In triangles of the surface, or, for bodies of which one begins inside the other, at the start.
DepthInTime deepest_of_solids(const Placed& a, const Motion& motion_a, const Placed& b,
                              const Motion& motion_b, double t, double contact) {
  const AsSurface x(a), y(b);
  DepthInTime r = deepest(*x, motion_a, *y, motion_b, t, contact);
  if (!(t > 0) || !is_bounded(kind_of(*a.shape)) || !is_bounded(kind_of(*b.shape))) return r;
  if (!point_inside(a, b)) return r;
  if (const double at_start = depth_at_least(a, b); at_start > r.depth) r = {at_start, 0, 0, 0};
  return r;
}

}  // namespace

DepthInTime deepest_before(const Placed& a, const Motion& motion_a, const Placed& b, const Motion& motion_b,
                           double t, double contact) {
  return within_limit(DepthInTime{-infinity}, [&] {
    return has_solid(a, b) ? deepest_of_solids(a, motion_a, b, motion_b, t, contact)
                           : deepest(a, motion_a, b, motion_b, t, contact);
  });
}

double certified_depth_before(const Placed& a, const Motion& motion_a, const Placed& b,
                              const Motion& motion_b, double t, double contact) {
  return deepest_before(a, motion_a, b, motion_b, t, contact).depth;
}

}  // namespace touchstone::referee
