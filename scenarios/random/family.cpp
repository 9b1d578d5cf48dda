#include "scenarios/random/family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/input_error.h"
#include "scenarios/random/families.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"
#include "scenarios/text/name_list.h"

namespace touchstone::fuzz {
namespace {

Scene pair_of(Rng& rng, double scale = 1, const Vec3& origin = Vec3::Zero()) {
  const auto [a, b] = random_kinds(rng);
  return random_pair(rng, a, b, scale, origin);
}

// Draws in a fixed order: the direction, then the sideways shift, in [0, most_sideways] sizes.
Scene place(Rng& rng, Scene s, double gap_in_sizes, double most_sideways) {
  const Vec3 n = placement_direction(rng, s);
  const double sideways = rng.uniform(0, most_sideways);
  place_along(rng, s, n, gap_in_sizes * mean_extent(s), sideways);
  return s;
}

void separate(Rng& rng, Case& c) {
  Scene s = pair_of(rng);
  const double gap = rng.uniform(0.001, 1.0);
  c.scene = place(rng, std::move(s), gap, 1);
  ask_pair(c);
}

// Gap of either sign, log-uniform from 1e-2 down to 1e-12 of the size.
void near_touching(Rng& rng, Case& c) {
  const double size = rng.binary_scale(-40, -7);
  const double gap = rng.chance(0.5) ? size : -size;
  Scene s = pair_of(rng);
  c.scene = place(rng, std::move(s), gap, 0.2);
  ask_pair(c);
}

void shallow(Rng& rng, Case& c) {
  Scene s = pair_of(rng);
  const double depth = rng.uniform(0.001, 0.1);
  c.scene = place(rng, std::move(s), -depth, 0.3);
  ask_pair(c);
}

void deep(Rng& rng, Case& c) {
  Scene s = pair_of(rng);
  const double depth = rng.uniform(0.1, 1.5);
  c.scene = place(rng, std::move(s), -depth, 0.3);
  ask_pair(c);
}

// The second body is 2 to 20 times smaller and its origin lies inside the first; one in eight is concentric
// or coaxial.
void contained(Rng& rng, Case& c) {
  const ShapeKind a = random_convex_kind(rng);
  const ShapeKind b = random_convex_kind(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  const double ratio = rng.uniform(0.05, 0.5);
  s.shapes[1] = random_shape(rng, b, ratio);
  const auto style = rng.below(16);
  const Mat3 r = rotation_matrix(s.bodies[0].pose.rotation);
  Vec3 local = rng.vector(0, 0.3) * extent(s.shapes[0]);
  if (style == 0) local = Vec3::Zero();
  if (style == 1) {
    local = Vec3(0, 0, local.z());
    s.bodies[1].pose.rotation = s.bodies[0].pose.rotation;
  }
  s.bodies[1].pose.translation = r * local;
  c.scene = std::move(s);
  ask_pair(c);
}

// Axis-aligned rotations and coordinates on a lattice of 1/8: exact touching, parallel faces and edges, ties.
void lattice(Rng& rng, Case& c) {
  static const Quat turns[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1},
                               {0, 0, 1, 1}, {1, 1, 1, 1}, {1, 0, 0, 0}};
  const auto [a, b] = random_kinds(rng);
  Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
  for (Shape& shape : s.shapes)
    std::visit(
        [&](auto& x) {
          for_each_field(x, [&](auto, auto& v, Domain) {
            using V = std::decay_t<decltype(v)>;
            if constexpr (std::is_same_v<V, double>) v = std::max(0.125, to_eighths(v));
            if constexpr (std::is_same_v<V, Vec3>)
              for (double& e : v) e = std::max(0.125, to_eighths(e));
            if constexpr (std::is_same_v<V, std::vector<Vec3>>)
              for (Vec3& p : v)
                for (double& e : p) e = to_eighths(e);
          });
        },
        shape);
  for (Shape& shape : s.shapes)
    if (auto* h = hull_if(shape)) *h = make_hull(std::move(h->vertices));
  for (Body& body : s.bodies) body.pose.rotation = turns[rng.below(std::size(turns))];
  s.bodies[1].pose.rotation = rng.chance(0.5) ? s.bodies[0].pose.rotation : s.bodies[1].pose.rotation;
  const Vec3 n = placement_direction(rng, s);
  const double gap = rng.chance(0.5) ? 0 : rng.uniform(-0.6, 0.3);
  place_along(rng, s, n, gap, 0.3);
  for (double& e : s.bodies[1].pose.translation) e = to_eighths(e);
  c.scene = std::move(s);
  ask_pair(c);
}

// Millimetre-sized bodies in a world whose unit is the metre.
void tiny(Rng& rng, Case& c) {
  const double gap = rng.chance(0.5) ? rng.uniform(0.01, 0.5) : -rng.uniform(0.01, 0.5);
  c.scene = place(rng, pair_of(rng, 0x1p-10), gap, 0.3);
  ask_pair(c);
}

// Unit bodies 100 to 1e6 units from the origin.
void far_away(Rng& rng, Case& c) {
  const double gap = rng.chance(0.5) ? rng.uniform(0.01, 0.5) : -rng.uniform(0.01, 0.5);
  const Vec3 direction = rng.unit_vector();
  const Vec3 origin = direction * rng.binary_scale(7, 19);
  c.scene = place(rng, pair_of(rng, 1, origin), gap, 0.3);
  ask_pair(c);
}

// Aims at the other body's origin with a random offset and travels up to four times the distance.
void motion_case(Rng& rng, Case& c, bool spin) {
  Scene s = pair_of(rng);
  const double gap = rng.uniform(0.05, 1.5);
  s = place(rng, std::move(s), gap, 1);
  const double size = mean_extent(s);
  const Vec3 to = s.bodies[0].pose.translation - s.bodies[1].pose.translation;
  const bool plane = kind_of(s.shapes[0]) == ShapeKind::half_space;
  const Vec3 offset = rng.vector(0, 1.5) * size;
  const Vec3 aim = plane ? Vec3(offset * 2) : Vec3(to + offset);
  Motion m{aim * rng.uniform(0.3, 4), Vec3::Zero()};
  if (spin) m.angular = rng.chance(0.7) ? rng.vector(0.01, 0.7) : rng.vector(0.7, 9);
  s.bodies[1].motion = m;
  if (!s.bodies[0].is_static && rng.chance(0.3)) {
    Motion other{rng.unit_vector() * size, Vec3::Zero()};
    if (spin) other.angular = rng.vector(0.01, 0.7);
    s.bodies[0].motion = other;
  }
  c.scene = std::move(s);
  c.queries = {{Question::time_of_impact, 0, 1}};
}

void translate(Rng& rng, Case& c) { motion_case(rng, c, false); }
void spin(Rng& rng, Case& c) { motion_case(rng, c, true); }

Scene random_crowd(Rng& rng, std::size_t n) {
  Scene s;
  const double side = 2.0 * std::cbrt(static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    Body b;
    b.shape = static_cast<int>(i);
    const ShapeKind kind = random_convex_kind(rng);
    const double scale = rng.below(8) == 0 ? 2.0 : 0.7;
    s.shapes.push_back(random_shape(rng, kind, scale));
    b.pose.rotation = rng.chance(0.3) ? Quat{} : rng.rotation();
    b.pose.translation = Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * (side / 2);
    b.is_static = rng.below(6) == 0;
    s.bodies.push_back(std::move(b));
  }
  return s;
}

void crowd(Rng& rng, Case& c) {
  c.scene = random_crowd(rng, 4 + rng.below(28));
  c.queries = {{Question::candidates, -1, -1}, {Question::scene_contacts, -1, -1}};
}

// Insert, move, teleport, remove, reinsert, with queries between.
void script(Rng& rng, Case& c) {
  const std::size_t n = 3 + rng.below(10);
  c.scene = random_crowd(rng, n);
  std::vector<bool> present(n, false);
  std::vector<Step>& steps = c.scene.script;
  const double side = std::cbrt(static_cast<double>(n));
  const std::size_t count = 10 + rng.below(30);
  for (std::size_t k = 0; k < count; ++k) {
    const auto b = rng.below(n);
    Pose pose = c.scene.bodies[b].pose;
    const double reach = rng.chance(0.2) ? 50.0 : 0.3;
    pose.translation += rng.unit_vector() * (reach * side);
    if (rng.chance(0.5)) pose.translation = rng.unit_vector() * side;
    if (!present[b]) {
      steps.push_back({Step::Op::insert, static_cast<int>(b), pose});
      present[b] = true;
    } else if (rng.chance(0.3)) {
      steps.push_back({Step::Op::remove, static_cast<int>(b), std::nullopt});
      present[b] = false;
    } else {
      steps.push_back({Step::Op::move, static_cast<int>(b), pose});
    }
    if (rng.chance(0.3)) steps.push_back({Step::Op::query, -1, std::nullopt});
  }
  steps.push_back({Step::Op::query, -1, std::nullopt});
  c.queries = {{Question::candidates, -1, -1}};
}

// The families from first_later on came later. In the mix of all families they have a stream of their own and
// replace a share of the cases: the others remain what they were for the same seed.
constexpr std::size_t first_later = 28;
// Those from here on replace a share of the cases of all before them in the same way.
constexpr std::size_t first_of_margins = 30;
constexpr std::size_t first_padded = 33;
constexpr std::size_t first_of_grounds = 34;

constexpr Family catalog[] = {
    {"separate", "disjoint pairs, gap 0.1 % to 100 % of their size", 14, separate},
    {"near", "gap of either sign, 1e-2 down to 1e-12 of the size", 14, near_touching},
    {"shallow", "overlaps of 0.1 % to 10 % of the size", 14, shallow},
    {"deep", "overlaps of 10 % to 150 % of the size", 14, deep},
    {"contained", "a small body inside a large one, some concentric or coaxial", 8, contained},
    {"lattice", "axis-aligned bodies on a lattice of 1/8: exact touching, ties, parallel faces", 8, lattice},
    {"tiny", "millimetre-sized bodies in a world measured in metres", 6, tiny},
    {"far", "unit bodies 100 to 1e6 from the origin", 6, far_away},
    {"translate", "time of impact, translation only", 5, translate},
    {"spin", "time of impact, translation with slow and fast rotation", 5, spin},
    {"crowd", "4 to 31 bodies: candidate pairs and scene contacts", 3, crowd},
    {"script", "insert, move, teleport, remove, reinsert, with queries between", 3, script},
    {"start", "time of impact, overlapping or almost touching at the start", 2, start_in_contact},
    {"graze", "time of impact, passing with a gap of either sign, 1e-2 to 1e-8 of the size", 2, graze},
    {"bullet", "time of impact, small and fast bodies through thin plates", 2, bullet},
    {"last", "time of impact in the last 0.05 % of the step, or just after it", 1, last_moment},
    {"whirl", "time of impact, turning by 9 to 60 radians", 1, whirl},
    {"swarm", "3 to 20 moving bodies: swept candidate pairs, times of impact", 3, swarm},
    {"tiles", "2 to 26 bodies of mixed sizes that touch exactly or within ulps, near and far", 3, tiles},
    {"errands", "tiles inserted, moved by ulps or more, removed, reinserted, with queries", 3, errands},
    {"throng", "40 to 400 tiles: candidate pairs", 1, throng},
    {"zero", "sizes of zero: points, segments, discs, plates, flat hulls", 7, zero_sizes},
    {"unequal", "a body 250 to 4e6 times smaller than the other", 5, unequal_sizes},
    {"parallel", "boxes and prisms rotated relative to each other by 1e-14 to 0.1", 6, nearly_parallel},
    {"mesh", "meshes of 1 to 450 triangles: single, folded, closed, flat, scattered", 8, meshes},
    {"vertices", "hulls of 64 to 300 vertices", 4, many_vertices},
    {"company", "3 to 14 bodies with meshes, groups, ignored pairs: candidates and contacts", 4, company},
    {"dialogue", "3 to 6 bodies, few shapes; pairs queried in turn, in both orders, and again", 5, dialogue},
    {"later", "rounded boxes against any shape: apart, touching, deep, concentric, in motion", 6,
     later_shapes},
    {"surfaces", "two meshes: apart, touching, crossing, one inside the other, coplanar", 6, two_meshes},
    {"margins", "pairs at a margin: exactly, within ulps, within 2^-40 to 2^-4 of the size", 4, margins},
    {"loose", "2 to 10 bodies: candidate pairs within a margin", 2, loose_crowd},
    {"rays", "rays at and past faces, edges, corners; from inside; ending on the surface", 3, rays},
    {"padded", "padded cylinders, cones, ellipsoids, hulls against any shape: apart to concentric", 4,
     padded_shapes},
    {"fields",
     "height fields against convex bodies: apart, touching, deep, beyond the border, in motion, rays", 4,
     height_fields},
    {"compounds", "2 to 5 bodies of 1 to 5 convex shapes each, some on a ground: contacts", 2, compounds},
    // Only when asked for by name: a case takes as long as a hundred others.
    {"endless", "2 to 5 bodies, 300 to 699 queries about their pairs in any order", 0, endless_dialogue},
    // Only when asked for by name: `stability --motions` judges every frame and what changes between them.
    {"motions", "a smooth motion in 4 to 16 frames: settling, sliding, rolling, a top, a hinge", 0, motions},
    // Only when asked for by name: the referee's bracket of one depth costs as much as fifty other answers.
    {"solids", "solid meshes, some hollow, against any shape: apart, touching, deep, inside", 0, solids},
};
static_assert(catalog[first_later - 1].name == "dialogue");
static_assert(catalog[first_of_margins - 1].name == "surfaces");
static_assert(catalog[first_padded - 1].name == "rays");
static_assert(catalog[first_of_grounds - 1].name == "padded");

int total_weight(std::span<const Family> families) {
  return std::accumulate(families.begin(), families.end(), 0,
                         [](int sum, const Family& f) { return sum + f.weight; });
}

const Family& named(std::string_view name) {
  const auto it =
      std::find_if(std::begin(catalog), std::end(catalog), [&](const Family& f) { return f.name == name; });
  if (it == std::end(catalog)) {
    std::string place = "--family ";
    throw InputError(place.append(name), "unknown family; see `touchstone families`");
  }
  return *it;
}

// Among families asked for by name, those without a share of the mix count too.
int weight_of(const Family& f) { return std::max(1, f.weight); }

// Draws one of the families by weight.
const Family& pick(Rng& rng, std::span<const Family* const> among) {
  if (among.size() == 1) return *among.front();
  int total = 0;
  for (const Family* f : among) total += weight_of(*f);
  auto k = static_cast<int>(rng.below(static_cast<std::uint64_t>(total)));
  for (const Family* f : among)
    if ((k -= weight_of(*f)) < 0) return *f;
  return *among.back();
}

// Streams separate from the case's own.
constexpr std::uint64_t later_stream = 0x6c61746572ULL, margins_stream = 0x6d617267696e73ULL,
                        padded_stream = 0x706164646564ULL, grounds_stream = 0x67726f756e6473ULL;

// One of the families from `first` on, by its share of all up to `end`; null: none of them.
const Family* pick_later(std::uint64_t stream, std::uint64_t index, std::size_t first, std::size_t end) {
  Rng rng = Rng::stream(stream, index);
  const std::span<const Family> up_to = std::span(catalog).first(end);
  auto k = static_cast<int>(rng.below(static_cast<std::uint64_t>(total_weight(up_to))));
  for (const Family& f : up_to.subspan(first))
    if ((k -= f.weight) < 0) return &f;
  return nullptr;
}

// Of `a`, of `b,c` or, when empty, of all families.
const Family& pick(Rng& rng, std::uint64_t seed, std::uint64_t index, std::string_view names) {
  std::array<bool, std::size(catalog)> named_here{};
  if (!names.empty())
    for_each_in_list(names, [&](std::string_view name) {
      named_here[static_cast<std::size_t>(&named(name) - catalog)] = true;
    });
  if (names.empty()) {
    if (const Family* f = pick_later(seed ^ grounds_stream, index, first_of_grounds, std::size(catalog)))
      return *f;
    if (const Family* f = pick_later(seed ^ padded_stream, index, first_padded, first_of_grounds)) return *f;
    if (const Family* f = pick_later(seed ^ margins_stream, index, first_of_margins, first_padded)) return *f;
    if (const Family* f = pick_later(seed ^ later_stream, index, first_later, first_of_margins)) return *f;
  }
  std::vector<const Family*> among;
  for (std::size_t i = 0; i < std::size(catalog); ++i)
    if (names.empty() ? i < first_later : named_here[i]) among.push_back(&catalog[i]);
  return pick(rng, among);
}

constexpr std::uint64_t forms_stream = 0x666f726d73ULL;  // a stream separate from the case's own

Case make_new(std::uint64_t seed, std::uint64_t index, std::string_view names) {
  Rng rng = Rng::stream(seed, index);
  const Family& f = pick(rng, seed, index, names);
  Case c;
  c.family = std::string(f.name);
  f.make(rng, c);
  return c;
}

}  // namespace

std::span<const Family> families() { return catalog; }

namespace {

constexpr std::uint64_t kinds_stream = 0x6b696e6473ULL;  // of the cases drawn again; separate from the others
// Families that draw one of several kinds have such a case among this many; others have none.
constexpr std::uint64_t most_draws = 64;

bool is_of(const Scene& s, std::span<const ShapeKind> kinds) {
  return std::ranges::all_of(
      s.shapes, [&](const Shape& x) { return std::ranges::find(kinds, kind_of(x)) != kinds.end(); });
}

// Families that draw their kinds by name are drawn again, with the family, until all shapes are of the kinds.
Case make_new_of(std::uint64_t seed, std::uint64_t index, std::string_view names,
                 std::span<const ShapeKind> kinds) {
  const OnlyKinds only(kinds);
  Case c = make_new(seed, index, names);
  for (std::uint64_t k = 1; k < most_draws && !kinds.empty() && !is_of(c.scene, kinds); ++k)
    c = make_new(seed ^ (kinds_stream * k), index, names);
  return c;
}

}  // namespace

Case make_case(std::uint64_t seed, std::uint64_t index, std::string_view names,
               std::span<const ShapeKind> kinds) {
  Rng rng = Rng::stream(seed ^ forms_stream, index);
  const bool sequel = is_sequel(rng) && index > 0;
  Case c = sequel ? make_case(seed, index - 1, names, kinds) : make_new_of(seed, index, names, kinds);
  if (sequel) move_a_body(rng, c);
  apply_forms(rng, c);
  c.id = c.family + "/" + std::to_string(seed) + "/" + std::to_string(index);
  return c;
}

}  // namespace touchstone::fuzz
