// The checker's own model of a scene: exact sets in rationals. It shares no code, in either direction, with
// what finds certificates.
//
// Every bounded convex piece is the hull of a few round pieces, core = conv ∪ {centre + Σ u_k·axis_k, |u| <=
// 1}, plus a ball: a box is eight points, a capsule two points and a ball, a cylinder two discs, a cone a
// disc and a point. So one formula gives every support value: h(n) = max (centre·n + √Σ(axis_k·n)²) +
// ball·|n|.
#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <optional>
#include <vector>

#include "scenarios/value/certificate.h"

namespace touchstone::checker {

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

/// factor·√square, rounded up: exact when the root is rational, else within 2^-512 of it (relative).
Q times_root(const Q& factor, const Q& square);

/// Throws InputError for anything other than "n" or "n/d".
Q rational_of(const std::string& s);

struct Set {
  enum class Kind { hull, discs, ellipsoid, half_space };
  struct Round {
    V centre;
    std::vector<V> axes;
  };
  Kind kind = Kind::hull;
  std::vector<Round> core;
  Q ball = 0;
  V column[3], origin;  // world = Σ column[i]·local[i] + origin
  V size;               // discs: (radius below, radius above, half height); ellipsoid: semi-axes
  V normal;             // half_space: normal·x <= offset, in the world
  Q offset = 0;
};
/// A rigid motion x -> R(q)x + shift about each body's own origin; q = (v, w) is any non-zero quaternion.
struct Carrier {
  V v{0, 0, 0};
  Q w = 1;
  V shift{0, 0, 0};
};
/// The placed body, moved by `by`. A mesh yields its triangles, any other shape one set. Empty when the
/// placement is singular and leaves no such set.
std::vector<Set> sets_of(const Placed& p, const Carrier& by = {});

/// h(n) of the core, rounded up (times_root). nullopt where it is infinite (half-space).
std::optional<Q> core_support(const Set& s, const V& n);
/// True only if x is within r of the core; exact for hulls, and for the other sets when r = 0.
bool is_within(const Set& s, const V& x, const Q& r);
/// Whether all its doubles are finite.
bool is_finite(const Certificate& c);
/// Whether an inner polytope (checker.h) shows that a and b are at least c.offset deep in each other. The
/// true sets may be turned slightly relative to a and b: a point at distance d from the body's origin is
/// within loose·d of its position here.
bool shows_depth(const Certificate& c, const Set& a, const Set& b, const Q& loose = 0);
/// +1 or -1 where the ray from the origin leaves or enters through the triangle, 0 where it misses the
/// triangle, nullopt where it meets an edge.
std::optional<int> crossing(const V& a, const V& b, const V& c, const V& ray);
/// Whether the point is inside the closed surface that the triangles form; nullopt: each ray tried meets an
/// edge.
std::optional<bool> is_enclosed(const std::vector<Set>& triangles, const V& x);
/// Certainly, for sets of which no two share a point, those of each body: neither body is inside the other,
/// where a solid mesh has an inside.
bool are_not_nested(const Placed& a, const std::vector<Set>& sets_a, const Placed& b,
                    const std::vector<Set>& sets_b);
/// Whether the triangle does not hold the origin and is nowhere within less than r of it.
bool is_clear_of_ball(const std::array<V, 3>& triangle, const Q& r);

}  // namespace touchstone::checker
