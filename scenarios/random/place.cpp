#include "scenarios/random/place.h"

#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {

namespace {

double support_world(const Scene& s, int body, const Vec3& n) {
  const Body& b = s.bodies[static_cast<std::size_t>(body)];
  const Mat3 r = rotation_matrix(b.pose.rotation);
  return support_value(s.shape_of(body), r.transpose() * n);
}

}  // namespace

Scene random_pair(Rng& rng, ShapeKind a, ShapeKind b, double scale, const Vec3& origin) {
  Scene s;
  for (ShapeKind k : {a, b}) {
    Body body;
    body.shape = static_cast<int>(s.shapes.size());
    s.shapes.push_back(random_shape(rng, k, scale));
    body.pose.rotation = rng.rotation();
    body.pose.translation = origin;
    body.is_static = !is_convex(k);
    s.bodies.push_back(std::move(body));
  }
  return s;
}

void place_along(Rng& rng, Scene& s, const Vec3& n, double gap, double sideways) {
  const double reach = support_world(s, 0, n) + support_world(s, 1, -n);
  Vec3 t = n * (reach + gap);
  const Vec3 u = rng.unit_vector();
  t += (u - u.dot(n) * n) * (sideways * mean_extent(s));
  s.bodies[1].pose.translation = s.bodies[0].pose.translation + t;
}

Vec3 placement_direction(Rng& rng, const Scene& s) {
  if (const auto* h = std::get_if<HalfSpace>(&s.shape_of(0)))
    return rotation_matrix(s.bodies[0].pose.rotation) * h->normal.normalized();
  return rng.unit_vector();
}

Vec3 farthest_point(const Scene& s, int body, const Vec3& n) {
  const Mat3 r = rotation_matrix(s.bodies[static_cast<std::size_t>(body)].pose.rotation);
  const Vec3 local = r.transpose() * n;
  return std::visit(
      [&](const auto& shape) -> Vec3 {
        if constexpr (requires { support(shape, local); })
          return r * support(shape, local);
        else
          return Vec3::Zero();
      },
      s.shape_of(body));
}

void make_ray(Scene& s, const Vec3& aim, const Vec3& way, double part) {
  s.shapes[1] = Sphere{0};
  s.bodies[1].pose = {aim - part * way, {}};
  s.bodies[1].motion = Motion{way, Vec3::Zero()};
}

void ask_pair(Case& c) {
  c.queries = {{Question::overlap, 0, 1}, {Question::distance, 0, 1}, {Question::contact, 0, 1}};
}

double mean_extent(const Scene& s) {
  const double a = extent(s.shape_of(0)), b = extent(s.shape_of(1));
  return a == 0 ? b : (b == 0 ? a : (a + b) / 2);
}

std::pair<ShapeKind, ShapeKind> random_kinds(Rng& rng) {
  const auto pick = rng.below(10);
  const ShapeKind b = random_convex_kind(rng);
  if (pick == 0 && may_draw(ShapeKind::half_space)) return {ShapeKind::half_space, b};
  if (pick == 1 && may_draw(ShapeKind::mesh)) return {ShapeKind::mesh, b};
  return {random_convex_kind(rng), b};  // b was drawn first
}

Scene at_gap(Rng& rng, Scene s, double gap) {
  const Vec3 n = placement_direction(rng, s);
  const double length = gap * mean_extent(s);
  place_along(rng, s, n, length, 0);
  if (is_convex(kind_of(s.shape_of(0))))
    s.bodies[1].pose.translation =
        s.bodies[0].pose.translation + (farthest_point(s, 0, n) - farthest_point(s, 1, -n) + n * length);
  return s;
}

}  // namespace touchstone::fuzz
