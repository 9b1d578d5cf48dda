// Questions with a number that decides them: margins at the distance of the bodies or a few ulps beside it,
// and rays aimed at faces, edges and corners of a body and past them.
#include <cmath>
#include <limits>

#include "scenarios/random/families.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

double ulps_away(double x, int ulps) {
  const double to =
      ulps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int i = std::abs(ulps); i > 0; --i) x = std::nextafter(x, to);
  return x;
}

// The distance itself, up to four ulps beside it, or 2^-40 to 2^-4 of the size beside it.
double margin_at(Rng& rng, double distance, double size) {
  const auto style = rng.below(8);
  if (style < 2) return distance;
  if (style < 5) return ulps_away(distance, static_cast<int>(rng.below(9)) - 4);
  const double by = rng.binary_scale(-40, -5) * size;
  return distance + (rng.chance(0.5) ? by : -by);
}

// Differences of corners whose length is a double: Pythagorean triples and quadruples, and one axis alone.
constexpr int exact_offsets[][4] = {{1, 0, 0, 1},  {3, 4, 0, 5},  {5, 12, 0, 13}, {1, 2, 2, 3},
                                    {2, 3, 6, 7},  {1, 4, 8, 9},  {4, 4, 7, 9},   {2, 6, 9, 11},
                                    {6, 6, 7, 11}, {8, 15, 0, 17}};

double eighths(Rng& rng) { return static_cast<double>(1 + rng.below(8)) / 8; }

// Two upright boxes on a lattice, apart corner to corner by an exact distance; either may have rounded
// corners.
double place_corners(Rng& rng, Scene& s) {
  const auto& offset = exact_offsets[rng.below(std::size(exact_offsets))];
  const double unit = std::ldexp(1.0, static_cast<int>(rng.below(5)) - 5);
  const auto shift = static_cast<int>(rng.below(3));
  double radii = 0;
  Vec3 apart = Vec3::Zero();
  for (int k = 0; k < 3; ++k) apart[(k + shift) % 3] = offset[k] * unit;
  for (int i = 0; i < 2; ++i) {
    const Vec3 half{eighths(rng), eighths(rng), eighths(rng)};
    const bool is_ball = may_draw(ShapeKind::sphere) && (rng.below(4) == 0 || !may_draw(ShapeKind::box));
    const double radius = is_ball ? eighths(rng) * unit : 0;
    if (is_ball)
      s.shapes.emplace_back(Sphere{radius});
    else
      s.shapes.emplace_back(Box{half});
    radii += radius;
    if (!is_ball) apart += half.cwiseProduct((apart.array() > 0).cast<double>().matrix());
  }
  s.bodies.resize(2);
  s.bodies[1].shape = 1;
  s.bodies[1].pose.translation = apart;
  for (double& x : s.bodies[1].pose.translation)
    if (rng.chance(0.5)) x = -x;
  return offset[3] * unit - radii;
}

// Spheres on a line, and upright boxes that overlap least along one axis: of known depth.
double place_overlapping(Rng& rng, Scene& s) {
  const double a = eighths(rng), b = eighths(rng),
               depth = std::min(a, b) * static_cast<double>(1 + rng.below(7)) / 8;
  const bool balls = may_draw(ShapeKind::sphere) && (rng.chance(0.5) || !may_draw(ShapeKind::box));
  const auto axis = static_cast<Eigen::Index>(rng.below(3));
  if (balls) {
    s.shapes.emplace_back(Sphere{a});
    s.shapes.emplace_back(Sphere{b});
  } else {
    Vec3 x = Vec3::Constant(2), y = Vec3::Constant(2);  // so that the least depth is along the axis
    x[axis] = a;
    y[axis] = b;
    s.shapes.emplace_back(Box{x});
    s.shapes.emplace_back(Box{y});
  }
  s.bodies.resize(2);
  s.bodies[1].shape = 1;
  s.bodies[1].pose.translation = (a + b - depth) * Vec3::Unit(axis);
  return -depth;
}

// At a distance that is known up to rounding.
double place_apart(Rng& rng, Scene& s) {
  const auto [a, b] = random_kinds(rng);
  s = random_pair(rng, a, b, 1, Vec3::Zero());
  const double gap = rng.chance(0.5) ? rng.uniform(0.001, 1) : rng.binary_scale(-30, -4);
  const double distance = gap * mean_extent(s);
  s = at_gap(rng, std::move(s), gap);
  return distance;
}

void place_anyhow(Rng& rng, Scene& s) {
  const ShapeKind a = random_convex_kind(rng);
  const ShapeKind b = random_convex_kind(rng);
  s = random_pair(rng, a, b, 1, Vec3::Zero());
  const double gap = rng.uniform(-1, 1);
  s = at_gap(rng, std::move(s), gap);
}

void ask_margin(Case& c) {
  c.queries = {
      {Question::within, 0, 1}, {Question::bounded_distance, 0, 1}, {Question::contact_within, 0, 1}};
}

}  // namespace

