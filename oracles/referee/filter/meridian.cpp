#include "oracles/referee/filter/minkowski.h"

#include <algorithm>
#include <optional>
#include <queue>
#include <vector>

namespace touchstone::referee {
namespace {

constexpr int edge_cap = 4096;

/// A body of revolution: its section in (radial, axial) coordinates, about its own centre.
struct Revolved {
  enum class Kind { point, segment, cylinder, cone, spheroid };
  Kind kind = Kind::point;
  Real3 axis;  // unit; unset for a point
  Real3 centre;
  Real radial = 0, axial = 0;
  Real slack = 0;  // Hausdorff distance from the body it represents
};

std::optional<Revolved> of_points(const Solid& b) {
  Revolved r;
  if (b.points.size() == 1) {
    r.centre = b.points[0];
    return r;
  }
  if (b.points.size() != 2) return std::nullopt;
  const Real3 half = 0.5L * (b.points[1] - b.points[0]);
  r.centre = 0.5L * (b.points[1] + b.points[0]);
  r.axial = norm(half);
  if (r.axial == 0) return r;
  r.kind = Revolved::Kind::segment;
  r.axis = (1 / r.axial) * half;
  return r;
}

// A nearby body that is exactly round: axis along the matrix's column k, the other two columns replaced by
// unit vectors perpendicular to it and to each other.
std::optional<Revolved> of_curved(const Solid& b) {
  int k = 2;
  Revolved r;
  r.centre = b.centre;
  if (b.kind == Solid::Kind::ellipsoid) {
    const Real3& s = b.size;
    if (s.y == s.z)
      k = 0;
    else if (s.x == s.z)
      k = 1;
    else if (s.x != s.y)
      return std::nullopt;
    r.kind = Revolved::Kind::spheroid;
    r.radial = s[(k + 1) % 3];
    r.axial = s[k];
  } else {
    r.kind = b.kind == Solid::Kind::cylinder ? Revolved::Kind::cylinder : Revolved::Kind::cone;
    r.radial = b.size.x;
    r.axial = b.size.y;
  }
  const Real3 m = column(b.matrix, k), p = column(b.matrix, (k + 1) % 3), q = column(b.matrix, (k + 2) % 3);
  const Real length = norm(m);
  if (!(length > 0)) return std::nullopt;
  r.axis = (1 / length) * m;
  const Real3 e = unit_across(p, r.axis), f = cross(r.axis, e);
  const Real off = norm(p - e) + std::fmin(norm(q - f), norm(q + f));
  r.slack = r.radial * (off + dot_rounding);
  r.axial *= length;
  return r;
}

std::optional<Revolved> revolved(const Solid& b) {
  if (b.is_swept || b.kind == Solid::Kind::orbit) return std::nullopt;
  auto r = b.kind == Solid::Kind::points ? of_points(b) : of_curved(b);
  if (r) r->slack += b.error + projection_rounding * b.extent;
  return r;
}

struct Point2 {
  Real r = 0, z = 0;
};
Real dot(const Point2& a, const Point2& b) { return a.r * b.r + a.z * b.z; }
Real cross(const Point2& a, const Point2& b) { return a.r * b.z - a.z * b.r; }
Real length(const Point2& a) { return std::sqrt(dot(a, a)); }

Point2 section_support(const Revolved& b, const Point2& n) {
  const Real sr = n.r < 0 ? -b.radial : b.radial, sz = n.z < 0 ? -b.axial : b.axial;
  switch (b.kind) {
    case Revolved::Kind::point:
      return {};
    case Revolved::Kind::segment:
      return {0, sz};
    case Revolved::Kind::cylinder:
      return {sr, sz};
    case Revolved::Kind::cone:
      return b.axial * n.z > std::fabs(b.radial * n.r) - b.axial * n.z ? Point2{0, b.axial}
                                                                       : Point2{sr, -b.axial};
    case Revolved::Kind::spheroid:
      break;
  }
  const Point2 s{b.radial * n.r, b.axial * n.z};
  const Real l = length(s);
  return l > 0 ? Point2{b.radial * (s.r / l), b.axial * (s.z / l)} : Point2{b.radial, 0};
}

class Section {
 public:
  Section(const Revolved& a, const Revolved& b, bool flipped, const Point2& offset)
      : a_(a), b_(b), flipped_(flipped), offset_(offset) {}
  Point2 support(const Point2& n) const {
    // B's axis may point against A's; its axial coordinate then changes sign.
    const Point2 m{-n.r, flipped_ ? n.z : -n.z};
    Point2 q = section_support(b_, m);
    if (flipped_) q.z = -q.z;
    const Point2 p = section_support(a_, n);
    return {p.r - q.r + offset_.r, p.z - q.z + offset_.z};
  }

