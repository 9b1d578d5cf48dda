#include "reports/chart/chart_cases.h"

#include <fmt/format.h>

#include <cmath>

#include "core/math/rng.h"
#include "scenarios/random/family.h"
#include "scenarios/random/place.h"
#include "scenarios/random/random_shape.h"

namespace touchstone::fuzz {
namespace {

constexpr std::size_t crowd_shapes = 32;
constexpr double volume_per_body = 40;  // of the cube; a body itself has a volume of 2 to 4

struct GapRange {
  const char* name;
  double (*gap)(Rng&);  // relative to the size of the pair
};
constexpr GapRange gap_ranges[] = {
    {"apart", [](Rng& rng) { return rng.uniform(0.1, 1); }},
    {"near",
     [](Rng& rng) { return rng.chance(0.5) ? rng.binary_scale(-30, -10) : -rng.binary_scale(-30, -10); }},
    {"shallow", [](Rng& rng) { return -rng.uniform(0.001, 0.1); }},
    {"deep", [](Rng& rng) { return -rng.uniform(0.1, 1); }},
};

// Margins in units of the gap.
struct MarginRange {
  const char* name;
  double least, most;
};
constexpr MarginRange margin_ranges[] = {{"nearer", 1.25, 4}, {"farther", 0.1, 0.8}};

struct Scale {
  const char* name;
  double size, offset;
};
constexpr Scale scales[] = {{"1", 1, 0}, {"2^-10", 0x1p-10, 0}, {"1 at 2^13", 1, 0x1p13}};

std::vector<std::pair<ShapeKind, ShapeKind>> kind_pairs(bool meshes) {
  std::vector<std::pair<ShapeKind, ShapeKind>> pairs;
  for (const ShapeKind a : common_convex_kinds)
    for (const ShapeKind b : common_convex_kinds)
      if (a <= b) pairs.emplace_back(a, b);
  for (const ShapeKind b : common_convex_kinds) {
    pairs.emplace_back(ShapeKind::half_space, b);
    if (meshes) pairs.emplace_back(ShapeKind::mesh, b);
  }
  return pairs;
}

std::string pair_name(ShapeKind a, ShapeKind b) {
  return std::string(type_name(a)) + "-" + std::string(type_name(b));
}

ChartCase pair_case(std::uint64_t seed, std::size_t index, const char* question, const char* regime,
                    const std::string& pair, const char* scale) {
  ChartCase c{{}, regime, pair, scale, 2};
  c.c.id = fmt::format("chart/{}{}/{}", question, seed, index);
  c.c.family = "chart";
  return c;
}

}  // namespace

std::vector<ChartCase> narrow_chart_cases(std::uint64_t seed, int per_cell, bool meshes) {
  std::vector<ChartCase> cases;
  for (const auto& [a, b] : kind_pairs(meshes))
    for (const GapRange& range : gap_ranges)
      for (const Scale& scale : scales)
        for (int i = 0; i < per_cell; ++i) {
          Rng rng = Rng::stream(seed, cases.size());
          const Vec3 origin = rng.unit_vector() * scale.offset;
          Scene s = random_pair(rng, a, b, scale.size, origin);
          const double gap = range.gap(rng);
          s = at_gap(rng, std::move(s), gap);
          ChartCase c = pair_case(seed, cases.size(), "", range.name, pair_name(a, b), scale.name);
          c.c.scene = std::move(s);
          c.c.queries = {{Question::overlap, 0, 1}, {Question::distance, 0, 1}, {Question::contact, 0, 1}};
          cases.push_back(std::move(c));
        }
  return cases;
}

std::vector<ChartCase> margin_chart_cases(std::uint64_t seed, int per_cell, bool meshes) {
  std::vector<ChartCase> cases;
  for (const auto& [a, b] : kind_pairs(meshes))
    for (const MarginRange& range : margin_ranges)
      for (int i = 0; i < per_cell; ++i) {
        Rng rng = Rng::stream(seed, cases.size());
        const Scene s = random_pair(rng, a, b, 1, Vec3::Zero());
        const double gap = rng.uniform(0.1, 1);
        ChartCase c = pair_case(seed, cases.size(), "margin/", range.name, pair_name(a, b), "1");
        c.c.scene = at_gap(rng, s, gap);
        c.c.scene.margin = gap * mean_extent(c.c.scene) * rng.uniform(range.least, range.most);
        c.c.queries = {
            {Question::within, 0, 1}, {Question::bounded_distance, 0, 1}, {Question::contact_within, 0, 1}};
        cases.push_back(std::move(c));
      }
  return cases;
}

std::vector<ChartCase> ray_chart_cases(std::uint64_t seed, int count) {
  std::vector<ChartCase> cases;
  for (int i = 0; i < count; ++i) {
    ChartCase c{make_case(seed, static_cast<std::uint64_t>(i), "rays"), "rays", "", "1", 2};
    c.pair = type_name(c.c.scene.shape_of(0));
    cases.push_back(std::move(c));
  }
  return cases;
}

std::vector<ChartCase> impact_chart_cases(std::uint64_t seed, int per_regime) {
  std::vector<ChartCase> cases;
  for (const char* family : {"translate", "spin", "graze", "bullet"})
    for (int i = 0; i < per_regime; ++i) {
      ChartCase c{make_case(seed, static_cast<std::uint64_t>(i), family), family, "", "1", 2};
      const Scene& s = c.c.scene;
      c.pair = pair_name(kind_of(s.shape_of(0)), kind_of(s.shape_of(1)));
      c.c.queries = {{Question::time_of_impact, 0, 1}};
      cases.push_back(std::move(c));
    }
  return cases;
}

ChartCase broad_chart_case(std::uint64_t seed, std::uint64_t bodies) {
  Rng rng = Rng::stream(seed, bodies);
  ChartCase c{{}, "crowd", "mixed", "1", bodies};
  c.c.id = "chart/crowd/" + std::to_string(bodies);
  c.c.family = "chart";
  Scene& s = c.c.scene;
  // Kinds that every engine supports.
  constexpr ShapeKind kinds[] = {ShapeKind::sphere, ShapeKind::box, ShapeKind::capsule, ShapeKind::hull};
  for (std::size_t i = 0; i < crowd_shapes; ++i) {
    Shape shape = random_shape(rng, kinds[i % std::size(kinds)], 1);
    // ODE does not support flat hulls.
    while (kind_of(shape) == ShapeKind::hull && std::get<Hull>(shape).dimension < 3)
      shape = random_shape(rng, ShapeKind::hull, 1);
    s.shapes.push_back(std::move(shape));
  }
  const double side = std::cbrt(static_cast<double>(bodies) * volume_per_body);
  for (std::uint64_t i = 0; i < bodies; ++i) {
    Body b;
    b.shape = static_cast<int>(rng.below(s.shapes.size()));
    b.pose.rotation = rng.rotation();
    for (double& x : b.pose.translation) x = rng.uniform(0, side);
    s.bodies.push_back(std::move(b));
  }
  c.c.queries = {{Question::candidates, -1, -1}};
  return c;
}

}  // namespace touchstone::fuzz