void margins(Rng& rng, Case& c) {
  const auto style = rng.below(8);
  double distance = 0;
  if (style < 3)
    distance = place_apart(rng, c.scene);
  else if (style < 5)
    distance = place_corners(rng, c.scene);
  else if (style < 7)
    distance = place_overlapping(rng, c.scene);
  else
    place_anyhow(rng, c.scene);
  const double size = mean_extent(c.scene);
  c.scene.margin = rng.below(16) == 0 ? 0
                   : style == 7       ? rng.uniform(-1, 1) * size
                                      : margin_at(rng, distance, size);
  ask_margin(c);
}

namespace {

// Asks at the first places, and again after each of a few steps in which a body goes elsewhere, out or in.
template <class Place>
void move_some(Rng& rng, Scene& s, const Place& place) {
  const std::size_t n = s.bodies.size();
  for (std::size_t b = 0; b < n; ++b)
    s.script.push_back({Step::Op::insert, static_cast<int>(b), std::nullopt});
  s.script.push_back({Step::Op::query, -1, std::nullopt});
  std::vector<bool> present(n, true);
  const std::size_t count = 1 + rng.below(6);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t b = rng.below(n);
    const bool stays = !rng.chance(0.2);
    const Pose pose{place(), s.bodies[b].pose.rotation};
    const auto op = !present[b] ? Step::Op::insert : stays ? Step::Op::move : Step::Op::remove;
    present[b] = op != Step::Op::remove;
    s.script.push_back({op, static_cast<int>(b), present[b] ? std::optional(pose) : std::nullopt});
    s.script.push_back({Step::Op::query, -1, std::nullopt});
  }
}

}  // namespace

// Upright boxes and balls on a lattice of 1/8, and crowds of any shapes; margins of the same lattice. In half
// of the cases they move.
void loose_crowd(Rng& rng, Case& c) {
  const std::size_t n = 2 + rng.below(9);
  const bool lattice = rng.chance(0.6);
  const double side = 2.5 * std::cbrt(static_cast<double>(n));
  const auto place = [&] {
    Vec3 p;
    for (double& x : p) {
      x = rng.uniform(-side / 2, side / 2);
      if (lattice) x = to_eighths(x);
    }
    return p;
  };
  for (std::size_t i = 0; i < n; ++i) {
    Body b;
    b.shape = static_cast<int>(i);
    const bool box = lattice && may_draw(ShapeKind::box);
    const Vec3 half{eighths(rng), eighths(rng), eighths(rng)};
    const ShapeKind kind = random_convex_kind(rng);
    if (box)
      c.scene.shapes.emplace_back(Box{half});
    else
      c.scene.shapes.push_back(random_shape(rng, kind, 0.7));
    if (!lattice) b.pose.rotation = rng.rotation();
    b.pose.translation = place();
    b.is_static = rng.below(6) == 0;
    c.scene.bodies.push_back(std::move(b));
  }
  c.scene.margin = lattice ? static_cast<double>(rng.below(9)) / 8 : rng.uniform(0, 1.5);
  if (rng.below(8) == 0) c.scene.margin = ulps_away(c.scene.margin, 1);
  if (rng.chance(0.5)) move_some(rng, c.scene, place);
  c.queries = {{Question::candidates_within, -1, -1}};
}

namespace {

// Where a ray is aimed: a point near the surface, in size units of the body.
Vec3 aim_at(Rng& rng, const Scene& s) {
  if (kind_of(s.shapes[0]) == ShapeKind::mesh) return spot_on(rng, s, 0).point;
  if (kind_of(s.shapes[0]) == ShapeKind::half_space) return rng.vector(0, 2);
  const Vec3 n = rng.unit_vector();
  const Vec3 corner = s.bodies[0].pose.translation + farthest_point(s, 0, n);
  const auto style = rng.below(6);
  // At the farthest point, past it or a little inside of it, or anywhere in the body.
  if (style < 2) return corner;
  if (style < 4) {
    const double beside = rng.binary_scale(-30, -4);
    return corner + n * (rng.chance(0.5) ? beside : -beside);
  }
  return s.bodies[0].pose.translation + rng.uniform(0, 0.9) * farthest_point(s, 0, n);
}

}  // namespace

void rays(Rng& rng, Case& c) {
  const auto kind = rng.below(10);
  const ShapeKind target = kind == 0 && may_draw(ShapeKind::half_space) ? ShapeKind::half_space
                           : kind == 1 && may_draw(ShapeKind::mesh)     ? ShapeKind::mesh
                                                                        : random_convex_kind(rng);
  Scene s = random_pair(rng, target, ShapeKind::sphere, 1, Vec3::Zero());
  const Vec3 aim = aim_at(rng, s), way = rng.vector(0.5, 6);
  const double part = rng.below(8) == 0 ? 1 : rng.uniform(0.05, 1.2);
  make_ray(s, aim, way, part);
  c.scene = std::move(s);
  c.queries = {{Question::ray, 0, 1}};
}

}  // namespace touchstone::fuzz
