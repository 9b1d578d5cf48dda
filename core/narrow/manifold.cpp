#include "core/narrow/manifold.h"

#include <algorithm>

#include "core/narrow/outline.h"
#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

using Points = std::vector<WideVec>;
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
  Points points;
  void add(const WideVec& p, std::uint32_t) {
    if (at.d.dot(p) >= at.top - at.limit) points.push_back(p);
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

// The support face in the plane's coordinates.
Outline flattened(const Points& face, const Basis& basis, const WideVec& origin) {
  Outline r;
  for (const WideVec& p : face) {
    const Plane2 q = basis.flatten(p - origin);
    r.add({q.x(), q.y(), 0, static_cast<std::uint32_t>(r.size), 0});
  }
  return r;
}

// Crossing segments share a point that the caller has: the deepest.
Outline intersection(Outline a, Outline b, Wide tolerance) {
  if (a.size == 2 && b.size == 2) {
    const outline::EdgePair<Wide> pair(a, b);
    return pair.is_collinear(tolerance) ? pair.common(0) : Outline();
  }
  if (a.size > 2 && b.size == 2) std::swap(a, b);
  outline::clip(a, b, tolerance, false);
  return a;
}

}  // namespace

std::vector<WideVec> support_face(const ConvexCore<Wide>& c, const WideVec& n, Wide tolerance) {
  const WideVec d = c.frame.rotation.transpose() * n;
  const convex::FaceQuery<Wide> at{d, d.dot(support_local<Wide>(c, d)), tolerance, tolerance};
  FacePoints corners{at, {}};
  on_core(c, [&](const auto& core) { core.face_corners(at, corners); });
  Points face;
  for (const WideVec& p : corners.points)
    face.push_back(c.frame.rotation * p + c.frame.translation + c.radius * n);
  Outline flat = flattened(face, Basis(n), WideVec::Zero());
  outline::convex_order(flat, tolerance);
  Points ordered;
  for (const Corner& k : flat) ordered.push_back(face[k.id]);
  return ordered;
}

std::vector<WideVec> contact_points(const ConvexCore<Wide>& a, const ConvexCore<Wide>* b,
                                    const Separation& s) {
  const Wide tolerance = tolerance::manifold_face_factor * s.size;
  const WideVec &n = s.normal, middle = (s.a + s.b) / 2;
  const Basis basis(n);
  Outline region = flattened(support_face(a, n, tolerance), basis, middle);
  if (b) {
    Outline other = flattened(support_face(*b, -n, tolerance), basis, middle);
    std::reverse(other.begin(), other.end());  // counter-clockwise about n as well
    if (region.size < 2 || other.size < 2) return {middle};
    region = intersection(region, other, tolerance);
  }
  drop_repeats(region, tolerance);
  if (region.size == 0) return {middle};
  // Picks points evenly when there are more than the manifold holds.
  Points r;
  const int kept = std::min(region.size, static_cast<int>(Manifold::capacity));
  for (int i = 0; i < kept; ++i) {
    const Corner& p = region[i * region.size / kept];
    r.push_back(middle + basis.u * p.x + basis.v * p.y);
  }
  return r;
}

}  // namespace touchstone::narrow
