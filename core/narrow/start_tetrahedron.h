// The tetrahedron that an expanding polytope starts from.
#pragma once

#include <span>

#include "core/narrow/simplex.h"

namespace touchstone::narrow {

/// In double: the directions that they make are only tried.
inline constexpr double cosine_of_60 = 0.5, sine_of_60 = 0.86602540378443864676;

/// Extends a point, an edge or a triangle to a tetrahedron by support points of B − A away from the current
/// point, line or plane. Returns false if none is farther away than `thin`: B − A is then flat to within
/// rounding.
/// `w(i)`: corner i of the `size` present ones; `probe(n)`: the Vertex farthest along the unit n; `add(v)`:
/// appends a corner. Precondition: the present corners are farther than `thin` from being degenerate.
template <class R, class Point, class Probe, class Add>
bool grow_to_tetrahedron(int size, R thin, const Point& w, const Probe& probe, const Add& add) {
  const auto add_farthest = [&](std::span<const V3<R>> directions, const auto& distance) {
    R best = thin;
    Vertex<R> chosen;
    for (const V3<R>& m : directions)
      for (const R sign : {R(1), R(-1)}) {
        const Vertex<R> p = probe(V3<R>(sign * m));
        if (const R far = distance(p.w); far > best) {
          best = far;
          chosen = p;
        }
      }
    if (!(best > thin)) return false;
    add(chosen);
    return true;
  };
  if (size == 1) {
    const V3<R> axes[] = {V3<R>::UnitX(), V3<R>::UnitY(), V3<R>::UnitZ()};
    if (!add_farthest(axes, [&](const V3<R>& p) { return (p - w(0)).norm(); })) return false;
    size = 2;
  }
  if (size == 2) {
    const V3<R> e = w(1) - w(0), k = e / e.norm(), x = k.unitOrthogonal(), y = k.cross(x);
    const R c = R(cosine_of_60), h = R(sine_of_60);
    const V3<R> around[] = {x, c * x + h * y, h * y - c * x};
    if (!add_farthest(around, [&](const V3<R>& p) { return k.cross(p - w(0)).norm(); })) return false;
    size = 3;
  }
  if (size == 3) {
    using std::abs;
    const V3<R> n[] = {triangle_normal<R>(w(0), w(1), w(2)).normalized()};
    return add_farthest(n, [&](const V3<R>& p) -> R { return abs(n[0].dot(p - w(0))); });
  }
  return true;
}

}  // namespace touchstone::narrow
