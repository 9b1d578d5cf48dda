#include "reports/stability/stability.h"

#include <cmath>

#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

const std::vector<Question> of_pairs{Question::overlap, Question::distance, Question::contact};
const std::vector<Question> of_margins{Question::within, Question::bounded_distance,
                                       Question::contact_within};

// The n values 2^first, 2^(first+step), …
std::vector<double> powers(int first, int step, int n) {
  std::vector<double> v;
  for (int i = 0; i < n; ++i) v.push_back(std::ldexp(1, first + i * step));
  return v;
}

// Half of the pairs are apart and half overlap, by a fraction `gap` of their size.
Scene placed(Rng& rng, Scene s, double gap) {
  const double signed_gap = rng.chance(0.5) ? gap : -gap;
  return at_gap(rng, std::move(s), signed_gap);
}

Scene convex_pair(Rng& rng, double size, const Vec3& origin) {
  const ShapeKind a = random_convex_kind(rng);
  const ShapeKind b = random_convex_kind(rng);
  return random_pair(rng, a, b, size, origin);
}

Scene gap(Rng& rng, double v) { return placed(rng, convex_pair(rng, 1, Vec3::Zero()), v); }
Scene scale(Rng& rng, double v) { return placed(rng, convex_pair(rng, v, Vec3::Zero()), 0.125); }
Scene offset(Rng& rng, double v) {
  const Vec3 origin = rng.unit_vector() * v;
  return placed(rng, convex_pair(rng, 1, origin), 0.125);
}

// Apart by a quarter of the margin up to a quarter more than it.
Scene margin(Rng& rng, double v) {
  Scene s = convex_pair(rng, 1, Vec3::Zero());
  const double apart = v * rng.uniform(0.25, 1.25);
  s = at_gap(rng, std::move(s), apart);
  s.margin = v * mean_extent(s);
  return s;
}

// A plate or a rod next to a body of ordinary proportions.
Scene aspect(Rng& rng, double v) {
  Scene s = convex_pair(rng, 1, Vec3::Zero());
  switch (rng.below(4)) {
    case 0:
      s.shapes[0] = Box{Vec3(1, 1, 1 / v)};
      break;
    case 1:
      s.shapes[0] = Cylinder{1, 1 / v};
      break;
    case 2:
      s.shapes[0] = Capsule{1 / v, 1};
      break;
    default:
      s.shapes[0] = Ellipsoid{Vec3(1, 1, 1 / v)};
  }
  return placed(rng, std::move(s), 0.0625);
}

// Face to face, tilted by v radians about a random axis in the face.
Scene angle(Rng& rng, double v) {
  Scene s;
  s.shapes = {Box{Vec3(1, 1, 0.5)}, Box{Vec3(0.75, 0.5, 0.5)}};
  const double turn = rng.uniform(0, 6);
  const double half = std::sin(v / 2);
  Body a, b;
  b.shape = 1;
  b.pose.rotation = {half * std::cos(turn), half * std::sin(turn), 0, std::cos(v / 2)};
  s.bodies = {a, b};
  const double depth = rng.chance(0.5) ? 0.0625 : -0.0625;
  place_along(rng, s, Vec3::UnitZ(), -depth, 0.1);
  return s;
}

Hull ball_of(Rng& rng, double vertices) {
  std::vector<Vec3> points;
  for (int i = 0; i < static_cast<int>(vertices); ++i) points.push_back(rng.unit_vector());
  return make_hull(std::move(points));
}

Scene vertices(Rng& rng, double v) {
  Scene s = random_pair(rng, ShapeKind::sphere, ShapeKind::sphere, 1, Vec3::Zero());
  s.shapes = {ball_of(rng, v), ball_of(rng, v)};
  return placed(rng, std::move(s), 0.0625);
}

