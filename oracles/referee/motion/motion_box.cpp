// Boxes of bodies in motion, rounded outward.
#include <algorithm>

#include "core/math/roundoff.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/motion/motion.h"
#include "oracles/referee/solid/solid.h"

namespace touchstone::referee {

Aabb box_over(const Mover& m, const Vec3& origin) {
  if (!m.spins()) return box_of(m.swept(0, 1, origin).body);
  Solid whole = m.orbit(0, origin).body;
  const Real3 v = m.velocity();
  add_sweep(whole, v, value_rounding * largest(v));
  const Aabb coarse = box_of(whole);
  // Slices of time: each core point is within ρ|ω|·(half a slice) of its position in the middle of the slice.
  constexpr int slices = 64;
  const Real turn =
      m.at(0, origin).body.spin_radius * norm(m.angular()) / (2 * slices) * (1 + projection_rounding);
  Aabb fine;
  for (int i = 0; i < slices; ++i) {
    Solid b = m.at((i + 0.5) / slices, origin).body;
    const Real3 step = (1.0L / slices) * v;
    for (Real3& p : b.points) p = p - 0.5L * step;
    b.centre = b.centre - 0.5L * step;
    b.extent += largest(step) * 2;
    add_sweep(b, step, dot_rounding * largest(v));
    b.error += turn;
    fine.extend(box_of(b));
  }
  return {fine.lo.cwiseMax(coarse.lo), fine.hi.cwiseMin(coarse.hi)};
}

Aabb outer_box(const Placed& a, const Motion& motion) {
  if (is_solid(a)) return outer_box(*AsSurface(a), motion);
  if (std::holds_alternative<HalfSpace>(*a.shape)) {
    const bool rests = motion.linear.isZero(0) && motion.angular.isZero(0);
    return rests ? outer_box(a) : Aabb{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  }
  if (!std::holds_alternative<TriangleMesh>(*a.shape))
    return box_over(Mover(a, motion, Vec3::Zero(), std::nullopt), Vec3::Zero());
  Aabb box;
  for (std::size_t i = 0; i < std::get<TriangleMesh>(*a.shape).triangles.size(); ++i)
    box.extend(box_over(Mover(a, motion, Vec3::Zero(), i), Vec3::Zero()));
  return box;
}

}  // namespace touchstone::referee
