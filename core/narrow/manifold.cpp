#include "core/narrow/manifold.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tolerance.h"

namespace touchstone::narrow {
namespace {

using Points = std::vector<WideVec>;
using Plane2 = Eigen::Matrix<Wide, 2, 1>;
using Polygon = std::vector<Plane2>;

Wide cross2(const Plane2& a, const Plane2& b) { return a.x() * b.y() - a.y() * b.x(); }

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

// Andrew's monotone chain; drops points on edges. Returns indices into p.
std::vector<std::size_t> convex_order(const Polygon& p, Wide tolerance) {
  std::vector<std::size_t> order(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return p[i].x() != p[j].x() ? p[i].x() < p[j].x() : p[i].y() < p[j].y();
  });
  std::vector<std::size_t> chain;
  const auto add = [&](std::size_t i, std::size_t floor) {
    while (chain.size() >= floor + 2) {
      const Plane2 e = p[chain.back()] - p[chain[chain.size() - 2]], f = p[i] - p[chain[chain.size() - 2]];
      if (cross2(e, f) > tolerance * f.norm()) break;
      chain.pop_back();
    }
    chain.push_back(i);
  };
  for (std::size_t i : order) add(i, 0);
  const std::size_t lower = chain.size() - 1;
  for (std::size_t k = order.size() - 1; k-- > 0;) add(order[k], lower);
  if (chain.size() > 1) chain.pop_back();
  return chain;
}

Polygon clip(const Polygon& subject, const Polygon& window, Wide tolerance) {
  Polygon in = subject;
  for (std::size_t i = 0; i < window.size() && !in.empty(); ++i) {
    const Plane2 &w0 = window[i], e = window[(i + 1) % window.size()] - w0;
    const auto side = [&](const Plane2& p) {
      const Wide d = cross2(e, p - w0) / e.norm();
      return abs(d) <= tolerance ? Wide(0) : d;
    };
    Polygon out;
    const std::size_t n = in.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Plane2 &p = in[k], &q = in[(k + 1) % n];
      const Wide sp = side(p), sq = side(q);
      if (sp >= 0) out.push_back(p);
      if (sp * sq < 0) out.push_back(p + (q - p) * (sp / (sp - sq)));
    }
    in = std::move(out);
  }
  return in;
}

// Overlap of two segments: an interval when they are collinear, otherwise nothing (their crossing is the
// deepest point, which the caller has).
Polygon overlap_of_segments(const Polygon& a, const Polygon& b, Wide tolerance) {
  const Plane2 d = a[1] - a[0];
  const Wide length = d.norm();
  const auto off = [&](const Plane2& p) { return abs(cross2(d, p - a[0])) / length; };
  if (off(b[0]) > tolerance || off(b[1]) > tolerance) return {};
  Wide t0 = d.dot(b[0] - a[0]) / length, t1 = d.dot(b[1] - a[0]) / length;
  if (t0 > t1) std::swap(t0, t1);
  const Wide lo = std::max<Wide>(t0, 0), hi = std::min(t1, length);
  if (lo > hi) return {};
  return {a[0] + d * (lo / length), a[0] + d * (hi / length)};
}

void drop_repeats(Polygon& p, Wide tolerance) {
  Polygon kept;
  for (const Plane2& x : p)
    if (std::none_of(kept.begin(), kept.end(), [&](const Plane2& k) { return (k - x).norm() <= tolerance; }))
      kept.push_back(x);
  p = std::move(kept);
}

}  // namespace

std::vector<WideVec> support_face(const ConvexCore<Wide>& c, const WideVec& n, Wide tolerance) {
  const WideVec d = c.frame.rotation.transpose() * n;
  const convex::FaceQuery<Wide> at{d, d.dot(support_local<Wide>(c, d)), tolerance, tolerance};
  FacePoints corners{at, {}};
  on_core(c, [&](const auto& core) { core.face_corners(at, corners); });
  Points face;
  const Basis basis(n);
  Polygon flat;
  for (const WideVec& p : corners.points) {
    face.push_back(c.frame.rotation * p + c.frame.translation + c.radius * n);
    flat.push_back(basis.flatten(face.back()));
  }
  if (face.size() < 2) return face;
  Points ordered;
  for (std::size_t i : convex_order(flat, tolerance)) ordered.push_back(face[i]);
  if (ordered.size() == 2 && (ordered[0] - ordered[1]).norm() <= tolerance) ordered.pop_back();
  return ordered;
}

std::vector<WideVec> contact_points(const ConvexCore<Wide>& a, const ConvexCore<Wide>* b,
                                    const Separation& s) {
  const Wide tolerance = tolerance::manifold_face_factor * s.size;
  const WideVec &n = s.normal, middle = (s.a + s.b) / 2;
  const Basis basis(n);
  Polygon fa;
  for (const WideVec& p : support_face(a, n, tolerance)) fa.push_back(basis.flatten(p - middle));
  Polygon region = fa;
  if (b) {
    Polygon fb;
    for (const WideVec& p : support_face(*b, -n, tolerance)) fb.push_back(basis.flatten(p - middle));
    std::reverse(fb.begin(), fb.end());  // counter-clockwise about n as well
    if (fa.size() < 2 || fb.size() < 2) return {middle};
    if (fa.size() == 2 && fb.size() == 2)
      region = overlap_of_segments(fa, fb, tolerance);
    else
      region = fa.size() > 2 && fb.size() == 2 ? clip(fb, fa, tolerance) : clip(fa, fb, tolerance);
  }
  drop_repeats(region, tolerance);
  if (region.empty()) return {middle};
  // Picks points evenly when there are more than the manifold holds.
  Points r;
  const std::size_t kept = std::min(region.size(), Manifold::capacity);
  for (std::size_t i = 0; i < kept; ++i) {
    const Plane2& p = region[i * region.size() / kept];
    r.push_back(middle + basis.u * p.x() + basis.v * p.y());
  }
  return r;
}

}  // namespace touchstone::narrow
