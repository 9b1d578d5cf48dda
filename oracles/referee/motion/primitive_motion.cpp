// Finds the first t in [0,1] at which two closed primitives meet. Contact requires that the four points are
// coplanar: their determinant D, a cubic in t, is zero. Unless D is identically zero, only its roots in [0,1]
// are candidates. If D is identically zero, the first contact is at t = 0 or where one of the signs that
// decide contact changes, hence at a root of one of the quadratics below. At a candidate every sign is
// decided exactly (polynomial.h), so the answer is exact: the first candidate at which they meet. Degenerate
// triangles and edges are decided by their edges and end points.
#include "oracles/referee/referee.h"

#include <algorithm>
#include <vector>

#include "core/math/aabb.h"
#include "oracles/referee/exact/polynomial.h"

namespace touchstone::referee {
namespace {

using Points = std::array<Polynomial3, 4>;

Polynomial path(double from, double to) { return Polynomial({exact(from), exact(to) - exact(from)}); }

/// The quadratics of three moving points: (q - p) x (r - p), and for "p is between q and r" the dot product.
Polynomial3 normal_of(const Polynomial3& p, const Polynomial3& q, const Polynomial3& r) {
  return cross(q - p, r - p);
}
Polynomial between(const Polynomial3& p, const Polynomial3& q, const Polynomial3& r) {
  return dot(q - p, r - p);
}

bool vanishes(const Polynomial3& v, const Root& t) {
  return sign_at(v.x, t) == 0 && sign_at(v.y, t) == 0 && sign_at(v.z, t) == 0;
}

/// Index of a coordinate of the vector that is not zero at t; -1 for the zero vector.
int nonzero_coordinate(const Polynomial3& v, const Root& t) {
  for (int k = 0; k < 3; ++k)
    if (sign_at(v[k], t) != 0) return k;
  return -1;
}

bool is_on_segment(const Polynomial3& p, const Polynomial3& q, const Polynomial3& r, const Root& t) {
  return vanishes(normal_of(p, q, r), t) && sign_at(between(p, q, r), t) <= 0;
}

// Precondition of both functions: the four points are coplanar at t.
bool vertex_meets_face(const Points& x, const Root& t) {
  const auto& [v, f, g, h] = x;
  const Polynomial3 n = normal_of(f, g, h);
  const int k = nonzero_coordinate(n, t);
  if (k < 0) return is_on_segment(v, f, g, t) || is_on_segment(v, g, h, t) || is_on_segment(v, h, f, t);
  const int side = sign_at(n[k], t);
  return sign_at(normal_of(v, f, g)[k], t) * side >= 0 && sign_at(normal_of(v, g, h)[k], t) * side >= 0 &&
         sign_at(normal_of(v, h, f)[k], t) * side >= 0;
}

bool edge_meets_edge(const Points& x, const Root& t) {
  const auto& [a, b, c, d] = x;
  const int k = nonzero_coordinate(cross(b - a, d - c), t);
  if (k < 0)
    return is_on_segment(a, c, d, t) || is_on_segment(b, c, d, t) || is_on_segment(c, a, b, t) ||
           is_on_segment(d, a, b, t);
  const auto side = [&](const Polynomial3& p, const Polynomial3& q, const Polynomial3& r) {
    return sign_at(normal_of(p, q, r)[k], t);
  };
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

std::vector<Root> times_of_flat_motion(const Points& x) {
  std::vector<Root> times{{Polynomial({Rational(0), Rational(1)}), Rational(-1), Rational(0), true}};
  const auto add = [&](const Polynomial& p) {
    if (p.is_zero()) return;
    for (Root& r : roots_in_unit_interval(p)) times.push_back(std::move(r));
  };
  const auto add3 = [&](const Polynomial3& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  };
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = j + 1; k < 4; ++k)
        if (i != j && i != k) {
          if (i < j) add3(normal_of(x[i], x[j], x[k]));
          add(between(x[i], x[j], x[k]));
        }
  add3(cross(x[1] - x[0], x[3] - x[2]));
  std::sort(times.begin(), times.end(), [](const Root& a, const Root& b) { return compare(a, b) < 0; });
  return times;
}

std::vector<Root> candidate_times(const Points& x) {
  const Polynomial d = dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]);
  return d.is_zero() ? times_of_flat_motion(x) : roots_in_unit_interval(d);
}

// Paths are straight, so the box of both ends contains a vertex throughout; comparing doubles is exact.
bool boxes_are_apart(PrimitivePair kind, const std::array<Vec3, 4>& start, const std::array<Vec3, 4>& end) {
  const std::size_t split = kind == PrimitivePair::vertex_face ? 1 : 2;
  Aabb first, second;
  for (std::size_t i = 0; i < 4; ++i) {
    Aabb& box = i < split ? first : second;
    box.extend(start[i]);
    box.extend(end[i]);
  }
  return !overlaps(first, second);
}

}  // namespace

PrimitiveTruth judge_primitive_motion(PrimitivePair kind, const std::array<Vec3, 4>& start,
                                      const std::array<Vec3, 4>& end) {
  PrimitiveTruth r;
  if (boxes_are_apart(kind, start, end)) return r;
  Points x;
  for (std::size_t i = 0; i < 4; ++i)
    x[i] = {path(start[i].x(), end[i].x()), path(start[i].y(), end[i].y()), path(start[i].z(), end[i].z())};
  for (const Root& t : candidate_times(x)) {
    if (!(kind == PrimitivePair::vertex_face ? vertex_meets_face(x, t) : edge_meets_edge(x, t))) continue;
    r.collides = true;
    enclose(t, r.t_lo, r.t_hi);
    return r;
  }
  return r;
}

}  // namespace touchstone::referee
