#include "scenarios/random/families.h"

#include <cmath>

#include "scenarios/random/numbers.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

void ask_about(Case& c, Scene s) {
  c.scene = std::move(s);
  ask_pair(c);
}

// Body 1 flies towards body 0 from its position.
void ask_impact(Rng& rng, Case& c, Scene s) {
  const Vec3 to = s.bodies[0].pose.translation - s.bodies[1].pose.translation;
  const double steps = rng.uniform(0.5, 2);
  Motion m{(to + rng.vector(0, 0.3)) * steps, Vec3::Zero()};
  if (rng.chance(0.3)) m.angular = rng.vector(0.1, 2);
  s.bodies[1].motion = m;
  c.scene = std::move(s);
  c.queries = {{Question::time_of_impact, 0, 1}};
}

// Of the common kinds, those that can be flat.
ShapeKind kind_with_sizes(Rng& rng) {
  constexpr ShapeKind kinds[] = {ShapeKind::sphere,   ShapeKind::box,  ShapeKind::capsule,
                                 ShapeKind::cylinder, ShapeKind::cone, ShapeKind::hull};
  return kinds[rng.below(std::size(kinds))];
}

void flatten_hull(Rng& rng, Hull& h) {
  const auto flat = 1 + rng.below(7);
  for (Vec3& v : h.vertices)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (flat >> k & 1) v[k] = 0;
  h = make_hull(std::move(h.vertices));
}

// Aligned with the world axes, at coordinates that are multiples of 1/8: flat bodies then touch exactly or
// share a plane.
void put_on_lattice(Rng& rng, Scene& s) {
  static const Quat turns[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  for (Body& b : s.bodies) b.pose.rotation = turns[rng.below(std::size(turns))];
  for (Shape& shape : s.shapes) {
    for (double* x : numbers(shape)) *x = std::round(*x * 8) / 8;
    if (auto* h = hull_if(shape)) *h = make_hull(std::move(h->vertices));
  }
  for (double& x : s.bodies[1].pose.translation) x = std::round(rng.uniform(-1, 1) * 8) / 8;
}

// A regular prism with 3 to 8 sides: edges along z, faces around it.
Shape prism(Rng& rng) {
  const auto sides = 3 + rng.below(6);
  const double radius = rng.uniform(0.4, 1.2), half = rng.uniform(0.3, 1.2);
  // Rational points on the circle, to avoid a sine, whose last bit depends on the library.
  std::vector<Vec3> v;
  for (std::uint64_t i = 0; i < sides; ++i) {
    const double u = 4 * (static_cast<double>(i) + 0.5) / static_cast<double>(sides) - 2;
    const double t = u < -1 ? u + 2 : (u > 1 ? u - 2 : u), side = u < -1 || u > 1 ? -1 : 1;
    const double x = (1 - t * t) / (1 + t * t) * side, y = 2 * t / (1 + t * t) * side;
    for (const double z : {-half, half}) v.push_back({radius * x, radius * y, z});
  }
  return make_hull(std::move(v));
}

}  // namespace

double any_gap(Rng& rng, double size) {
  const auto style = rng.below(8);
  if (style == 0) return 0;
  if (style < 3) return rng.signed_binary_scale(-40, -7) * size;
  return rng.uniform(-0.5, 0.5) * size;
}

void exchange_bodies(Scene& s) {
  std::swap(s.bodies[0], s.bodies[1]);
  std::swap(s.shapes[0], s.shapes[1]);
  s.bodies[0].shape = 0;
  s.bodies[1].shape = 1;
}

void flatten(Rng& rng, Shape& shape) {
  if (auto* h = hull_if(shape)) return flatten_hull(rng, *h);
  const auto all = sizes_of(shape);
  if (all.empty()) return;
  const auto zero = 1 + rng.below((std::uint64_t{1} << all.size()) - 1);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (zero >> k & 1) *all[k] = 0;
}

void zero_sizes(Rng& rng, Case& c) {
  const ShapeKind flat = kind_with_sizes(rng);
  const bool both = rng.below(4) == 0;
  const ShapeKind other = random_kinds(rng).first;
  Scene s = random_pair(rng, both ? kind_with_sizes(rng) : other, flat, 1, Vec3::Zero());
  flatten(rng, s.shapes[1]);
  if (both) flatten(rng, s.shapes[0]);
  const bool bounded = is_convex(kind_of(s.shapes[0]));
  // A semi-axis of an ellipsoid must not be rounded to zero.
  if (bounded && kind_of(s.shapes[0]) != ShapeKind::ellipsoid && rng.chance(0.4)) {
    put_on_lattice(rng, s);
  } else {
    const Vec3 n = placement_direction(rng, s);
    const double size = mean_extent(s) > 0 ? mean_extent(s) : 1;
    place_along(rng, s, n, any_gap(rng, size), 0.2);
  }
  if (bounded && rng.chance(0.5)) exchange_bodies(s);
  if (rng.below(8) == 0) return ask_impact(rng, c, std::move(s));
  ask_about(c, std::move(s));
}

// Placed against the face of a box, or against the farthest point of another body in some direction.
void unequal_sizes(Rng& rng, Case& c) {
  const ShapeKind large = random_convex_kind(rng), small = random_convex_kind(rng);
  Scene s = random_pair(rng, large, small, 1, Vec3::Zero());
  s.shapes[1] = random_shape(rng, small, rng.binary_scale(-21, -9));
  const bool face = large == ShapeKind::box && rng.chance(0.7);
  const Mat3 r = rotation_matrix(s.bodies[0].pose.rotation);
  const Vec3 n = face ? Vec3(r.col(static_cast<Eigen::Index>(rng.below(3)))) : rng.unit_vector();
  const double gap = any_gap(rng, extent(s.shapes[1]));
  place_along(rng, s, n, gap, face ? rng.uniform(0, 0.6) : 0);
  if (rng.chance(0.5)) exchange_bodies(s);
  ask_about(c, std::move(s));
}

// The second body has the first one's rotation except for a turn by 2^-45 to 1/8 and possibly by quarter
// turns; mostly edge to edge.
void nearly_parallel(Rng& rng, Case& c) {
  static const Quat quarters[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
  Scene s = random_pair(rng, ShapeKind::box, ShapeKind::box, 1, Vec3::Zero());
  for (Shape& shape : s.shapes)
    if (rng.chance(0.2)) shape = prism(rng);
  const Quat r = s.bodies[0].pose.rotation;
  const Mat3 axes = rotation_matrix(r);
  const bool about_edge = rng.chance(0.3);
  const Vec3 axis = about_edge ? Vec3(axes.col(2)) : rng.unit_vector();
  const Vec3 turn = axis * rng.binary_scale(-46, -4);
  s.bodies[1].pose.rotation = Quat{turn.x(), turn.y(), turn.z(), 1} * r * quarters[rng.below(5)];
  const auto k = static_cast<Eigen::Index>(rng.below(3));
  const double u = rng.uniform(-1, 1), v = rng.uniform(-1, 1);
  const Vec3 across = axes.col(k) * u + axes.col((k + 1) % 3) * v;
  constexpr double least_across = 0.1;  // of the unit axes; a shorter sum has a coarse direction
  const Vec3 n =
      rng.chance(0.6) && across.norm() > least_across ? Vec3(across.normalized()) : Vec3(axes.col(k));
  const double aside = rng.uniform(0, 0.4);
  place_along(rng, s, n, any_gap(rng, mean_extent(s)), aside);
  ask_about(c, std::move(s));
}

}  // namespace touchstone::fuzz
