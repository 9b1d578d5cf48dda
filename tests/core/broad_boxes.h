// Boxes and a reference for broad-phase tests: boxes that stress rounding, cells and sort orders.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core/broad/broad_phase.h"
#include "core/math/rng.h"

namespace touchstone::test {

enum class BoxKind { random, lattice, ulp, tiny, huge, sizes, wild, flat_world };
inline constexpr int box_kinds = 8;

inline double coordinate(Rng& r, BoxKind kind) {
  const double u = r.uniform(-3, 3);
  const auto whole = static_cast<double>(r.below(7)) - 3;
  const auto steps = static_cast<int>(r.below(5)) - 2;
  switch (kind) {
    case BoxKind::random:
    case BoxKind::sizes:
    case BoxKind::flat_world:
      return u;
    case BoxKind::lattice:
      return whole == 0 && steps < 0 ? -0.0 : whole;
    case BoxKind::ulp: {  // a lattice whose points are moved by ulps of double or of float
      double x = whole + 0.1;
      for (int k = 0; k < std::abs(steps); ++k) x = std::nextafter(x, steps * 1e9);
      return u > 2 ? static_cast<double>(std::nextafter(static_cast<float>(x), 1e9F)) : x;
    }
    case BoxKind::tiny:  // denormals of double and float, and zeros of both signs
      return u > 1 ? whole * 0x1p-1074 : u > -1 ? whole * 0x1p-149 + steps * 0x1p-1074 : whole * -0.0;
    case BoxKind::huge:
      return u > 0 ? whole * 0x1p126 * (1 + steps * 0x1p-52) : whole * 0x1p1020;
    case BoxKind::wild:
      break;
  }
  return r.chance(0.2) ? (u > 0 ? 1 : -1) * std::numeric_limits<double>::infinity() : u * 1e3;
}

inline Aabb make_box(Rng& r, BoxKind kind) {
  Aabb b;
  for (int k = 0; k < 3; ++k) {
    const double x = coordinate(r, kind), y = coordinate(r, kind);
    const double size = r.uniform(0, 1);
    const bool large = r.chance(0.03), point = r.chance(0.05);
    b.lo[k] = std::min(x, y);
    b.hi[k] = std::max(x, y);
    if (kind == BoxKind::random || kind == BoxKind::sizes) b.hi[k] = b.lo[k] + size;
    if (kind == BoxKind::sizes && large) b.hi[k] = b.lo[k] + 50 * size;
    if (kind == BoxKind::flat_world && k < 2) b.lo[k] = b.hi[k] = 1;
    if (point) b.hi[k] = b.lo[k];
  }
  return b;
}

/// The definition: closed boxes in double, a double loop.
class Reference {
 public:
  struct Body {
    Aabb box;
    bool fixed = false;
  };
  std::map<int, Body> bodies;
  std::vector<broad::IdPair> pairs() const {
    std::vector<broad::IdPair> out;
    for (auto a = bodies.begin(); a != bodies.end(); ++a)
      for (auto b = std::next(a); b != bodies.end(); ++b)
        if (!(a->second.fixed && b->second.fixed) && overlaps(a->second.box, b->second.box))
          out.push_back({a->first, b->first});
    return out;
  }
};

}  // namespace touchstone::test
