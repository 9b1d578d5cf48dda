// Decides whether the moving difference polygon (primitive_polygon.h) contains the origin at some t in [0,1],
// and when first. Contact requires the origin to lie in the plane of the polygon: the determinant of three
// corners, a cubic in t, is zero. Unless the cubic vanishes identically, its roots are the only candidates.
// If it does, the origin always lies in that plane, and contact begins at t = 0 or where one of the
// quadratics below changes sign. At a candidate, the origin is in the polygon if it is on no edge's outer
// side, as seen along a coordinate axis that is not in the plane. A polygon that has collapsed into a line is
// the union of its edges. All coordinates are scaled to integers by one power of two, and every sign is exact
// (exact_root.h). Bits: a corner 54 more than the spread of exponents, the cubic three times that, a
// remainder sequence twenty times the cubic. Termination: the candidates are finitely many, and each is
// decided.
#include "core/impact/primitive_volume.h"

#include <cmath>
#include <limits>

#include "core/impact/exact_root.h"

namespace touchstone::impact {
namespace {

using Poly = IntegerPolynomial;
using PolyVec = std::array<Poly, 3>;

Poly dot(const PolyVec& a, const PolyVec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
PolyVec cross(const PolyVec& a, const PolyVec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
PolyVec operator-(const PolyVec& a, const PolyVec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Exponent of the lowest bit that may be set in a double.
int lowest_exponent(double x) { return x == 0 ? std::numeric_limits<int>::max() : std::ilogb(x) - 52; }

Integer scaled(double x, int unit_exponent) {
  if (x == 0) return Integer();
  const int e = lowest_exponent(x);
  return Integer(static_cast<std::int64_t>(std::ldexp(x, -e)))
      .shifted(static_cast<unsigned>(e - unit_exponent));
}

struct ExactPolygon {
  std::vector<PolyVec> corner;  // in cyclic order
  std::vector<PolyVec> side;    // corner × next corner
  std::vector<Poly> along;      // corner · next corner
  PolyVec normal;
};

ExactPolygon exact_polygon(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                           const std::array<Vec3, 4>& end) {
  int unit = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k)
      unit = std::min({unit, lowest_exponent(start[i][k]), lowest_exponent(end[i][k])});
  std::array<PolyVec, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      const Integer from = scaled(start[i][k], unit), to = scaled(end[i][k], unit);
      x[i][static_cast<std::size_t>(k)] = Poly({from, to - from});
    }
  ExactPolygon p;
  if (kind == PrimitiveKind::vertex_face)
    p.corner = {x[0] - x[1], x[0] - x[2], x[0] - x[3]};
  else
    p.corner = {x[2] - x[0], x[2] - x[1], x[3] - x[1], x[3] - x[0]};
  const std::size_t m = p.corner.size();
  for (std::size_t k = 0; k < m; ++k) {
    p.side.push_back(cross(p.corner[k], p.corner[(k + 1) % m]));
    p.along.push_back(dot(p.corner[k], p.corner[(k + 1) % m]));
  }
  p.normal = cross(p.corner[1] - p.corner[0], p.corner[m - 1] - p.corner[0]);
  return p;
}

// Precondition: at the root, the origin lies in the plane of the polygon.
bool holds_origin(const ExactPolygon& p, const Poly& of, const DyadicInterval& root) {
  const auto sign = [&](const Poly& q) { return sign_at_root(of, root, q); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int facing = sign(p.normal[axis]);
    if (facing == 0) continue;
    for (const PolyVec& s : p.side)
      if (sign(s[axis]) * facing < 0) return false;
    return true;
  }
  for (std::size_t k = 0; k < p.side.size(); ++k)
    if (sign(p.along[k]) <= 0 && sign(p.side[k][0]) == 0 && sign(p.side[k][1]) == 0 &&
        sign(p.side[k][2]) == 0)
      return true;
  return false;
}

std::vector<Poly> candidates(const ExactPolygon& p) {
  const Poly volume = dot(p.corner[0], cross(p.corner[1], p.corner.back()));
  if (!volume.is_zero()) return {volume};
  std::vector<Poly> all{Poly({Integer(0), Integer(1)})};
  const auto add = [&](const Poly& q) {
    if (!q.is_zero()) all.push_back(q);
  };
  for (const Poly& q : p.normal) add(q);
  for (const Poly& q : p.along) add(q);
  for (const PolyVec& s : p.side)
    for (const Poly& q : s) add(q);
  return all;
}

const Poly& from_start() {
  static const Poly p({Integer(0), Integer(1)});
  return p;
}
const Poly& to_end() {
  static const Poly p({Integer(1), Integer(-1)});
  return p;
}

struct Question {
  ExactPolygon polygon;
  double clear_until = 0;
  bool narrow = false;
};

// The first root of `of` in the window at which there is contact.
ExactImpact first_contact(const Question& q, const Poly& of, const DyadicInterval& window) {
  ExactImpact r;
  for (const DyadicInterval& root : isolated_roots(of, window)) {
    if (sign_at_root(of, root, from_start()) < 0 || sign_at_root(of, root, to_end()) < 0) continue;
    if (!holds_origin(q.polygon, of, root)) continue;
    r.collides = true;
    r.t_below = q.clear_until;
    if (q.narrow) r.t_below = std::max(r.t_below, below(narrowed(of, root)));
    return r;
  }
  return r;
}

// The window where contact is most likely, in units of 2^-60: from 2^-40 before to 2^-20 after the time
// reached.
DyadicInterval near_window(double t) {
  const Integer at(static_cast<std::int64_t>(std::ldexp(t, 60)));
  return {at - Integer(std::int64_t{1} << 20), at + Integer(std::int64_t{1} << 40), 60};
}

}  // namespace

ExactImpact decide_exactly(PrimitiveKind kind, const std::array<Vec3, 4>& start,
                           const std::array<Vec3, 4>& end, double clear_until, bool narrow) {
  Question q{exact_polygon(kind, start, end), clear_until, narrow};
  const DyadicInterval near = near_window(clear_until), rest{near.hi, Integer(std::int64_t{1} << 61), 60};
  const std::vector<Poly> all = candidates(q.polygon);
  if (all.size() == 1) {
    const ExactImpact r = first_contact(q, all[0], near);
    if (r.collides) return r;
    q.narrow = true;
    return first_contact(q, all[0], rest);
  }
  ExactImpact best;
  q.narrow = true;
  for (const Poly& of : all) {
    const ExactImpact r = first_contact(q, of, {near.lo, rest.hi, 60});
    if (r.collides && (!best.collides || r.t_below < best.t_below)) best = r;
  }
  return best;
}

}  // namespace touchstone::impact
