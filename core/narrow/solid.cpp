#include "core/narrow/solid.h"

#include <algorithm>
#include <limits>

#include "core/narrow/mesh.h"
#include "core/narrow/solid_depth.h"

namespace touchstone {

SolidParts::SolidParts(const SolidMesh& solid)
    : is_convex(is_convex_solid(solid)), hull(make_hull(solid.vertices)), inner(inner_points(solid)) {
  of_hull = std::make_unique<const Collider>(hull);
  if (is_convex) return;
  surface = static_cast<const TriangleMesh&>(solid);
  of_surface = std::make_unique<const Collider>(surface);
}

namespace narrow {
namespace {

bool is_solid(const Shape& s) { return kind_of(s) == ShapeKind::solid_mesh; }

// The mean of the vertices: unlike each of them, it does not lie on a surface that the hull touches.
Vec3 middle_of(const Hull& h) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : h.vertices) sum += v;
  return sum / static_cast<double>(h.vertices.size());
}

// A point of a convex body, or of each connected part of a mesh, in its frame. No point of a solid lies on a
// surface that the solid touches, where rounding would decide on which side it is.
std::vector<Vec3> points_of(const SeenShape& x) {
  if (x.inside()) return x.inside()->inner;
  if (const auto* mesh = std::get_if<TriangleMesh>(x.seen().shape)) return points_of_parts(*mesh);
  if (const auto* hull = hull_if(*x.seen().shape)) return {middle_of(*hull)};
  return {Vec3::Zero()};
}

Vec3 in_frame_of(const PlacedShape& x, const PlacedShape& y, const Vec3& point_of_y) {
  const WideFrame fx = wide_frame(x.pose), fy = wide_frame(y.pose);
  const WideVec from_x = fy.rotation * point_of_y.cast<Wide>() + (fy.translation - fx.translation);
  return (fx.rotation.transpose() * from_x).cast<double>();
}

std::optional<Vec3> contained_point(const SeenShape& x, const SeenShape& y) {
  if (!x.inside()) return std::nullopt;
  for (const Vec3& p : points_of(y)) {
    const Vec3 local = in_frame_of(x.placed(), y.placed(), p);
    if (winding_number(std::get<TriangleMesh>(x.inside()->surface), local) != 0)
      return to_transform(y.placed().pose) * p;
  }
  return std::nullopt;
}

bool is_surface(const SeenShape& x) { return kind_of(*x.seen().shape) == ShapeKind::mesh && !x.inside(); }

// The pair of a query, and what is found out about it in common.
struct Pair {
  SeenShape a, b;
  Pair(const PlacedShape& x, const PlacedShape& y) : a(x, y), b(y, x) {}
  bool is_plain() const { return !a.inside() && !b.inside(); }
  /// A surface has no depth.
  bool has_depth() const { return !is_surface(a) && !is_surface(b); }
  /// A point of one in the other, for surfaces that do not meet.
  std::optional<Vec3> common_point() const {
    const auto p = contained_point(a, b);
    return p ? p : contained_point(b, a);
  }
};

DistanceAnswer with_depth(const Pair& pair, DistanceAnswer d) {
  const auto way = way_out(pair.a, pair.b, d);
  if (!way) {
    d.outcome = Outcome::not_converged;
    return d;
  }
  d.distance = -way->depth;
  d.normal = way->normal;
  d.witness = way->witness;
  d.error_bound = way->depth - way->at_least;
  return d;
}

OverlapAnswer overlap_of(const Pair& pair, Arithmetic arithmetic, PairMemory* memory) {
  OverlapAnswer r = overlap(pair.a.seen(), pair.b.seen(), arithmetic, memory);
  if (pair.is_plain() || r.outcome != Outcome::answered || r.overlap) return r;
  r.overlap = pair.common_point().has_value();
  return r;
}

DistanceAnswer distance_of(const Pair& pair, Arithmetic arithmetic, PairMemory* memory) {
  DistanceAnswer r = distance(pair.a.seen(), pair.b.seen(), arithmetic, memory);
  if (pair.is_plain() || r.outcome != Outcome::answered) return r;
  if (r.distance <= 0) return pair.has_depth() ? with_depth(pair, r) : r;
  const auto common = pair.common_point();
  if (!common) return r;
  if (pair.has_depth()) return with_depth(pair, r);
  r.distance = 0;
  r.witness = {*common, *common};
  return r;
}

}  // namespace

