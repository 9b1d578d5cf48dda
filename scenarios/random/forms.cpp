#include "scenarios/random/families.h"

#include <algorithm>
#include <cmath>

namespace touchstone::fuzz {
namespace {

// All pair queries, or each with some probability.
void reverse_pairs(Rng& rng, Case& c) {
  const bool all = rng.chance(0.7);
  for (Query& q : c.queries)
    if (is_pair_question(q.question) && q.question != Question::ray && (all || rng.chance(0.5)))
      std::swap(q.a, q.b);
}

void shuffle_questions(Rng& rng, Case& c) {
  for (std::size_t i = c.queries.size(); i > 1; --i) std::swap(c.queries[i - 1], c.queries[rng.below(i)]);
  if (!c.queries.empty() && rng.chance(0.5)) c.queries.push_back(c.queries.front());
}

void stretch(Rng& rng, Quat& q) {
  const double by = rng.chance(0.75) ? rng.binary_scale(-10, 10) : rng.binary_scale(-100, 100);
  for (double* x : {&q.x, &q.y, &q.z, &q.w}) *x *= by;
}

void stretch_rotations(Rng& rng, Case& c) {
  for (Body& b : c.scene.bodies)
    if (rng.chance(0.7)) stretch(rng, b.pose.rotation);
  for (Step& s : c.scene.script)
    if (s.pose && rng.chance(0.3)) stretch(rng, s.pose->rotation);
}

}  // namespace

bool is_sequel(Rng& rng) { return rng.below(24) == 0; }

void move_a_body(Rng& rng, Case& c) {
  if (c.scene.bodies.empty() || rng.below(4) == 0) return;
  Body& b = c.scene.bodies[rng.below(c.scene.bodies.size())];
  const double size = extent(c.scene.shapes[static_cast<std::size_t>(b.shape)]);
  const Vec3 direction = rng.unit_vector();
  b.pose.translation += direction * (rng.binary_scale(-30, -1) * (size > 0 ? size : 1));
  if (rng.chance(0.3)) b.pose.rotation = rng.rotation();
}

void apply_forms(Rng& rng, Case& c) {
  if (rng.below(8) == 0) reverse_pairs(rng, c);
  if (rng.below(8) == 0) shuffle_questions(rng, c);
  if (rng.below(8) == 0) stretch_rotations(rng, c);
}

}  // namespace touchstone::fuzz
