#include <algorithm>

#include "core/math/roundoff.h"
#include "core/narrow/convex_pair.h"
#include "core/narrow/mesh.h"
#include "core/narrow/mesh_pairs.h"
#include "core/narrow/unit_scale.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

// The least gap of these pairs. A bound in doubles is lowered by the displacement it does not include.
Separation least_of(const TrianglePairs& found, const MeshScene& m, const WideFrame& fa,
                    const WideFrame& fb) {
  Separation best;
  best.gap = infinity;
  Outcome worst = Outcome::answered;
  for (const TrianglePair& p : found.pairs) {
    if (p.lo - m.displacement > best.gap) break;
    const auto a = corners(m.a, static_cast<std::size_t>(p.a)),
               b = corners(m.b, static_cast<std::size_t>(p.b));
    const Separation s = separate_convex(vertices_core(a, fa), vertices_core(b, fb));
    if (s.outcome != Outcome::answered) worst = s.outcome;
    if (s.gap < best.gap) best = s;
  }
  best.outcome = worst;
  return best;
}

Separation brought_to_unit_size(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b,
                                const WideFrame& fb, double size) {
  const int e = -std::ilogb(size);
  const Shape shape_a = scaled(*a.shape, e), shape_b = scaled(*b.shape, e);
  Separation s = mesh_mesh(shape_a, {fa.rotation, scaled(fa.translation, e)}, shape_b,
                           {fb.rotation, scaled(fb.translation, e)});
  for (Wide* x : {&s.gap, &s.slack, &s.local_slack, &s.size}) *x = ldexp(*x, -e);
  s.a = scaled(s.a, -e);
  s.b = scaled(s.b, -e);
  return s;
}

}  // namespace

Separation mesh_mesh(const ShapeRef& a, const WideFrame& fa, const ShapeRef& b, const WideFrame& fb) {
  const WideMat to_a = fa.rotation.transpose();
  const MeshScene m(a, b, (to_a * fb.rotation).cast<double>(),
                    (to_a * (fb.translation - fa.translation)).cast<double>());
  const double most = m.largest_length();
  if (most > 0 && !m.in_range()) return brought_to_unit_size(a, fa, b, fb, most);
  const double touching = static_cast<double>(tolerance::narrow_contact_factor * m.size());
  return least_of(triangle_pairs(m, PairsWanted::nearest, 2 * (m.displacement + touching)), m, fa, fb);
}

}  // namespace touchstone::narrow
