// Time of impact: units, sign of rotation, who moves.
#include <algorithm>

#include "tests/oracles/conformance.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

struct MotionRow {
  const char* what;
  Scene scene;
  std::optional<double> t;
};

Scene moving(Scene s, const Vec3& linear_a, const Vec3& angular_a, const Vec3& linear_b = Vec3::Zero(),
             const Vec3& angular_b = Vec3::Zero()) {
  s.bodies[0].motion = Motion{linear_a, angular_a};
  s.bodies[1].motion = Motion{linear_b, angular_b};
  return s;
}

std::vector<MotionRow> motion_rows() {
  const Vec3 none = Vec3::Zero();
  // A sphere offset by 0.3 from the other's line of motion; contact when their centres are 1 apart.
  const double reach = std::sqrt(1 - 0.09);
  const Scene balls = pair_scene(Sphere{0.5}, Sphere{0.5}, Vec3(3, 0.3, 0));
  // A rod rotating towards a small sphere: its side reaches it when 0.8·sin(0.4 - angle) = 0.05 + 0.05.
  const Vec3 where(0.8 * std::cos(0.4), 0.8 * std::sin(0.4), 0.013);
  const Scene rod = pair_scene(Box{Vec3(1, 0.05, 0.05)}, Sphere{0.05}, where);
  const double t_rod = (0.4 - std::asin(0.1 / 0.8)) / 0.6;
  const TriangleMesh square{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Scene drop = pair_scene(square, Box{Vec3(0.3, 0.3, 0.25)}, Vec3(0.2, 0.1, 1.25));
  return {{"A flies", moving(balls, Vec3(4, 0, 0), none), (3 - reach) / 4},
          {"B flies", moving(balls, none, none, Vec3(-4, 0, 0)), (3 - reach) / 4},
          {"both fly", moving(balls, Vec3(2, 0, 0), none, Vec3(-2, 0, 0)), (3 - reach) / 4},
          {"away", moving(balls, Vec3(-4, 0, 0), none), std::nullopt},
          {"too short", moving(balls, Vec3(1, 0, 0), none), std::nullopt},
          {"a box falls on a mesh", moving(drop, none, none, Vec3(0, 0, -2)), 0.5},
          {"a mesh rises to a box", moving(drop, Vec3(0, 0, 2), none), 0.5},
          {"A turns", moving(rod, none, Vec3(0, 0, 0.6)), t_rod},
          {"A turns the other way", moving(rod, none, Vec3(0, 0, -0.6)), std::nullopt}};
}

/// FCL takes ten samples over the step and reports the first one in contact.
double lateness(const Subject& s) { return s.is("fcl") && !s.has("tuned") ? 1.0 / 9 : 0; }

/// FCL's table of conservative advancement lists meshes, and the search then finds no impact.
bool is_known_defect(const Subject& s, const MotionRow& row) {
  return s.is("fcl") && s.has("tuned") &&
         std::any_of(row.scene.shapes.begin(), row.scene.shapes.end(),
                     [](const Shape& shape) { return kind_of(shape) == ShapeKind::mesh; });
}

void check(Subject& s, const MotionRow& row) {
  if (is_known_defect(s, row)) return;
  INFO("engine " << s.name << ": " << row.what);
  const Observation o = ask(s, case_of(row.scene, {{Question::time_of_impact, 0, 1}})).answers[0];
  INFO("outcome " << to_string(o.outcome) << " " << o.detail);
  if (s.is("libccd") || s.has("-sim")) {
    CHECK(o.outcome == Outcome::unsupported);
    return;
  }
  REQUIRE(o.outcome == Outcome::answered);
  REQUIRE(o.toi.has_value() == row.t.has_value());
  if (!row.t) return;
  INFO("t " << *o.toi << ", true " << *row.t);
  CHECK(*o.toi >= *row.t - 0.03);  // margins and 0.001 of gap at the slowest closing speed
  CHECK(*o.toi <= *row.t + lateness(s) + 0.01);
}

}  // namespace

TEST_CASE("impacts happen at the right time, whichever body moves", "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  int checked = 0;
  for_each_engine([&](Subject s) {
    for (const MotionRow& row : motion_rows()) {
      check(s, row);
      MotionRow swapped = row;
      std::swap(swapped.scene.bodies[0], swapped.scene.bodies[1]);
      check(s, swapped);
      checked += 2;
    }
  });
  CHECK(checked == static_cast<int>(built_plugins().size()) * 4 * 18);
}

TEST_CASE("motions that an engine cannot express are unsupported", "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  const Scene s = pair_scene(Box{Vec3(1, 0.1, 0.1)}, Box{Vec3(1, 0.1, 0.1)}, Vec3(3, 0.3, 0));
  const Case half_turn =
      case_of(moving(s, Vec3::Zero(), Vec3(0, 0, 3.2)), {{Question::time_of_impact, 0, 1}});
  const Case both = case_of(moving(s, Vec3::Zero(), Vec3(0, 0, 0.2), Vec3::Zero(), Vec3(0, 0.2, 0)),
                            {{Question::time_of_impact, 0, 1}});
  for_each_engine([&](Subject e) {
    INFO("engine " << e.name);
    CHECK(ask(e, half_turn).answers[0].outcome == Outcome::unsupported);
    if (e.is("bullet")) CHECK(ask(e, both).answers[0].outcome == Outcome::unsupported);
  });
}
