// The checker's own picture of a scene: exact sets in rationals and signs of sums of square roots. Nothing
// here is used by what finds certificates, and nothing of that is used here.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <optional>
#include <vector>

#include "oracles/referee/referee.h"

namespace touchstone::referee::checker {

using Q = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
struct V {
  Q x, y, z;
};
inline V operator+(const V& a, const V& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(const V& a, const V& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator*(const Q& s, const V& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Q dot(const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(const V& a, const V& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline V exact_value(const Vec3& v) { return {Q(v.x()), Q(v.y()), Q(v.z())}; }

/// rational + Σ factor·√square, squares >= 0.
struct Sum {
  Q rational;
  struct Root {
    Q factor, square;
  };
  std::vector<Root> roots;
};
Sum operator+(Sum a, const Sum& b);
/// One-sided: true only when it is so. With two or more different irrational roots and a sum within 2^-4000
/// of zero it says false.
bool is_at_most_zero(const Sum& s, bool strictly);

/// A convex piece of a body where it stands.
struct Set {
  enum class Kind { points, cylinder, cone, ellipsoid, half_space };
  Kind kind = Kind::points;
  std::vector<V> points;  // hull of these, plus a ball
  Q ball = 0;
  V column[3];  // others: world = Σ column[i]·local[i] + centre
  V centre;
  V size;    // (radius, half height, -) or semi-axes
  V normal;  // half_space: normal·x <= offset, in the world
  Q offset = 0;
};
/// A mesh is its triangles, anything else one set. Empty when the placement leaves no such set (singular).
std::vector<Set> sets_of(const Placed& p);

/// The support value h(n) is the largest of these. Not for a half-space.
std::vector<Sum> support_values(const Set& s, const V& n);
bool contains(const Set& s, const V& x);
/// x is within e of the set without its ball. Not for a half-space.
bool is_near_core(const Set& s, const V& x, const Q& e);
/// The nearest point of a hull to the origin.
V nearest_to_origin(const std::vector<V>& hull);

}  // namespace touchstone::referee::checker
