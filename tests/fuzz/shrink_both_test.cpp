// Shrinking keeps a case that a maintainer cannot wave away beside the smallest one.
#include "fuzz/shrink/shrink_both.h"

#include <algorithm>
#include <limits>
#include <set>

#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/keeps_finding.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Case two_boxes(double x) {
  Case c;
  c.scene.shapes = {Box{Vec3::Ones()}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation.x() = x;
  c.queries = {{Question::overlap, 0, 1}};
  return c;
}

Case moving_boxes(double x, double velocity) {
  Case c = two_boxes(x);
  c.scene.bodies[1].motion = Motion{Vec3(velocity, 0, 0), Vec3::Zero()};
  c.queries = {{Question::time_of_impact, 0, 1}};
  return c;
}

Case asking(Case c, Question q) {
  c.queries = {{q, 0, 1}};
  return c;
}

fuzz::StillShows while_true(std::function<bool(const Case&)> shows) {
  return [shows = std::move(shows)](std::span<const Case> cases) {
    std::vector<bool> r;
    for (const Case& c : cases) r.push_back(shows(c));
    return r;
  };
}

bool is_pair_of_boxes(const Case& c) {
  return c.scene.bodies.size() == 2 && std::holds_alternative<Box>(c.scene.shape_of(0)) &&
         std::holds_alternative<Box>(c.scene.shape_of(1)) && !c.queries.empty();
}

std::string first_key(const mutants::Mutant& m, const EnginePtr& engine, const Case& c) {
  const auto found = fuzz::findings_of({&c, 1}, engine)[0];
  for (const auto& [key, f] : found)
    if (f.fault == m.fault) return key;
  return "";
}

}  // namespace

TEST_CASE("bodies must be clearly apart or clearly overlap", "[shrink][defensible]") {
  CHECK(fuzz::is_defensible(two_boxes(1)));
  CHECK(fuzz::is_defensible(two_boxes(1.97)));
  CHECK(fuzz::is_defensible(two_boxes(2.03)));
  for (const double x : {1.99, 2.0, 2.01, 2 + 0x1p-40}) CHECK_FALSE(fuzz::is_defensible(two_boxes(x)));
  for (const Question q : {Question::candidates, Question::scene_contacts, Question::swept_candidates}) {
    CHECK(fuzz::is_defensible(asking(two_boxes(1), q)));
    CHECK(fuzz::is_defensible(asking(two_boxes(4), q)));
    CHECK_FALSE(fuzz::is_defensible(asking(two_boxes(2), q)));
  }
}

TEST_CASE("the steps of a script are examined where they put the bodies", "[shrink][defensible]") {
  Case c = asking(two_boxes(1), Question::candidates);
  const auto moved_to = [](double x) { return Step{Step::Op::move, 1, Pose{Vec3(x, 0, 0), {}}}; };
  c.scene.script = {{Step::Op::insert, 0, {}}, {Step::Op::insert, 1, {}}, {}, moved_to(3), {}};
  CHECK(fuzz::is_defensible(c));
  c.scene.script[3] = moved_to(2);
  CHECK_FALSE(fuzz::is_defensible(c));
  c.scene.script.pop_back();  // the move is not seen by any query
  CHECK(fuzz::is_defensible(c));
}

TEST_CASE("flat bodies and extreme numbers are not defensible", "[shrink][defensible]") {
  Case flat = two_boxes(1);
  flat.scene.shapes[0] = Box{Vec3(1, 1, 0)};
  CHECK_FALSE(fuzz::is_defensible(flat));
  Case hull = two_boxes(0.25);
  hull.scene.shapes[0] = make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK_FALSE(fuzz::is_defensible(hull));
  Case far = two_boxes(1);
  for (Body& b : far.scene.bodies) b.pose.translation.y() = 2048;
  CHECK_FALSE(fuzz::is_defensible(far));
  Case tilted = two_boxes(1);
  tilted.scene.bodies[0].pose.rotation.x = 1e-6;
  CHECK_FALSE(fuzz::is_defensible(tilted));
  Case not_a_number = asking(two_boxes(1), Question::candidates);
  not_a_number.scene.bodies[0].pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(fuzz::is_defensible(not_a_number));
}

