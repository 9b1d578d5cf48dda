#include "scenarios/random/families.h"

#include <algorithm>
#include <cmath>

#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

int add_body(Rng& rng, Scene& s, int shape, double side) {
  Body b;
  b.shape = shape;
  b.pose.rotation = rng.rotation();
  b.pose.translation = Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * side;
  b.is_static = !is_convex(kind_of(s.shapes[static_cast<std::size_t>(shape)]));
  s.bodies.push_back(std::move(b));
  return static_cast<int>(s.bodies.size()) - 1;
}

// Fewer shapes than bodies; one shape in eight has a size of zero.
Scene few_shapes(Rng& rng, std::size_t bodies, std::size_t shapes) {
  Scene s;
  for (std::size_t i = 0; i < shapes; ++i) {
    const double scale = rng.uniform(0.5, 1.2);
    s.shapes.push_back(random_shape(rng, random_convex_kind(rng), scale));
    if (rng.below(8) == 0) flatten(rng, s.shapes.back());
  }
  const double side = 0.8 * std::cbrt(static_cast<double>(bodies));
  for (std::size_t i = 0; i < bodies; ++i) add_body(rng, s, static_cast<int>(rng.below(shapes)), side);
  return s;
}

void add_fixed(Rng& rng, Scene& s, Shape shape) {
  s.shapes.push_back(std::move(shape));
  const int body = add_body(rng, s, static_cast<int>(s.shapes.size()) - 1, 0.3);
  // At any place in the order of bodies.
  const auto other = rng.below(s.bodies.size());
  std::swap(s.bodies[static_cast<std::size_t>(body)], s.bodies[other]);
}

void filter(Rng& rng, Scene& s) {
  const auto n = s.bodies.size();
  for (Body& b : s.bodies)
    if (rng.chance(0.4)) b.group = static_cast<int>(rng.below(3));
  for (auto k = rng.below(4); k > 0; --k) {
    const auto a = static_cast<int>(rng.below(n)), b = static_cast<int>(rng.below(n));
    if (a != b) s.ignored.push_back(std::minmax(a, b));
  }
  std::sort(s.ignored.begin(), s.ignored.end());
  s.ignored.erase(std::unique(s.ignored.begin(), s.ignored.end()), s.ignored.end());
}

}  // namespace

void company(Rng& rng, Case& c) {
  const auto bodies = 3 + rng.below(10);
  c.scene = few_shapes(rng, bodies, 1 + rng.below(bodies));
  const auto fixed = rng.below(6);
  if (fixed > 0) add_fixed(rng, c.scene, any_mesh(rng, 1.5));
  if (fixed == 1) add_fixed(rng, c.scene, any_mesh(rng, 1));
  if (fixed == 2) add_fixed(rng, c.scene, random_shape(rng, ShapeKind::half_space, 0.5));
  if (rng.chance(0.6)) filter(rng, c.scene);
  c.queries = {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}};
}

// Queries about two or three pairs in turn, in either order of their bodies; some are repeated.
void dialogue(Rng& rng, Case& c) {
  const auto bodies = 3 + rng.below(3);
  c.scene = few_shapes(rng, bodies, 2);
  if (rng.below(4) == 0) add_fixed(rng, c.scene, any_mesh(rng, 1));
  const auto n = c.scene.bodies.size();
  std::vector<BodyPair> pairs;
  for (auto k = 2 + rng.below(2); k > 0; --k) {
    const auto a = rng.below(n), b = (a + 1 + rng.below(n - 1)) % n;
    pairs.emplace_back(a, b);
  }
  for (auto k = 6 + rng.below(6); k > 0; --k) {
    const auto [a, b] = pairs[rng.below(pairs.size())];
    const auto question = static_cast<Question>(rng.below(3));
    const bool reversed = rng.chance(0.3);
    c.queries.push_back(reversed ? Query{question, b, a} : Query{question, a, b});
  }
}

// Some 500 queries about all pairs of few bodies, in any order: counters of eight bits in an engine overflow
// within one case, those of sixteen bits within some 150.
void endless_dialogue(Rng& rng, Case& c) {
  constexpr std::uint64_t fewest = 300, spread = 400;
  const auto shapes = 1 + rng.below(3);
  c.scene = few_shapes(rng, 2 + rng.below(4), shapes);
  const auto n = c.scene.bodies.size();
  for (auto k = fewest + rng.below(spread); k > 0; --k) {
    const auto a = rng.below(n), b = (a + 1 + rng.below(n - 1)) % n;
    c.queries.push_back({static_cast<Question>(rng.below(3)), static_cast<int>(a), static_cast<int>(b)});
  }
}

}  // namespace touchstone::fuzz
