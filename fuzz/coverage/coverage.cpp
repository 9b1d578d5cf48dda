#include "fuzz/coverage/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/narrow/narrow_phase.h"
#include "fuzz/judge/truth.h"
#include "scenarios/random/family.h"

namespace touchstone::fuzz {
namespace {

/// Values below `limit`; the last bin has no limit.
struct Bin {
  double limit;
  const char* name;
};
constexpr double none = std::numeric_limits<double>::infinity();

// Of a body, by its radius about its origin, in the unit of the scene.
constexpr Bin sizes[] = {{0x1p-1074, "zero"}, {1e-5, "< 1e-5"}, {1e-3, "< 1e-3"},
                         {0.1, "< 0.1"},      {10, "< 10"},     {none, "10 or more"}};
// Of the larger size of a pair divided by the smaller.
constexpr Bin ratios[] = {{2, "< 2"}, {10, "< 10"}, {120, "< 120"}, {1e5, "< 1e5"}, {none, "1e5 or more"}};
// Numbers of vertices.
constexpr Bin vertices[] = {{4, "< 4"},   {5, "4"},     {9, "< 9"},     {17, "< 17"},
                            {33, "< 33"}, {65, "< 65"}, {129, "< 129"}, {none, "129 or more"}};
// Numbers of triangles.
constexpr Bin triangles[] = {{2, "1"}, {3, "2"}, {12, "< 12"}, {100, "< 100"}, {none, "100 or more"}};
// From the origin, in the unit of the scene.
constexpr Bin distances[] = {
    {1, "< 1"}, {100, "< 100"}, {1e4, "< 1e4"}, {1e6, "< 1e6"}, {none, "1e6 or more"}};
// Of the quaternion as given.
constexpr Bin norms[] = {{1e-6, "< 1e-6"}, {0.1, "< 0.1"}, {10, "about 1"}, {1e6, "> 10"}, {none, "> 1e6"}};
// Radians within the step.
constexpr Bin turns[] = {{0x1p-1074, "none"},
                         {0.1, "< 0.1"},
                         {std::numbers::pi, "< half a turn"},
                         {2 * std::numbers::pi, "< a turn"},
                         {none, "a turn or more"}};
constexpr Bin crowds[] = {{3, "2"}, {16, "< 16"}, {64, "< 64"}, {none, "64 or more"}};
// Of the gap divided by the scale of the pair; depths are negative.
constexpr Bin gaps[] = {{-0.1, "deeper than 0.1"},        {-1e-3, "deeper than 1e-3"},
                        {-1e-7, "deeper than 1e-7"},      {-1e-13, "deeper than 1e-13"},
                        {1e-13, "touching within 1e-13"}, {1e-7, "< 1e-7 apart"},
                        {1e-3, "< 1e-3 apart"},           {none, "apart"}};

template <std::size_t n>
std::string_view name_in(const Bin (&bins)[n], double x) {
  return std::find_if(bins, bins + n - 1, [&](const Bin& b) { return x < b.limit; })->name;
}

template <std::size_t n>
std::vector<std::string> names_of(const Bin (&bins)[n]) {
  std::vector<std::string> names;
  for (const Bin& b : bins) names.emplace_back(b.name);
  return names;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (int k = 0; k < shape_kind_count; ++k) names.emplace_back(type_name(static_cast<ShapeKind>(k)));
  return names;
}

std::string pair_name(ShapeKind a, ShapeKind b) {
  const auto [first, second] = std::minmax({type_name(a), type_name(b)});
  return fmt::format("{}-{}", first, second);
}

// Half-spaces meet bounded convex shapes only: no engine has an answer for two of them, and few for one and a
// mesh.
std::vector<std::string> pair_names() {
  std::vector<std::string> names;
  for (int a = 0; a < shape_kind_count; ++a)
    for (int b = a; b < shape_kind_count; ++b) {
      const auto x = static_cast<ShapeKind>(a), y = static_cast<ShapeKind>(b);
      if (is_convex(x) || is_convex(y) || (is_mesh(x) && is_mesh(y))) names.push_back(pair_name(x, y));
    }
  return names;
}

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Family& f : families())
    if (f.weight > 0) names.emplace_back(f.name);
  return names;
}