// A strip of triangles whose height is v times their length.
Scene sliver(Rng& rng, double v) {
  Scene s = random_pair(rng, ShapeKind::mesh, random_convex_kind(rng), 1, Vec3::Zero());
  TriangleMesh m;
  for (int i = 0; i <= 8; ++i) {
    m.vertices.emplace_back(-1, i * v, 0);
    m.vertices.emplace_back(1, (i + 0.5) * v, 0);
    if (i == 8) break;
    m.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    m.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  s.shapes[0] = std::move(m);
  return placed(rng, std::move(s), 0.0625);
}

Scene moving(Rng& rng, double angular) {
  Scene s = placed(rng, convex_pair(rng, 1, Vec3::Zero()), 0);
  const Vec3 away = (s.bodies[1].pose.translation - s.bodies[0].pose.translation).normalized();
  s.bodies[1].pose.translation += away * 1.5;
  const Vec3 aside = rng.vector(0, 0.8);
  s.bodies[1].motion = Motion{away * -2.5 + aside, rng.unit_vector() * angular};
  return s;
}
Scene spin(Rng& rng, double v) { return moving(rng, v); }

// A ball of radius 1/8 that crosses a plate of thickness 1 off-centre at v thicknesses per step.
Scene speed(Rng& rng, double v) {
  Scene s;
  s.shapes = {Box{Vec3(64, 64, 0.5)}, Sphere{0.125}};
  Body plate, ball;
  ball.shape = 1;
  const Vec3 aside = rng.vector(0, 8);
  ball.pose.translation = Vec3(aside.x(), aside.y(), v * rng.uniform(0.3, 0.7) + 1);
  ball.motion = Motion{Vec3(0, 0, -v - 2), Vec3::Zero()};
  s.bodies = {plate, ball};
  return s;
}

// Bodies that move at random: tests the state that a broad phase keeps over v moves.
Scene steps(Rng& rng, double v) {
  Scene s;
  constexpr int bodies = 16;  // enough for a tree of several levels
  for (int i = 0; i < bodies; ++i) {
    Body b;
    b.shape = i;
    s.shapes.push_back(random_shape(rng, random_convex_kind(rng), 1));
    b.pose.translation = rng.vector(0, 4);
    s.bodies.push_back(std::move(b));
    s.script.push_back({Step::Op::insert, i, std::nullopt});
  }
  for (int i = 0; i < static_cast<int>(v); ++i) {
    Pose p;
    p.rotation = rng.rotation();
    p.translation = rng.vector(0, 4);
    s.script.push_back({Step::Op::move, static_cast<int>(rng.below(bodies)), p});
  }
  s.script.push_back({Step::Op::query, -1, std::nullopt});
  return s;
}

const LadderRow rows[] = {
    {"gap", "gap or depth of convex pairs of size 1", "sizes", powers(-4, -6, 9), of_pairs, gap},
    {"margin", "margin of convex pairs about as far apart", "sizes", powers(0, -5, 9), of_margins, margin},
    {"scale", "size of the bodies, gap an eighth of it", "units", powers(0, -8, 8), of_pairs, scale},
    {"offset", "distance from the origin of pairs of size 1", "sizes", powers(0, 6, 8), of_pairs, offset},
    {"aspect", "length over thickness of a plate or rod", "", powers(1, 4, 8), of_pairs, aspect},
    {"angle", "faces out of parallel", "rad", powers(-2, -6, 8), of_pairs, angle},
    {"vertices", "vertices of each of two hulls", "", powers(2, 1, 9), of_pairs, vertices},
    {"sliver", "height over length of a mesh's triangles", "", powers(0, -6, 8), of_pairs, sliver},
    {"spin", "rotation during the step", "rad", powers(-4, 2, 7), {Question::time_of_impact}, spin},
    {"speed",
     "travel per step over the thickness of a plate",
     "",
     powers(1, 2, 8),
     {Question::time_of_impact},
     speed},
    {"steps", "moves of 16 bodies before the query", "", powers(0, 2, 7), {Question::candidates}, steps},
};

}  // namespace

std::span<const LadderRow> ladders() { return rows; }

}  // namespace touchstone::fuzz
