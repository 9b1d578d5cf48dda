#include "core/ccd/time_of_impact.h"

#include <cmath>

#include "core/broad/body_box.h"
#include "core/ccd/advancement.h"
#include "core/ccd/sphere_sphere.h"

namespace touchstone {
namespace {

// L over the whole step: extents, coordinates at both ends.
double scale_of(const MovingShape& a, const MovingShape& b) {
  Scene s;
  for (const MovingShape* m : {&a, &b}) {
    Body body;
    body.shape = static_cast<int>(s.shapes.size());
    body.pose = m->pose, body.motion = m->motion;
    s.shapes.push_back(*m->shape);
    s.bodies.push_back(std::move(body));
  }
  return scale_of_pair(s, 0, 1);
}

TimeOfImpact mirrored(TimeOfImpact r) {
  r.normal = -r.normal;
  std::swap(r.witness[0], r.witness[1]);
  return r;
}

// The first triangle to be hit; triangles whose box the swept box of the convex body misses are left out.
TimeOfImpact mesh_impact(const MovingShape& mesh, const MovingShape& convex, double scale) {
  const auto& m = std::get<TriangleMesh>(*mesh.shape);
  const Aabb swept = broad::swept_box(*convex.shape, convex.pose, convex.motion);
  TimeOfImpact first;
  for (const auto& triangle : m.triangles) {
    Hull h;
    for (int k : triangle) h.vertices.push_back(m.vertices[static_cast<std::size_t>(k)]);
    h.dimension = 2;
    const Shape shape = std::move(h);
    if (!overlaps(broad::body_box(shape, mesh.pose), swept)) continue;
    const TimeOfImpact r = advance({&shape, mesh.pose, mesh.motion}, convex, scale);
    const int steps = first.steps + r.steps;
    if (r.outcome != Outcome::answered) {
      first.outcome = r.outcome;
    } else if (r.hit && (!first.hit || r.t < first.t)) {
      const Outcome before = first.outcome;
      first = r;
      first.outcome = before;
    }
    first.steps = steps;
  }
  return first;
}

}  // namespace

TimeOfImpact time_of_impact(const MovingShape& a, const MovingShape& b) {
  const ShapeKind ka = kind_of(*a.shape), kb = kind_of(*b.shape);
  TimeOfImpact unsupported;
  unsupported.outcome = Outcome::unsupported;
  if (ka == kb && (ka == ShapeKind::mesh || ka == ShapeKind::half_space)) return unsupported;
  if ((ka == ShapeKind::mesh && kb == ShapeKind::half_space) ||
      (ka == ShapeKind::half_space && kb == ShapeKind::mesh))
    return unsupported;
  if (ka == ShapeKind::sphere && kb == ShapeKind::sphere) return sphere_sphere_impact(a, b);
  const double scale = scale_of(a, b);
  if (ka == ShapeKind::mesh) return mesh_impact(a, b, scale);
  if (kb == ShapeKind::mesh) return mirrored(mesh_impact(b, a, scale));
  return advance(a, b, scale);
}

}  // namespace touchstone
