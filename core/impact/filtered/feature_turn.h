// The angular velocity of the direction between the nearest features.
#pragma once

#include "core/impact/filtered/look.h"
#include "core/tolerance.h"

namespace touchstone::impact::filtered {

namespace detail {

inline int distinct(const std::array<Vec, 4>& p, int size) {
  int n = 0;
  for (int i = 0; i < size; ++i) {
    bool seen = false;
    for (int k = 0; k < i; ++k) seen |= p[static_cast<std::size_t>(k)] == p[static_cast<std::size_t>(i)];
    n += !seen;
  }
  return n;
}

/// The box, if the pair is a point and a box: its faces and edges carry the direction along, and for its
/// corners that is no worse.
inline const Mover* box_of_point(const Sweep& w) {
  if (is_point(w.a()) && box_core(w.b())) return &w.b();
  return is_point(w.b()) && box_core(w.a()) ? &w.a() : nullptr;
}

/// From the first point to the first one that differs from it.
inline Vec edge(const std::array<Vec, 4>& p, int size) {
  for (int i = 1; i < size; ++i)
    if (p[static_cast<std::size_t>(i)] != p[0]) return p[static_cast<std::size_t>(i)] - p[0];
  return Vec::Zero();
}

}  // namespace detail

/// Ω of follow.h: a face or a single edge carries the direction along; two edges e, f rotate it as they
/// rotate e×f; corners leave it fixed.
inline Vec feature_turn(const Sweep& w, const Spot& x, const Features& f, const Vec& n) {
  if (const Mover* box = detail::box_of_point(w)) return box->angular;
  const int a = detail::distinct(f.a, f.size), b = detail::distinct(f.b, f.size);
  if (a >= 3 || (a == 2 && b < 2)) return w.a().angular;
  if (b >= 3 || (b == 2 && a < 2)) return w.b().angular;
  if (a < 2) return Vec::Zero();
  const Vec e = x.ra * detail::edge(f.a, f.size), g = x.rb * detail::edge(f.b, f.size), c = e.cross(g);
  const double length_sq = c.squaredNorm();
  if (!(length_sq > tolerance::parallel_sine_sq * e.squaredNorm() * g.squaredNorm())) return w.a().angular;
  const Vec change = w.a().angular.cross(e).cross(g) + e.cross(w.b().angular.cross(g));
  const double side = n.dot(c) < 0 ? -1 : 1;
  return n.cross(change) * (side / std::sqrt(length_sq));
}

}  // namespace touchstone::impact::filtered