bool has_solid(const ShapeRef& a, const ShapeRef& b) { return is_solid(*a.shape) || is_solid(*b.shape); }

SeenShape::SeenShape(const PlacedShape& p, const PlacedShape& other) : placed_(p), seen_(p) {
  const auto* solid = std::get_if<SolidMesh>(p.shape);
  if (!solid) return;
  parts_ = p.collider ? p.collider->solid() : nullptr;
  if (!parts_) {
    own_ = std::make_shared<const SolidParts>(*solid);
    parts_ = own_.get();
  }
  if (parts_->is_convex || kind_of(*other.shape) == ShapeKind::half_space) {
    seen_ = hull();
    return;
  }
  inside_ = parts_;
  seen_ = PlacedShape(*parts_->of_surface, p.pose);
}

PlacedShape SeenShape::hull() const { return parts_ ? PlacedShape(*parts_->of_hull, placed_.pose) : placed_; }

SeenShape SeenShape::moved(const Vec3& by) const {
  SeenShape r = *this;
  r.placed_.pose.translation += by;
  r.seen_.pose.translation += by;
  return r;
}

bool contains_part(const SeenShape& x, const SeenShape& y) { return contained_point(x, y).has_value(); }

OverlapAnswer solid_overlap(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                            PairMemory* memory) {
  return overlap_of(Pair(a, b), arithmetic, memory);
}

DistanceAnswer solid_distance(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                              PairMemory* memory) {
  return distance_of(Pair(a, b), arithmetic, memory);
}

ContactAnswer solid_contact(const PlacedShape& a, const PlacedShape& b, Arithmetic arithmetic,
                            PairMemory* memory) {
  const Pair pair(a, b);
  if (pair.is_plain() || arithmetic == Arithmetic::float32)
    return contact(pair.a.seen(), pair.b.seen(), arithmetic, memory);
  ContactAnswer r;
  const OverlapAnswer met = overlap_of(pair, arithmetic, memory);
  r.outcome = met.outcome;
  r.overlap = met.overlap;
  r.error_bound = r.regret_bound = met.error_bound;
  if (met.outcome != Outcome::answered || !met.overlap) return r;
  const DistanceAnswer d = distance_of(pair, arithmetic, memory);
  r.outcome = d.outcome;
  if (d.outcome != Outcome::answered) return r;
  r.normal = d.normal;
  r.depth = std::max(0.0, -d.distance);
  r.regret_bound = d.error_bound;
  r.manifold.push_back({(d.witness[0] + d.witness[1]) / 2, r.depth, 0});
  return r;
}

Separation solid_separation(const PlacedShape& a, const PlacedShape& b) {
  const Pair pair(a, b);
  Separation s = separation(pair.a.seen(), pair.b.seen());
  if (pair.is_plain() || s.outcome != Outcome::answered || (s.gap > 0 && !pair.common_point())) return s;
  const DistanceAnswer d = distance_of(pair, Arithmetic::float64, nullptr);
  s.outcome = d.outcome;
  s.gap = std::min(0.0, d.distance);
  s.normal = d.normal.cast<Wide>();
  s.a = (d.witness[0] - a.pose.translation).cast<Wide>();
  s.b = (d.witness[1] - a.pose.translation).cast<Wide>();
  s.slack = s.local_slack = d.error_bound;
  return s;
}

}  // namespace narrow
}  // namespace touchstone