std::vector<std::string> texts(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

const std::vector<std::string> steps = {"insert", "move", "remove", "query", "no script"};
const std::vector<std::string> movements = {"at rest", "one moves", "both move"};
const std::vector<std::string> orders = {"a < b", "a > b"};
const std::vector<std::string> shared = {"two shapes", "one shape"};
const std::vector<std::string> arithmetics = {"overlap in double",  "overlap in extended precision",
                                              "distance in double", "distance in extended precision",
                                              "contact in double",  "contact in extended precision"};

const std::vector<CoverageGroup>& groups_of_cases() {
  static const std::vector<CoverageGroup> all = {
      {"family", "cases by family", family_names()},
      {"question", "queries", texts(question_names)},
      {"shape", "bodies by kind of shape", kind_names()},
      {"pair", "queries about two bodies, by kinds", pair_names()},
      {"size", "bodies by radius about their origin", names_of(sizes)},
      {"ratio", "pairs by the ratio of their sizes", names_of(ratios)},
      {"vertices", "hulls by number of vertices", names_of(vertices)},
      {"triangles", "meshes by number of triangles", names_of(triangles)},
      {"distance", "bodies by their distance from the origin", names_of(distances)},
      {"quaternion", "bodies by the norm of their quaternion", names_of(norms)},
      {"bodies", "cases by number of bodies", names_of(crowds)},
      {"order", "pairs by the order in which they are named", orders},
      {"shared", "pairs by whether they share a shape", shared},
      {"movement", "pairs asked for their time of impact", movements},
      {"turn", "moving bodies by the angle they turn by", names_of(turns)},
      {"script", "steps of scripts, and cases without one", steps},
      {"regime", "pairs by their gap, divided by their scale", names_of(gaps)},
      {"arithmetic", "answers of the core by the arithmetic that sufficed", arithmetics},
  };
  return all;
}

constexpr auto step_names = std::to_array<std::string_view>({"insert", "move", "remove", "query"});

bool moves(const Body& b) { return b.motion && !(b.motion->linear.isZero(0) && b.motion->angular.isZero(0)); }

}  // namespace

Coverage::Coverage() {
  for (const CoverageGroup& g : groups_of_cases())
    for (const std::string& value : g.values) counts_[g.name][value] = 0;
}

void Coverage::note(std::string_view group, std::string_view value) {
  ++counts_[std::string(group)][std::string(value)];
}

void Coverage::note_bodies(const Case& c) {
  for (std::size_t i = 0; i < c.scene.bodies.size(); ++i) {
    const Body& b = c.scene.bodies[i];
    const Shape& s = c.scene.shape_of(static_cast<int>(i));
    note("shape", type_name(kind_of(s)));
    if (is_bounded(kind_of(s))) note("size", name_in(sizes, bounding_radius(s)));
    if (const auto* h = hull_if(s))
      note("vertices", name_in(vertices, static_cast<double>(h->vertices.size())));
    if (const TriangleMesh* m = triangles_if(s))
      note("triangles", name_in(triangles, static_cast<double>(m->triangles.size())));
    note("distance", name_in(distances, b.pose.translation.stableNorm()));
    const Quat& q = b.pose.rotation;
    note("quaternion", name_in(norms, std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w))));
    if (moves(b)) note("turn", name_in(turns, b.motion->angular.stableNorm()));
  }
}

