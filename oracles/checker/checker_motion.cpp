// Checks the certificate of a motion: its planes must keep the bodies apart from t = 0 to clear_until, its
// common point must be in both at its time, and two parts must be as deep in each other as it claims, at its
// time.
//
// At a key the plane is checked like any plane, against the bodies turned by exp(tω) up to a proven error. In
// between, a point of a body at r from the body's origin is at z(t) with z' = v + ω×r, |z''| = |ω×(ω×r)|, and
// its height over the moving plane is f(t) = n(t)·z(t) - o(t), n and o linear. So at the fraction λ of the Δt
// between two keys f differs from its chord by at most λ(1-λ)·bend,
//   bend = Δt²/2 · max|f''| <= Δt·|Δn|·(|v| + |ω×r|) + Δt²/2 · max|n|·|ω|·|ω×r|.
// With margins a, b >= 0 at the keys the chord keeps a(1-λ) + bλ >= λ(1-λ)(√a + √b)², by Cauchy and Schwarz;
// bend <= a + b + 2·min(a, b) is a stronger condition, hence sufficient. |ω×r| does not change with time.
// Bodies that do not turn have bend 0 for a constant n: the margins at the keys decide, exactly.
#include <algorithm>

#include "oracles/checker/checker.h"
#include "oracles/checker/checker_set.h"