TEST_CASE("an impact must be well inside the step and deep, or far from happening", "[shrink][defensible]") {
  CHECK(fuzz::is_defensible(moving_boxes(4, -3)));
  CHECK(fuzz::is_defensible(moving_boxes(4, -1)));
  CHECK(fuzz::is_defensible(moving_boxes(4, 1)));
  CHECK_FALSE(fuzz::is_defensible(moving_boxes(1, -1)));           // overlap at the start
  CHECK_FALSE(fuzz::is_defensible(moving_boxes(4, -2)));           // touch at the end
  CHECK_FALSE(fuzz::is_defensible(moving_boxes(4, -2.0078125)));   // meet just before the end
  CHECK_FALSE(fuzz::is_defensible(moving_boxes(2.03125, -1000)));  // meet just after the start
  Case graze = moving_boxes(4, -8);
  graze.scene.bodies[1].pose.translation.y() = 2 - 0.0078125;
  CHECK_FALSE(fuzz::is_defensible(graze));
}

TEST_CASE("a mesh overlaps by the depth in a triangle", "[shrink][defensible]") {
  Case c = two_boxes(0);
  TriangleMesh mesh;
  mesh.vertices = {{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  c.scene.shapes.emplace_back(mesh);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].is_static = true;
  CHECK(fuzz::is_defensible(c));
  c.scene.bodies[1].pose.translation.z() = 1;
  CHECK_FALSE(fuzz::is_defensible(c));
}

TEST_CASE("a mesh whose triangle is a point or a line is not defensible", "[shrink][defensible]") {
  Case c = two_boxes(0);
  c.scene.shapes.emplace_back(TriangleMesh{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  c.scene.bodies[0].shape = 1;
  c.scene.bodies[0].is_static = true;
  c.scene.bodies[1].pose.translation = Vec3(0, 0, 2);
  CHECK(fuzz::is_defensible(c));
  auto& vertices = std::get<TriangleMesh>(c.scene.shapes[1]).vertices;
  vertices[2] = Vec3(0, -1, 0);
  CHECK_FALSE(fuzz::is_defensible(c));
  vertices[1] = vertices[2] = vertices[0];
  CHECK_FALSE(fuzz::is_defensible(c));
}

TEST_CASE("two cubes that overlap by 1 do not only shrink to cubes that touch", "[shrink][defensible]") {
  Case c = two_boxes(1);
  c.scene.bodies[1].pose.translation = {0.875, 0.123, 0.3};
  const auto r = fuzz::shrink_both(c, while_true([](const Case& x) {
                                     return is_pair_of_boxes(x) && x.scene.bodies[1].pose.translation.x() < 3;
                                   }));
  CHECK_FALSE(fuzz::is_defensible(r.minimum.smallest));
  REQUIRE(r.defensible);
  CHECK(fuzz::is_defensible(r.defensible->smallest));
  CHECK(r.defensible->exit == fuzz::ShrinkExit::smallest);
  CHECK(r.minimum.exit == fuzz::ShrinkExit::smallest);
  CHECK(r.defensible->before == r.minimum.before);
  CHECK(r.defensible->after <= r.defensible->before);
}

TEST_CASE("a defensible case is reached from one that is not", "[shrink][defensible]") {
  const auto boxes = while_true(is_pair_of_boxes);
  Case flat = two_boxes(1);
  flat.scene.shapes[0] = Box{Vec3(1, 1, 0)};
  Case tiny = two_boxes(2);
  for (double* x : fuzz::lengths(tiny)) *x *= 1e-5;
  Case far = two_boxes(2);
  for (Body& b : far.scene.bodies) b.pose.translation.y() = 1e6;
  for (const Case& c : {two_boxes(2), two_boxes(2 + 1e-9), flat, tiny, far, moving_boxes(2, -1),
                        asking(two_boxes(2), Question::candidates)}) {
    REQUIRE_FALSE(fuzz::is_defensible(c));
    const auto r = fuzz::shrink_both(c, boxes);
    REQUIRE(r.defensible);
    CHECK(fuzz::is_defensible(r.defensible->smallest));
    CHECK(is_pair_of_boxes(r.defensible->smallest));
    CHECK_FALSE(r.defensible->after < r.minimum.after);
  }
}

TEST_CASE("no defensible case is invented, and the tries are limited", "[shrink][defensible]") {
  const auto touching = while_true(
      [](const Case& c) { return is_pair_of_boxes(c) && c.scene.bodies[1].pose.translation.x() == 2; });
  Case c = two_boxes(2);
  const auto r = fuzz::shrink_both(c, touching);
  CHECK(r.minimum.exit == fuzz::ShrinkExit::smallest);
  if (r.defensible) CHECK(fuzz::is_defensible(r.defensible->smallest));
  const auto never = fuzz::shrink_both(c, while_true([](const Case&) { return false; }));
  CHECK(never.minimum.exit == fuzz::ShrinkExit::not_shown);
  CHECK(never.minimum.smallest == c);
  CHECK_FALSE(never.defensible);
  std::size_t asked = 0;
  const fuzz::StillShows counted = [&](std::span<const Case> cases) {
    asked += cases.size();
    std::vector<bool> shows;
    for (const Case& x : cases) shows.push_back(x.scene.bodies.size() >= 8);
    return shows;
  };
  const Case large = fuzz::make_case(5, 3, "crowd");
  const auto limited = fuzz::shrink_both(large, counted, 40);
  CHECK(limited.minimum.exit == fuzz::ShrinkExit::out_of_tries);
  CHECK(asked <= 40 + 2 * 16);
  CHECK(asked <= limited.tried());
}

TEST_CASE("findings about lying engines keep their key in both forms", "[shrink][mutants][defensible]") {
  const std::set<std::string_view> chosen{
      "last_pair_dropped", "static_second_dropped", "sweep_stops_early",  "duplicate_overwrites",
      "overlap_always",    "overlap_deep_denied",   "distance_clamped",   "distance_radius_forgotten",
      "witness_swapped",   "normal_flipped",        "normal_of_centres",  "depth_halved",
      "depth_doubled",     "point_far_off",         "impact_early",       "impact_denied",
      "contact_dropped",   "zero_capsule_short",    "boxes_one_ulp_small"};
  std::size_t found = 0, defensible = 0;
  for (const mutants::Mutant& m : mutants::mutants()) {
    if (!chosen.contains(m.name)) continue;
    const EnginePtr engine = mutants::make_lying_engine(m);
    for (std::uint64_t i = 0; i < 64; ++i) {
      const Case c = fuzz::make_case(1, i, m.family);
      const std::string key = first_key(m, engine, c);
      if (key.empty()) continue;
      INFO(key << " in " << c.id);
      const auto still = fuzz::keeps_finding(engine, key);
      const auto r = fuzz::shrink_both(c, still, 2000);
      ++found;
      CHECK(still({&r.minimum.smallest, 1})[0]);
      CHECK(r.minimum.after < r.minimum.before);
      CHECK(r.tried() <= 2000 + 4 * 16);
      if (r.defensible) {
        ++defensible;
        CHECK(still({&r.defensible->smallest, 1})[0]);
        CHECK(fuzz::is_defensible(r.defensible->smallest));
        CHECK_FALSE(r.defensible->after < r.minimum.after);
      }
      break;
    }
  }
  CHECK(found == chosen.size());
  // The last two are about flat and about touching bodies.
  CHECK(defensible == chosen.size() - 2);
}

TEST_CASE("a fault that is small in its case is defensible in another", "[shrink][mutants][defensible]") {
  const auto& all = mutants::mutants();
  const auto m = std::find_if(all.begin(), all.end(),
                              [](const mutants::Mutant& x) { return x.name == "overlap_denied_above"; });
  REQUIRE(m != all.end());
  const EnginePtr engine = mutants::make_lying_engine(*m);
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Case c = fuzz::make_case(1, i, m->family);
    const std::string key = first_key(*m, engine, c);
    if (!key.ends_with(".small")) continue;
    INFO(key << " in " << c.id);
    CHECK_FALSE(fuzz::shrink_both(c, fuzz::keeps_finding(engine, key), 2000).defensible);
    const auto r = fuzz::shrink_both(c, fuzz::keeps_fault(engine, key), 2000);
    REQUIRE(r.defensible);
    CHECK(fuzz::is_defensible(r.defensible->smallest));
    const auto found = fuzz::findings_of({&r.defensible->smallest, 1}, engine)[0];
    REQUIRE(found.size() == 1);
    CHECK(found.begin()->first == key.substr(0, key.rfind('.')) + ".gross");
    return;
  }
  FAIL("the lie is not found");
}
