// Shapes of about unit size for tests and benches.
#pragma once

#include "core/math/rng.h"
#include "core/shape/shape.h"

namespace touchstone::test {

/// Every size is uniform in [0.3, 1]. Kinds that are not simple convex ones become `hull(r, size)`.
template <class MakeHull>
Shape plain_shape(Rng& r, ShapeKind kind, MakeHull&& hull) {
  const auto size = [&] { return r.uniform(0.3, 1); };
  switch (kind) {
    case ShapeKind::sphere:
      return Sphere{size()};
    case ShapeKind::box:
      return Box{{size(), size(), size()}};
    case ShapeKind::capsule:
      return Capsule{size() / 2, size()};
    case ShapeKind::cylinder:
      return Cylinder{size(), size()};
    case ShapeKind::cone:
      return Cone{size(), size()};
    case ShapeKind::ellipsoid:
      return Ellipsoid{{size(), size(), size()}};
    default:
      return hull(r, size);
  }
}

}  // namespace touchstone::test