void Coverage::note_pair(const Case& c, const Query& q) {
  const Shape &a = c.scene.shape_of(q.a), &b = c.scene.shape_of(q.b);
  note("pair", pair_name(kind_of(a), kind_of(b)));
  note("order", q.a < q.b ? "a < b" : "a > b");
  const auto body = [&](int k) -> const Body& { return c.scene.bodies[static_cast<std::size_t>(k)]; };
  note("shared", body(q.a).shape == body(q.b).shape ? "one shape" : "two shapes");
  if (is_bounded(kind_of(a)) && is_bounded(kind_of(b))) {
    const auto [small, large] = std::minmax({bounding_radius(a), bounding_radius(b)});
    note("ratio", name_in(ratios, small > 0 ? large / small : large > 0 ? none : 1));
  }
  if (is_motion_question(q.question))
    note("movement",
         movements[static_cast<std::size_t>(moves(body(q.a))) + static_cast<std::size_t>(moves(body(q.b)))]);
}

void Coverage::note_script(const Case& c) {
  if (c.scene.script.empty()) note("script", "no script");
  for (const Step& s : c.scene.script) note("script", step_names[static_cast<std::size_t>(s.op)]);
}

void Coverage::note_regime(const Case& c, const Query& q) {
  Truth truth(c.scene);
  const referee::PairTruth& t = truth.pair(0, q.a, q.b);
  const double scale = truth.scale(q.a, q.b);
  if (scale > 0) note("regime", name_in(gaps, t.gap.lo / scale));
}

void Coverage::note_arithmetic(const Case& c, const Query& q) {
  const auto placed = [&](int k) {
    return PlacedShape{&c.scene.shape_of(k), c.scene.bodies[static_cast<std::size_t>(k)].pose};
  };
  const PlacedShape a = placed(q.a), b = placed(q.b);
  const auto by = [&](const char* name, Outcome alone, Outcome full) {
    if (full != Outcome::answered) return;
    note("arithmetic",
         fmt::format("{} in {}", name, alone == Outcome::answered ? "double" : "extended precision"));
  };
  constexpr Arithmetic alone = Arithmetic::float64_alone;
  if (q.question == Question::overlap) by("overlap", overlap(a, b, alone).outcome, overlap(a, b).outcome);
  if (q.question == Question::distance) by("distance", distance(a, b, alone).outcome, distance(a, b).outcome);
  if (q.question == Question::contact) by("contact", contact(a, b, alone).outcome, contact(a, b).outcome);
}

void Coverage::add(const Case& c, bool with_truth) {
  ++cases_;
  note("family", c.family);
  note("bodies", name_in(crowds, static_cast<double>(c.scene.bodies.size())));
  note_bodies(c);
  note_script(c);
  for (const Query& q : c.queries) {
    note("question", to_string(q.question));
    if (!is_pair_question(q.question)) continue;
    note_pair(c, q);
    if (!with_truth || is_motion_question(q.question)) continue;
    note_regime(c, q);
    note_arithmetic(c, q);
  }
}

void Coverage::add(const EngineCard& engine, const Case& c, const CaseObservations& answers) {
  if (std::find(engines_.begin(), engines_.end(), engine.name) == engines_.end())
    engines_.push_back(engine.name);
  for (std::size_t i = 0; i < c.queries.size() && i < answers.answers.size(); ++i)
    note(engine.name,
         fmt::format("{}: {}", to_string(c.queries[i].question), to_string(answers.answers[i].outcome)));
}

std::vector<CoverageGroup> Coverage::groups() const {
  std::vector<CoverageGroup> all = groups_of_cases();
  for (const std::string& engine : engines_) {
    CoverageGroup g{engine, "queries by what the engine made of them", {}};
    for (const auto& [value, count] : counts_.at(engine)) g.values.push_back(value);
    all.push_back(std::move(g));
  }
  return all;
}

std::uint64_t Coverage::count(const std::string& group, const std::string& value) const {
  const auto g = counts_.find(group);
  if (g == counts_.end()) return 0;
  const auto v = g->second.find(value);
  return v == g->second.end() ? 0 : v->second;
}

std::vector<std::pair<std::string, std::string>> Coverage::missed() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (const CoverageGroup& g : groups_of_cases())
    for (const std::string& value : g.values)
      if (count(g.name, value) == 0) all.emplace_back(g.name, value);
  return all;
}

}  // namespace touchstone::fuzz
