#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "scenarios/random/families.h"
#include "scenarios/random/numbers.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

constexpr ShapeKind beside_padded[] = {ShapeKind::padded_cylinder, ShapeKind::padded_cone,
                                       ShapeKind::padded_ellipsoid, ShapeKind::padded_hull,
                                       ShapeKind::rounded_box};

constexpr bool is_later(ShapeKind k) {
  return k > last_common_shape && is_convex(k) &&
         std::ranges::find(padded_kinds, k) == std::end(padded_kinds);
}

constexpr auto later_kinds = [] {
  constexpr auto count = [] {
    std::size_t n = 0;
    for (int k = 0; k < shape_kind_count; ++k) n += is_later(static_cast<ShapeKind>(k));
    return n;
  }();
  std::array<ShapeKind, count> kinds{};
  std::size_t n = 0;
  for (int k = 0; k < shape_kind_count; ++k)
    if (is_later(static_cast<ShapeKind>(k))) kinds[n++] = static_cast<ShapeKind>(k);
  return kinds;
}();

using Kinds = std::span<const ShapeKind>;

ShapeKind one_of(Rng& rng, Kinds kinds) { return kinds[rng.below(kinds.size())]; }

// One of `later`, or of the common kinds.
ShapeKind other_kind(Rng& rng, Kinds later) {
  const auto pick = rng.below(10);
  if (pick == 0) return ShapeKind::half_space;
  if (pick == 1) return ShapeKind::mesh;
  return pick < 4 ? one_of(rng, later) : random_convex_kind(rng);
}

void set_odd_sizes(Rng& rng, Shape& shape) {
  const auto style = rng.below(8);
  const auto all = sizes_of(shape);
  if (style == 0) flatten(rng, shape);
  if (style == 1 && !all.empty()) *all[rng.below(all.size())] = rng.binary_scale(-30, -6);
}

// Signed, in sizes of the pair: as in the families separate, near, shallow and deep.
double random_gap(Rng& rng) {
  switch (rng.below(4)) {
    case 0:
      return rng.uniform(0.001, 1);
    case 1:
      return rng.signed_binary_scale(-40, -7);
    case 2:
      return -rng.uniform(0.001, 0.1);
    default:
      return -rng.uniform(0.1, 1.5);
  }
}

void set_in_motion(Rng& rng, Scene& s) {
  const Vec3 to = s.bodies[0].pose.translation - s.bodies[1].pose.translation;
  const Vec3 aside = rng.vector(0, 1);
  const Vec3 aim = to + aside * mean_extent(s);
  Motion m{aim * rng.uniform(0.3, 4), Vec3::Zero()};
  if (rng.chance(0.5)) m.angular = rng.chance(0.7) ? rng.vector(0.01, 0.7) : rng.vector(0.7, 9);
  s.bodies[1].motion = m;
}

void one_of_kinds(Rng& rng, Case& c, Kinds kinds, Kinds partners) {
  const ShapeKind first = other_kind(rng, partners), second = one_of(rng, kinds);
  Scene s = random_pair(rng, first, second, 1, Vec3::Zero());
  for (Shape& shape : s.shapes)
    if (is_convex(kind_of(shape))) set_odd_sizes(rng, shape);
  const bool moves = rng.below(4) == 0, both_convex = is_convex(first);
  // Faces and edges then meet face to face and edge to edge.
  if (rng.below(4) == 0) s.bodies[1].pose.rotation = s.bodies[0].pose.rotation;
  const bool concentric = !moves && both_convex && rng.below(16) == 0;
  if (!concentric) {
    const Vec3 n = placement_direction(rng, s);
    const double gap = moves ? rng.uniform(0.05, 1.5) : random_gap(rng);
    place_along(rng, s, n, gap * mean_extent(s), 0.3);
  }
  if (moves) set_in_motion(rng, s);
  if (!moves && both_convex && rng.chance(0.5)) exchange_bodies(s);
  c.scene = std::move(s);
  ask_pair(c);
  if (moves) c.queries = {{Question::time_of_impact, 0, 1}};
  if (!moves && rng.below(8) == 0)
    c.queries = {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}};
}

}  // namespace

void later_shapes(Rng& rng, Case& c) { one_of_kinds(rng, c, later_kinds, later_kinds); }
void padded_shapes(Rng& rng, Case& c) { one_of_kinds(rng, c, padded_kinds, beside_padded); }

}  // namespace touchstone::fuzz
