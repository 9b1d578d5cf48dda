#include "core/impact/impact.h"

#include <algorithm>
#include <cmath>

#include "core/impact/pair.h"
#include "core/math/roundoff.h"
#include "core/narrow/narrow_phase.h"
#include "core/narrow/shape_pairs.h"
#include "core/narrow/solid.h"
#include "core/narrow/unit_scale.h"
#include "core/tolerance.h"

namespace touchstone {
namespace impact {

double scale_of(const MovingShape& s, double extent) {
  const double from = s.pose.translation.cwiseAbs().maxCoeff();
  return std::max({extent, from, (s.pose.translation + s.motion.linear).cwiseAbs().maxCoeff()});
}

double accuracy_of(double scale) { return (tolerance::core_tau_factor - 4) * double_roundoff * scale; }

ImpactAnswer shift_witnesses(ImpactAnswer r, const Vec3& origin) {
  for (Vec3& x : r.witness_w) x += origin;
  return r;
}

namespace {

double accuracy_of_pair(const MovingShape& a, double extent_a, const MovingShape& b, double extent_b) {
  return accuracy_of(std::max(scale_of(a, extent_a), scale_of(b, extent_b)));
}

filtered::Search boxes(const MovingShape& a, const MovingShape& b, const filtered::Translation& m) {
  const Vec3 &ha = std::get_if<Box>(a.shape)->half_extents, &hb = std::get_if<Box>(b.shape)->half_extents;
  return translating_boxes(m, ha, hb, accuracy_of_pair(a, ha.maxCoeff(), b, hb.maxCoeff()));
}

filtered::Search ball_and_box(const MovingShape& a, const MovingShape& b, const filtered::Translation& m) {
  const double radius = std::get_if<Sphere>(a.shape)->radius;
  const Vec3& half = std::get_if<Box>(b.shape)->half_extents;
  return translating_ball_and_box(m, radius, half, accuracy_of_pair(a, radius, b, half.maxCoeff()));
}

filtered::Round round_of(const Sphere& s) { return {0, s.radius}; }
filtered::Round round_of(const Capsule& s) { return {s.half_height, s.radius}; }

template <class A, class B>
filtered::Search rounds(const MovingShape& a, const MovingShape& b, const filtered::Translation& m) {
  const filtered::Round ra = round_of(*std::get_if<A>(a.shape)), rb = round_of(*std::get_if<B>(b.shape));
  return translating_rounds(m, ra, rb,
                            accuracy_of_pair(a, ra.half_height + ra.radius, b, rb.half_height + rb.radius));
}

// What the types alone decide: every two bounded shapes, in either order, and such a shape with a half-space.
struct General {
  template <class A, class B>
  constexpr Row row() const {
    if constexpr (std::is_same_v<A, TriangleMesh> && std::is_same_v<B, TriangleMesh>)
      return {&moving_parts};
    else if constexpr (std::is_same_v<A, TriangleMesh> && std::is_same_v<B, HalfSpace>)
      return {&mesh_half_space};
    else if constexpr (!is_convex_shape<A>)
      return {};
    else if constexpr (is_convex_shape<B>)
      return {&convex_convex, {}, is_polytope_shape<A> && is_polytope_shape<B>};
    else if constexpr (std::is_same_v<B, HalfSpace>)
      return {&convex_half_space};
    else if constexpr (std::is_same_v<B, TriangleMesh>)
      return {&convex_mesh};
    else
      return {};
  }
};

template <class A, class B>
constexpr void set_rounds(narrow::PairTable<Row>& t) {
  t.set<A, B>({&convex_convex, {&rounds<A, B>}});
}

constexpr narrow::PairTable<Row> make_table() {
  narrow::PairTable<Row> t{General()};
  set_rounds<Sphere, Sphere>(t);
  set_rounds<Sphere, Capsule>(t);
  set_rounds<Capsule, Sphere>(t);
  set_rounds<Capsule, Capsule>(t);
  t.set<Sphere, Box>({&convex_convex, {&ball_and_box}});
  t.set<Box, Sphere>({});  // mirrored
  t.set<Box, Box>({&convex_convex, {&boxes, false}});
  return t;
}

constexpr narrow::PairTable<Row> table = make_table();

bool moves(const MovingShape& s) { return !s.motion.linear.isZero(0) || !s.motion.angular.isZero(0); }
bool is_moving_mesh(const MovingShape& s) { return kind_of(*s.shape) == ShapeKind::mesh && moves(s); }

ImpactAnswer unsupported() {
  ImpactAnswer r;
  r.outcome = Outcome::unsupported;
  return r;
}

ImpactAnswer at_rest(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  if (const auto met = contact_at_start(a, b, detail)) return *met;
  ImpactAnswer r;
  r.clear_until = 1;
  const DistanceAnswer d = distance(a, b);
  r.outcome = d.outcome;
  r.separation = d.distance;
  return r;
}

ImpactAnswer mirrored(ImpactAnswer r) {
  r.normal_ab = -r.normal_ab;
  std::swap(r.witness_w[0], r.witness_w[1]);
  return r;
}

ImpactAnswer moving(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  const auto [row, is_mirrored] = table.find(a.shape->index(), b.shape->index());
  if (!row) return unsupported();
  const bool has_convex = is_convex(kind_of(*a.shape)) || is_convex(kind_of(*b.shape));
  if (has_convex && (is_moving_mesh(a) || is_moving_mesh(b))) return moving_parts(a, b, detail, row);
  return is_mirrored ? mirrored(row.function(b, a, detail, row)) : row.function(a, b, detail, row);
}

MovingShape seen(const narrow::SeenShape& shape, const Motion& motion) {
  MovingShape r;
  static_cast<PlacedShape&>(r) = shape.seen();
  r.motion = motion;
  return r;
}

// What is outside a solid meets its surface before its inside.
ImpactAnswer with_solid(const MovingShape& a, const MovingShape& b, ImpactDetail detail) {
  const narrow::SeenShape x(a, b), y(b, a);
  if (!narrow::contains_part(x, y) && !narrow::contains_part(y, x))
    return time_of_impact(seen(x, a.motion), seen(y, b.motion), detail);
  ImpactAnswer r;
  r.toi = 0;
  if (detail == ImpactDetail::time) return r;
  const DistanceAnswer d = distance(a, b);
  r.separation = std::min(0.0, d.distance);
  r.normal_ab = d.normal;
  r.witness_w = d.witness;
  if (d.outcome == Outcome::answered) return r;
  r.outcome = d.outcome;
  r.toi.reset();
  return r;
}

// A ball is invariant under rotation.
MovingShape without_ineffective_rotation(MovingShape s) {
  const bool ball = std::visit(
      []<class S>(const S& shape) {
        if constexpr (is_convex_shape<S>)
          return shape.is_ball();
        else
          return false;
      },
      *s.shape);
  if (ball) s.motion.angular.setZero();
  return s;
}

}  // namespace
}  // namespace impact

ImpactAnswer time_of_impact(const MovingShape& first, const MovingShape& second, ImpactDetail detail) {
  using namespace impact;
  const MovingShape a = without_ineffective_rotation(first), b = without_ineffective_rotation(second);
  for (const MovingShape* s : {&a, &b})
    if (kind_of(*s->shape) == ShapeKind::half_space && moves(*s)) return unsupported();
  if (!moves(a) && !moves(b)) return at_rest(a, b, detail);
  if (narrow::has_solid(a, b)) return with_solid(a, b, detail);
  const double way = std::max(a.motion.linear.cwiseAbs().maxCoeff(), b.motion.linear.cwiseAbs().maxCoeff());
  if (const int e = narrow::unit_scale(a, b, way); e != 0) {
    const narrow::ScaledPair<MovingShape> pair(a, b, e);
    ImpactAnswer r = time_of_impact(pair.a, pair.b, detail);
    r.separation = std::ldexp(r.separation, -e);
    if (r.toi)
      for (Vec3& x : r.witness_w) x = narrow::scaled(x, -e) + pair.origin;
    return r;
  }
  return moving(a, b, detail);
}

}  // namespace touchstone
