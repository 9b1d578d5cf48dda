#include "oracles/checker/checker.h"

#include <algorithm>

#include "oracles/checker/checker_set.h"

namespace touchstone::checker {
namespace {

using Sets = std::vector<Set>;

V minus(const V& v) { return Q(-1) * v; }
bool is_half_space(const Set& s) { return s.kind == Set::Kind::half_space; }

bool has_plane(const Certificate& c, const Set& a, const Set& b) {
  const auto separates = [&](const V& n, const Q& at) {
    const auto top_a = core_support(a, n), top_b = core_support(b, minus(n));
    return top_a && top_b && *top_a + times_root(a.ball, dot(n, n)) <= at &&
           *top_b + times_root(b.ball, dot(n, n)) < -at;
  };
  if (c.rationals.empty()) return separates(exact_value(c.direction), Q(c.offset));
  for (std::size_t i = 0; i + 3 < c.rationals.size(); i += 4) {
    const auto r = [&](std::size_t k) { return rational_of(c.rationals[i + k]); };
    if (separates({r(0), r(1), r(2)}, r(3))) return true;
  }
  return false;
}

bool check_planes(const Certificate& c, const Sets& a, const Sets& b) {
  const auto has = [&](const Set& s) {
    return std::all_of(b.begin(), b.end(), [&](const Set& t) { return has_plane(c, s, t); });
  };
  return c.rationals.size() % 4 == 0 && std::all_of(a.begin(), a.end(), has);
}

bool check_point(const Certificate& c, const Placed& placed_a, const Sets& a, const Placed& placed_b,
                 const Sets& b) {
  const auto& r = c.rationals;
  if (!r.empty() && r.size() != 3) return false;
  const V x = r.empty() ? exact_value(c.point) : V{rational_of(r[0]), rational_of(r[1]), rational_of(r[2])};
  const auto in = [&](const Set& s) { return is_within(s, x, s.ball); };
  const auto holds = [&](const Placed& p, const Sets& sets) {
    return std::any_of(sets.begin(), sets.end(), in) ||
           (std::holds_alternative<SolidMesh>(*p.shape) && is_enclosed(sets, x) == true);
  };
  return holds(placed_a, a) && holds(placed_b, b);
}

// B moved by d·n/|n| can be separated from A by a plane across k when h_A(k) + h_B(-k) <= d·(k·n)/|n|. k is n
// itself, except that a half-space has a support value only along its own normal.
bool check_direction(const V& n, const Q& d, const Set& a, const Set& b) {
  const Q nn = dot(n, n), balls = a.ball + b.ball;
  const bool own = is_half_space(a) || is_half_space(b);
  const V k = is_half_space(a) ? a.normal : is_half_space(b) ? minus(b.normal) : n;
  const auto top_a = core_support(a, k), top_b = core_support(b, minus(k));
  if (nn == 0 || !top_a || !top_b) return false;
  const Q rest =
      own ? times_root(balls, dot(k, k)) + times_root(-d * dot(k, n) / nn, nn) : times_root(balls - d, nn);
  return *top_a + *top_b + rest <= 0;
}

// The hull of the points contains the ball of radius r about the origin, because a closed surface of
// triangles between them (every directed edge as often as its reverse) stays out of the ball and winds around
// it: it crosses a ray more often outward than inward. Any ray that meets no edge will do.
bool holds_ball(const std::vector<V>& point, const std::vector<std::array<int, 3>>& facets, const Q& r) {
  std::vector<std::pair<int, int>> forward, backward;
  int crossings = 0;
  for (const auto& f : facets) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (f[i] < 0 || f[i] >= static_cast<int>(point.size())) return false;
      forward.emplace_back(f[i], f[(i + 1) % 3]);
      backward.emplace_back(f[(i + 1) % 3], f[i]);
    }
    const auto at = [&](std::size_t i) { return point[static_cast<std::size_t>(f[i])]; };
    const auto more = crossing(at(0), at(1), at(2), {1, Q(1009, 1013), Q(-499, 997)});
    if (!more || !is_clear_of_ball({at(0), at(1), at(2)}, r)) return false;
    crossings += *more;
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return crossings != 0 && forward == backward;
}

}  // namespace

// The points of a pair are near the cores: each may be off by e, which costs e of depth; the hull of their
// differences is then within 2e of the difference of the cores. In a half-space m·x <= o a single point of
// the other body shows the depth: m·x - o <= -(depth - ball + e)·|m|. A point within `near` of a core is
// within near + loose·(its distance from the origin + near) of the true core.
bool shows_depth(const Certificate& c, const Set& a, const Set& b, const Q& loose) {
  double largest = 0;
  for (const auto& [p, q] : c.support_pairs)
    largest = std::max({largest, p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff()});
  const Q near = Q(point_factor) * Q(largest);
  const auto far = [&](const V& o) { return times_root(1, dot(o, o)) + 2 * Q(largest) + near; };
  const Q e = loose > 0 ? Q(near + loose * std::max(far(a.origin), far(b.origin))) : near;
  const bool plane_a = is_half_space(a), plane_b = is_half_space(b);
  std::vector<V> difference;
  for (const auto& [p, q] : c.support_pairs) {
    const V x = exact_value(p), y = exact_value(q);
    if ((!plane_a && !is_within(a, x, near)) || (!plane_b && !is_within(b, y, near))) return false;
    difference.push_back(x - y);
  }
  if (difference.empty() || (plane_a && plane_b)) return false;
  if (plane_a || plane_b) {
    const Set &h = plane_a ? a : b, &other = plane_a ? b : a;
    const V x = exact_value(c.support_pairs[0][plane_a ? 1 : 0]);
    return dot(h.normal, x) - h.offset + times_root(Q(c.offset) - other.ball + e, dot(h.normal, h.normal)) <=
           0;
  }
  const Q depth = Q(c.offset) - a.ball - b.ball + 2 * e;
  if (!c.facets.empty()) return holds_ball(difference, c.facets, std::max(depth, Q(0)));
  const V& v = difference[0];
  return depth <= 0 && dot(v, v) <= depth * depth;
}

bool is_finite(const Certificate& c) {
  return c.direction.allFinite() && std::isfinite(c.offset) && c.point.allFinite() &&
         std::all_of(c.support_pairs.begin(), c.support_pairs.end(),
                     [](const auto& p) { return p[0].allFinite() && p[1].allFinite(); });
}

bool check(const Certificate& c, const Placed& a, const Placed& b) {
  const Sets x = sets_of(a), y = sets_of(b);
  if (x.empty() || y.empty() || !is_finite(c)) return false;
  using K = Certificate::Kind;
  if (c.kind == K::separating_plane) return check_planes(c, x, y) && are_not_nested(a, x, b, y);
  if (c.kind == K::common_point) return check_point(c, a, x, b, y);
  // A mesh is a surface without an interior and has no depth; that of a solid mesh has no certificate.
  if (is_mesh(*a.shape) || is_mesh(*b.shape)) return false;
  if (c.kind == K::depth_direction) return check_direction(exact_value(c.direction), Q(c.offset), x[0], y[0]);
  return c.kind == K::inner_polytope && shows_depth(c, x[0], y[0]);
}

}  // namespace touchstone::checker
