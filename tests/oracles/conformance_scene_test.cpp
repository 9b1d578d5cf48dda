// Broad phases driven through scripts, filters, and whole scenes.
#include <algorithm>
#include <set>

#include "tests/oracles/conformance.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

std::set<BodyPair> as_set(const std::vector<BodyPair>& pairs) { return {pairs.begin(), pairs.end()}; }

/// Spheres of radius 1 along x; body 4 is a box.
Scene row_of_bodies() {
  Scene s;
  s.shapes = {Sphere{1}, Box{Vec3(1, 1, 1)}};
  for (const double x : {0.0, 1.5, 3.0, 100.0}) s.bodies.push_back(at(0, Vec3(x, 0, 0)));
  s.bodies.push_back(at(1, Vec3(101.5, 0, 0)));
  return s;
}

bool has_broad_phase(const Subject& s) { return !s.is("libccd"); }

}  // namespace

TEST_CASE("candidates follow a script of insertions, moves and removals",
          "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  Scene scene = row_of_bodies();
  using Op = Step::Op;
  scene.script = {{Op::insert, 0, {}},
                  {Op::insert, 1, {}},
                  {Op::query, -1, {}},
                  {Op::insert, 2, {}},
                  {Op::insert, 3, Pose{Vec3(50, 0, 0), {}}},
                  {Op::insert, 4, {}},
                  {Op::query, -1, {}},
                  {Op::move, 3, Pose{Vec3(100, 0, 0), {}}},
                  {Op::remove, 1, {}},
                  {Op::query, -1, {}},
                  {Op::insert, 1, Pose{Vec3(200, 0, 0), {}}},
                  {Op::query, -1, {}}};
  const std::vector<std::set<BodyPair>> expected{{{0, 1}}, {{0, 1}, {1, 2}}, {{3, 4}}, {{3, 4}}};
  int asked = 0;
  for_each_engine([&](Subject s) {
    INFO("engine " << s.name);
    const Observation o = ask(s, case_of(scene, {{Question::candidates, 0, 0}})).answers[0];
    if (!has_broad_phase(s)) {
      CHECK(o.outcome == Outcome::unsupported);
      return;
    }
    INFO("outcome " << to_string(o.outcome) << " " << o.detail);
    REQUIRE(o.outcome == Outcome::answered);
    REQUIRE(o.candidate_pairs.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) CHECK(as_set(o.candidate_pairs[k]) == expected[k]);
    ++asked;
  });
  CHECK(asked >= 4);
}

TEST_CASE("asking twice gives the same answers and does not change the scene",
          "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  const Case c = case_of(row_of_bodies(), {{Question::candidates, 0, 0},
                                           {Question::scene_contacts, 0, 0},
                                           {Question::overlap, 0, 1},
                                           {Question::candidates, 0, 0},
                                           {Question::scene_contacts, 0, 0}});
  for_each_engine([&](Subject s) {
    INFO("engine " << s.name);
    const auto r = ask(s, c);
    CHECK(r.answers[0] == r.answers[3]);
    CHECK(r.answers[1] == r.answers[4]);
    CHECK(r.answers[2].overlap == true);
  });
}

TEST_CASE("filtered pairs are not reported", "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  Scene scene = row_of_bodies();
  scene.ignored = {{0, 1}};
  scene.bodies[3].group = scene.bodies[4].group = 7;
  int checked = 0;
  for_each_engine([&](Subject s) {
    if (!has_broad_phase(s)) return;
    ++checked;
    INFO("engine " << s.name);
    const auto r = ask(s, case_of(scene, {{Question::candidates, 0, 0}, {Question::scene_contacts, 0, 0}}));
    REQUIRE(r.answers[0].candidate_pairs.size() == 1);
    CHECK(as_set(r.answers[0].candidate_pairs[0]) == std::set<BodyPair>{{1, 2}});
    REQUIRE(r.answers[1].contacts.size() == 1);
    CHECK((r.answers[1].contacts[0].a == 1 && r.answers[1].contacts[0].b == 2));
  });
  if (checked == 0) test::skip("no engine with a broad phase is built in");
}