namespace touchstone::checker {
namespace {

using Z = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

Q length(const V& v) { return times_root(1, dot(v, v)); }
Q on_grid(const Q& x) { return Q(Z(Z(numerator(x) << 256) / denominator(x)), Z(1) << 256); }
V on_grid(const V& v) { return {on_grid(v.x), on_grid(v.y), on_grid(v.z)}; }

/// A body in motion, seen from the origin of B.
struct Mover {
  const Placed& placed;
  V start, velocity, angular;
};

struct Moment {
  std::vector<Set> parts;
  Q loose = 0;  // a point at distance d from the body's origin is within loose·d of its position here
};

// exp(tω) as a quaternion: the series of cosine and sine at 2^-m times the half turn, which is at most 1, to
// 40 terms (the rest is below 1/80! < 2^-390), all rounded to multiples of 2^-256; then squared m times,
// which doubles the error each time: ε < 2^(m-240). Unit quaternions ε apart turn r to points at most 2ε|r|
// apart, and one that is unit within ε represents a unit one within 2ε of the true one: 4ε|r|.
Moment at(const Mover& mover, const Q& t) {
  Carrier by;
  by.shift = mover.start + t * mover.velocity;
  V v = t / 2 * mover.angular;
  if (dot(v, v) == 0) return {sets_of(mover.placed, by), 0};
  unsigned m = 0;
  for (; dot(v, v) > 1; ++m) v = Q(1, 2) * v;
  v = on_grid(v);
  const Q square = on_grid(dot(v, v));
  constexpr int terms = 40;  // of the series, as above
  Q w = 0, sine_over_angle = 0, term = 1;
  for (int k = 0; k < terms; ++k, term = on_grid(-term * square / (2 * k * (2 * k - 1)))) {
    w += term;
    sine_over_angle += on_grid(term / (2 * k + 1));
  }
  v = on_grid(sine_over_angle * v);
  for (unsigned k = 0; k < m; ++k) {
    const Q next = on_grid(w * w - dot(v, v));
    v = on_grid(2 * w * v);
    w = next;
  }
  by.v = v;
  by.w = w;
  return {sets_of(mover.placed, by), Q(Z(1) << m, Z(1) << 238)};
}

// Upper bound over the core of |r|, r from the body's origin, or of |ω×r|.
Q reach(const Set& s, const std::optional<V>& angular = std::nullopt) {
  const auto seen = [&](const V& r) { return angular ? cross(*angular, r) : r; };
  Q most = 0;
  for (const Set::Round& piece : s.core) {
    Q square = 0;
    for (const V& a : piece.axes) square += dot(seen(a), seen(a));
    most = std::max(most, Q(length(seen(piece.centre - s.origin)) + times_root(1, square)));
  }
  return most;
}

// For each part, whether it stays on its side of the moving plane: n·x <= o (side 1) or > (side -1).
std::vector<bool> stays(const ImpactCertificate::Track& track, const Mover& mover, int side) {
  std::vector<bool> good;
  std::vector<Q> spin, margin;
  V n;
  Q t;
  for (std::size_t k = 0; k < track.size(); ++k) {
    const auto& [time, direction, offset] = track[k];
    const V n_before = n;
    const Q t_before = t;
    n = {rational_of(direction[0]), rational_of(direction[1]), rational_of(direction[2])};
    t = Q(time);
    const Moment now = at(mover, t);
    if (k == 0) {
      good.assign(now.parts.size(), true);
      margin.resize(good.size());
      spin.resize(good.size());
    }
    for (std::size_t i = 0; i < now.parts.size(); ++i) {
      const Set& s = now.parts[i];
      const auto top = core_support(s, Q(side) * n);
      const bool turning_half_space = s.core.empty() && dot(mover.angular, mover.angular) != 0;
      good[i] = good[i] && top && !turning_half_space;
      if (!good[i]) continue;
      const Q before = margin[i];
      margin[i] = Q(side) * rational_of(offset) - *top -
                  times_root(s.ball + (now.loose > 0 ? Q(now.loose * reach(s)) : Q(0)), dot(n, n));
      good[i] = side > 0 ? margin[i] >= 0 : margin[i] > 0;
      if (k == 0) spin[i] = reach(s, mover.angular);
      if (k == 0 || !good[i]) continue;
      const Q dt = t - t_before, longest = std::max(length(n), length(n_before));
      const Q bend = dt * length(n - n_before) * (length(mover.velocity) + spin[i]) +
                     dt * dt / 2 * longest * length(mover.angular) * spin[i];
      const Q room = before + margin[i] + 2 * std::min(before, margin[i]);
      good[i] = side > 0 ? bend <= room : bend < room;
    }
  }
  return good;
}

bool covers(const ImpactCertificate::Track& track, double until) {
  const auto later = [](const auto& x, const auto& y) { return !(x.t <= y.t); };
  return !track.empty() && track.front().t == 0 && track.back().t == until && until <= 1 &&
         std::adjacent_find(track.begin(), track.end(), later) == track.end();
}

bool check_apart(const ImpactCertificate& c, const Mover& a, const Mover& b) {
  const std::size_t n = at(a, 0).parts.size(), m = at(b, 0).parts.size();
  std::vector<bool> apart(n * m, false);
  for (const auto& track : c.tracks) {
    if (!covers(track, c.clear_until)) return false;
    const std::vector<bool> below = stays(track, a, 1), above = stays(track, b, -1);
    for (std::size_t i = 0; i < n * m; ++i) apart[i] = apart[i] || (below[i / m] && above[i % m]);
  }
  return n * m > 0 && std::find(apart.begin(), apart.end(), false) == apart.end();
}

// A set that may be turned slightly from its position here contains x if it contains the corners of an
// octahedron about x whose inscribed ball has that radius.
bool holds(const Moment& now, const V& x) {
  return std::any_of(now.parts.begin(), now.parts.end(), [&](const Set& s) {
    const Q w = 2 * now.loose * length(x - s.origin);
    for (const V& e : {V{w, 0, 0}, V{0, w, 0}, V{0, 0, w}})
      if (!is_within(s, x + e, s.ball) || !is_within(s, x - e, s.ball)) return false;
    return true;
  });
}

bool check_contact(const ImpactCertificate::Contact& c, const Mover& a, const Mover& b) {
  const Q t = rational_of(c.t);
  const V x{rational_of(c.point[0]), rational_of(c.point[1]), rational_of(c.point[2])};
  return t >= 0 && t <= 1 && holds(at(a, t), x) && holds(at(b, t), x);
}

bool check_overlap(const ImpactCertificate::Overlap& o, const Mover& a, const Mover& b) {
  if (!(o.t >= 0 && o.t <= 1) || o.inner.kind != Certificate::Kind::inner_polytope) return false;
  const Moment x = at(a, Q(o.t)), y = at(b, Q(o.t));
  if (o.part_a >= x.parts.size() || o.part_b >= y.parts.size()) return false;
  const Set &s = x.parts[o.part_a], &t = y.parts[o.part_b];
  const bool bounded = s.kind != Set::Kind::half_space && t.kind != Set::Kind::half_space;
  return bounded && is_finite(o.inner) && shows_depth(o.inner, s, t, std::max(x.loose, y.loose));
}

V translation_of(const Placed& p) {
  return std::visit([](const auto& pose) { return exact_value(pose.translation); }, p.pose);
}

}  // namespace

bool check(const ImpactCertificate& c, const Placed& a, const Motion& motion_a, const Placed& b,
           const Motion& motion_b) {
  const V seen_from = Q(-1) * translation_of(b), still{0, 0, 0};
  const Mover x{a, seen_from, exact_value(motion_a.linear) - exact_value(motion_b.linear),
                exact_value(motion_a.angular)};
  const Mover y{b, seen_from, still, exact_value(motion_b.angular)};
  if (c.claims_nothing()) return false;
  // Bodies that stay clear of a solid's surface are outside it if they begin outside.
  if (!c.tracks.empty() &&
      (std::holds_alternative<SolidMesh>(*a.shape) || std::holds_alternative<SolidMesh>(*b.shape)) &&
      !are_not_nested(a, at(x, 0).parts, b, at(y, 0).parts))
    return false;
  return (c.tracks.empty() || check_apart(c, x, y)) && (!c.contact || check_contact(*c.contact, x, y)) &&
         (!c.overlap || check_overlap(*c.overlap, x, y));
}

}  // namespace touchstone::checker
