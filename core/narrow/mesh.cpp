#include "core/narrow/mesh.h"

#include <algorithm>
#include <limits>

#include "core/narrow/convex_pair.h"

namespace touchstone::narrow {
namespace {

// Covers the roundings of a box's distance, of the centre and of the radius, each a few 2⁻⁶³ of the terms.
constexpr Wide box_rounding = 0x1p-56;

}  // namespace

std::vector<Vec3> used_vertices(const TriangleMesh& m) {
  std::vector<bool> used(m.vertices.size(), false);
  for (const auto& t : m.triangles)
    for (int k : t) used[static_cast<std::size_t>(k)] = true;
  std::vector<Vec3> r;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) r.push_back(m.vertices[i]);
  return r;
}

std::array<Vec3, 3> corners(const TriangleMesh& m, std::size_t triangle) {
  const auto& t = m.triangles[triangle];
  return {m.vertices[static_cast<std::size_t>(t[0])], m.vertices[static_cast<std::size_t>(t[1])],
          m.vertices[static_cast<std::size_t>(t[2])]};
}

std::vector<TriangleBound> triangles_near(const TriangleMesh& m, const WideVec& centre, Wide radius,
                                          Wide bound) {
  std::vector<TriangleBound> r;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const auto c = corners(m, i);
    const WideVec lo = c[0].cwiseMin(c[1]).cwiseMin(c[2]).cast<Wide>();
    const WideVec hi = c[0].cwiseMax(c[1]).cwiseMax(c[2]).cast<Wide>();
    const Wide d = (centre.cwiseMax(lo).cwiseMin(hi) - centre).norm();
    const Wide safe = d - radius - box_rounding * (d + radius + centre.norm());
    if (safe <= bound) r.push_back({safe, i});
  }
  std::sort(r.begin(), r.end(), [](const TriangleBound& x, const TriangleBound& y) {
    return x.distance != y.distance ? x.distance < y.distance : x.triangle < y.triangle;
  });
  return r;
}

Separation core_mesh(const ConvexCore<Wide>& a, const TriangleMesh& mesh, const WideFrame& frame) {
  const WideVec centre = frame.rotation.transpose() * (a.frame.translation - frame.translation);
  Separation best;
  best.gap = std::numeric_limits<Wide>::infinity();
  Outcome worst = Outcome::answered;
  for (const TriangleBound& t : triangles_near(mesh, centre, a.reach + a.radius, best.gap)) {
    // Every triangle that may be hit is tested, so that the deepest is found.
    if (t.distance > std::max<Wide>(best.gap, 0)) break;
    const auto c = corners(mesh, t.triangle);
    const Separation s = separate_convex(a, vertices_core(c, frame));
    if (s.outcome != Outcome::answered) worst = s.outcome;
    if (s.gap < best.gap) best = s;
  }
  best.outcome = worst;
  return best;
}

}  // namespace touchstone::narrow