TEST_CASE("scene contacts are the overlapping pairs, normals from the smaller index",
          "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  Scene scene = row_of_bodies();
  std::swap(scene.bodies[0], scene.bodies[2]);  // now 0 is to the right of 1, and 1 to the right of 2
  int contacts = 0;
  for_each_engine([&](Subject s) {
    if (!has_broad_phase(s)) return;
    INFO("engine " << s.name);
    Observation o = ask(s, case_of(scene, {{Question::scene_contacts, 0, 0}})).answers[0];
    REQUIRE(o.outcome == Outcome::answered);
    std::sort(o.contacts.begin(), o.contacts.end(), [](const auto& p, const auto& q) { return p.a < q.a; });
    REQUIRE(o.contacts.size() == 3);
    const std::vector<BodyPair> pairs{{0, 1}, {1, 2}, {3, 4}};
    for (std::size_t i = 0; i < 3; ++i) {
      const SceneContact& c = o.contacts[i];
      INFO("contact " << c.a << ", " << c.b << " normal " << c.normal.transpose() << " depth " << c.depth);
      CHECK(BodyPair(c.a, c.b) == pairs[i]);
      CHECK(c.normal.x() * (i == 2 ? 1 : -1) > 0.98);
      CHECK(std::abs(c.depth - 0.5) < 0.02 + 2 * o.claimed_tolerance);
      ++contacts;
    }
  });
  CHECK(contacts >= 12);
}

TEST_CASE("the shapes of a group are parts of one body, and contacts name them",
          "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  Scene scene;
  scene.shapes = {Sphere{1}, Box{Vec3(1, 1, 1)}};
  const std::pair<double, double> places[] = {{0, 0}, {5, 0}, {10, 0}, {10, 1.5}, {0, 1.5}, {5, 3}};
  for (const auto& [x, y] : places) scene.bodies.push_back(at(0, Vec3(x, y, 0)));
  scene.bodies.push_back(at(1, Vec3(5, 4.5, 0)));  // of no group, in contact with the last one
  for (std::size_t i = 0; i < 6; ++i) scene.bodies[i].group = i < 3 ? 4 : 9;
  scene.bodies[0].pose.rotation = {0, 0, 1, 1};  // where a group's first part is turned
  scene.bodies[4].pose.rotation = {1, 2, 3, 4};
  const std::set<BodyPair> expected{{0, 4}, {2, 3}, {5, 6}};
  int checked = 0;
  for_each_engine([&](Subject s) {
    if (!has_broad_phase(s)) return;
    INFO("engine " << s.name);
    const Observation o = ask(s, case_of(scene, {{Question::scene_contacts, 0, 0}})).answers[0];
    REQUIRE(o.outcome == Outcome::answered);
    std::set<BodyPair> found;
    for (const SceneContact& c : o.contacts) {
      found.insert({c.a, c.b});
      CHECK(c.normal.y() > 0.98);
      CHECK(std::abs(c.depth - 0.5) < 0.02 + 2 * o.claimed_tolerance);
    }
    CHECK(found == expected);
    ++checked;
  });
  if (checked == 0) test::skip("no engine with a broad phase is built in");
}

TEST_CASE("a scene with a shape that an engine lacks is unsupported as a whole",
          "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  Scene scene = row_of_bodies();
  scene.shapes[1] = Ellipsoid{Vec3(1, 1, 1)};
  const Case c =
      case_of(scene, {{Question::candidates, 0, 0}, {Question::overlap, 0, 1}, {Question::overlap, 0, 4}});
  int checked = 0;
  for_each_engine([&](Subject s) {
    if (!s.is("bullet")) return;
    ++checked;
    INFO("engine " << s.name);
    const auto r = ask(s, c);
    CHECK(r.answers[0].outcome == Outcome::unsupported);
    CHECK(r.answers[1].outcome == Outcome::answered);
    CHECK(r.answers[2].outcome == Outcome::unsupported);
  });
  if (checked == 0) test::skip("Bullet is not built in");
}