 private:
  const Revolved &a_, &b_;
  bool flipped_;
  Point2 offset_;
};

struct Edge {
  Real reach;
  Point2 p, q;
  bool operator<(const Edge& o) const { return reach > o.reach; }
};

// Distance of the edge from the origin, by the proof in inner_polytope.h one dimension lower: the polygon's
// edges turn around the origin (cross > 0 for each of them), so a circle that none of them enters lies
// inside.
Edge edge_of(const Point2& p, const Point2& q) {
  const Point2 d{q.r - p.r, q.z - p.z};
  const Real l = length(d);
  const Point2 n{d.z / l, -d.r / l};
  return {std::fmin(dot(n, p), dot(n, q)), p, q};
}

struct PolygonBound {
  Real inner = 0, outer = std::numeric_limits<Real>::infinity();
  Point2 direction{1, 0};
};

// A support value of the section and the distance of an edge, relative to the extent: each is the quotient of
// a product of two coordinates and a length.
constexpr Real polygon_rounding = 32 * unit;

PolygonBound grow(const Section& s, Real extent, Real target) {
  const Real noise = polygon_rounding * extent;
  PolygonBound r;
  const auto support_along = [&](const Point2& n) {
    const Point2 p = s.support(n);
    const Real h = dot(n, p) / length(n) + noise;
    if (h < r.outer) {
      r.outer = h;
      r.direction = n;
    }
    return p;
  };
  const Point2 first[4] = {support_along({1, 0}), support_along({0, 1}), support_along({-1, 0}),
                           support_along({0, -1})};
  std::priority_queue<Edge> queue;
  for (int i = 0; i < 4; ++i) {
    const Point2 &p = first[i], &q = first[(i + 1) % 4];
    if (p.r == q.r && p.z == q.z) continue;
    queue.push(edge_of(p, q));
  }
  if (queue.size() < 2) return r;
  for (int i = 0; i < edge_cap; ++i) {
    const Edge e = queue.top();
    if (r.outer - e.reach <= target) break;
    const Point2 d{e.q.r - e.p.r, e.q.z - e.p.z}, n{d.z, -d.r};
    const Point2 p = support_along(n);
    if (dot(n, p) / length(n) - e.reach <= noise) break;
    if ((p.r == e.p.r && p.z == e.p.z) || (p.r == e.q.r && p.z == e.q.z)) break;
    queue.pop();
    queue.push(edge_of(e.p, p));
    queue.push(edge_of(p, e.q));
  }
  r.inner = queue.top().reach - noise;
  for (; !queue.empty(); queue.pop())
    if (!(cross(queue.top().p, queue.top().q) > noise * extent)) {
      r.inner = 0;
      return r;
    }
  return r;
}

}  // namespace

MeridianBound meridian_bound(const Difference& d, Real target) {
  MeridianBound m;
  auto a = revolved(d.a), b = revolved(d.b);
  if (!a || !b) return m;
  if (a->kind == Revolved::Kind::point) a->axis = b->axis;
  if (b->kind == Revolved::Kind::point) b->axis = a->axis;
  const Real3 &u = a->axis, skew = cross(u, b->axis);
  if (largest(u) == 0) return m;
  // Turning B by the angle between the axes moves none of its points farther than 2|sin|·(its size).
  const Real slack = a->slack + b->slack + 2 * (norm(skew) + dot_rounding) * (b->radial + b->axial);
  const Real3 e = a->centre - b->centre, across = e - dot(u, e) * u;
  // The length of `across` is accurate to a few units of |e| even where its direction is noise.
  const Section section(*a, *b, dot(u, b->axis) < 0, {norm(across), dot(u, e)});
  const PolygonBound p = grow(section, d.extent, target);
  const Real rounding = chain_rounding * d.extent;
  m.applies = true;
  m.axis = u;
  const Real l = p.inner - slack - rounding;
  if (l > 0) m.gap.lower(-l);
  const Real3 radial = unit_across(across, u);
  const Real3 n = p.direction.r * radial + p.direction.z * u;
  m.gap.raise(-d.width_above(d.support(n), n), n);
  return m;
}

}  // namespace touchstone::referee
