#include "core/narrow/manifold.h"

#include <algorithm>

#include "core/narrow/flat_rims.h"
#include "core/narrow/outline.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

using Plane2 = Eigen::Matrix<Wide, 2, 1>;
using Corner = outline::Corner<Wide>;
using Outline = outline::Corners<Wide>;

struct Basis {
  WideVec u, v;
  explicit Basis(const WideVec& n) : u(n.unitOrthogonal()), v(n.cross(u)) {}
  Plane2 flatten(const WideVec& p) const { return {u.dot(p), v.dot(p)}; }
};

// Collects the corners that lie in the support face to within the tolerance.
struct FacePoints {
  const convex::FaceQuery<Wide>& at;
  std::vector<ManifoldVertex> points;  // in the core's frame
  void add(const WideVec& p, std::uint32_t id) {
    if (at.d.dot(p) >= at.top - at.limit) points.push_back({p, id});
  }
  void add_certain(const WideVec& p, std::uint32_t id) { add(p, id); }
  void add_many(const WideVec& p, std::uint32_t id) { add(p, id); }
};

void drop_repeats(Outline& p, Wide tolerance) {
  Outline kept;
  for (const Corner& x : p)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Corner& k) { return Plane2(k.x - x.x, k.y - x.y).norm() <= tolerance; }))
      kept.add(x);
  p = kept;
}

// The support face along n in the plane's coordinates, in convex order about the plane's normal; and the rim
// that bounds it.
struct Face {
  Outline outline;
  std::optional<outline::Circle<Wide>> rim;
};

Face face_along(const ConvexCore<Wide>& c, const WideVec& n, Wide tolerance, const Basis& basis,
                const WideVec& origin) {
  const WideVec d = c.frame.rotation.transpose() * n;
  const convex::FaceQuery<Wide> at{d, d.dot(support_local<Wide>(c, d)), tolerance, tolerance};
  const auto flatten = [&](const WideVec& p) {
    return basis.flatten(c.frame.rotation * p + c.frame.translation + c.radius * n - origin);
  };
  FacePoints corners{at, {}};
  on_core(c, [&](const auto& core) { core.face_corners(at, corners); });
  Face r;
  for (const ManifoldVertex& v : corners.points) {
    const Plane2 q = flatten(v.p);
    r.outline.add({q.x(), q.y(), 0, v.id, 0});
  }
  outline::convex_order(r.outline, tolerance);
  if (const auto rim = on_core(c, [&](const auto& core) { return outline::flat_rim(core, at); })) {
    const Plane2 centre = flatten(rim->first);
    r.rim = {centre.x(), centre.y(), rim->second};
  }
  return r;
}

Wide edge_radius(const ConvexCore<Wide>& c) {
  return c.radius + on_core(c, [](const auto& core) { return outline::side_radius(core); });
}

// What two edges have in common, on the line of the one that is less rounded; `radius`: of the other. A
// surface of this radius is s²/(2·radius) lower at s beside its top, and the normal of a search is as exact
// as that asks.
Outline common_edge(Outline on, const Outline& other, Wide tolerance, Wide radius, std::uint32_t id) {
  if (on[1].id < on[0].id) std::swap(on[0], on[1]);  // the first end keeps its id
  const outline::EdgePair<Wide> pair(on, other);
  return pair.is_collinear(std::max<Wide>(tolerance, sqrt(2 * radius * tolerance))) ? pair.common(id)
                                                                                    : Outline();
}

// Crossing segments share a point that the caller has: the deepest.
Outline intersection(Outline a, Outline b, Wide tolerance, Wide radius_a, Wide radius_b) {
  if (a.size == 2 && b.size == 2) {
    const std::uint32_t id = outline::id_of_edges(a, b);
    return radius_a <= radius_b ? common_edge(a, b, tolerance, radius_b, id)
                                : common_edge(b, a, tolerance, radius_a, id);
  }
  const bool exchanged = a.size > 2 && b.size == 2;
  if (exchanged) std::swap(a, b);
  outline::clip(a, b, tolerance, exchanged);
  return a;
}

// Of the point where the outlines meet, if it is the only one.
std::uint32_t id_of_middle(const Outline& a, const Outline& b) {
  if (a.size == 1 && b.size > 2) return a[0].id | outline::of_a;
  if (a.size > 2 && b.size == 1) return b[0].id | outline::of_b;
  return a.size == 2 && b.size == 2 ? outline::id_of_edges(a, b) : 0;
}

}  // namespace

std::vector<ManifoldVertex> contact_points(const ConvexCore<Wide>& a, const ConvexCore<Wide>* b,
                                           const Separation& s) {
  const Wide tolerance = tolerance::manifold_face_factor * s.size;
  const WideVec &n = s.normal, middle = (s.a + s.b) / 2;
  const Basis basis(n);
  const Face of_a = face_along(a, n, tolerance, basis, middle);
  Outline region = of_a.outline;
  std::uint32_t id = 0;  // of the middle
  if (b) {
    const Face of_b = face_along(*b, -n, tolerance, basis, middle);
    const Outline& other = of_b.outline;
    id = id_of_middle(region, other);
    if (region.size < 2 || other.size < 2) return {{middle, id}};
    region = intersection(region, other, tolerance, edge_radius(a), edge_radius(*b));
    if (of_a.rim || of_b.rim)
      outline::complete_rims(of_a.outline, of_a.rim, other, of_b.rim, tolerance, region);
  } else {
    for (Corner& c : region) c.id |= outline::of_a;
  }
  drop_repeats(region, tolerance);
  if (region.size == 0) return {{middle, id}};
  // Picks points evenly when there are more than the manifold holds.
  std::vector<ManifoldVertex> r;
  const int kept = std::min(region.size, static_cast<int>(Manifold::capacity));
  for (int i = 0; i < kept; ++i) {
    const Corner& p = region[i * region.size / kept];
    r.push_back({middle + basis.u * p.x + basis.v * p.y, p.id});
  }
  return r;
}

}  // namespace touchstone::narrow
