// The core behind the engine interface: complete, and no exception gets out.
#include "oracles/core/core_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;

TEST_CASE("the core engine answers every question of a case, in order", "[engine]") {
  Case c;
  c.scene.shapes = {Sphere{1}, HalfSpace{}};
  c.scene.bodies.resize(3);
  c.scene.bodies[1].pose.translation = Vec3(1.5, 0, 0.5);
  c.scene.bodies[2].shape = 1, c.scene.bodies[2].is_static = true;
  for (int q = 0; q < 6; ++q) c.queries.push_back({static_cast<Question>(q), 0, 1});
  c.queries.push_back({Question::overlap, 0, 9});
  c.queries.push_back({Question::distance, 2, 2});
  const auto engine = make_core_engine();
  const auto r = engine->run(std::span(&c, 1));
  REQUIRE(r.size() == 1);
  REQUIRE(r[0].answers.size() == 8);
  const auto& a = r[0].answers;
  CHECK(a[0].overlap == true);
  CHECK(*a[1].distance < 0);
  CHECK(a[1].witness.has_value());
  CHECK(a[2].normal.has_value());
  CHECK(a[2].manifold.size() == 1);
  CHECK(a[3].toi == 0.0);
  CHECK(a[4].candidate_pairs == std::vector<std::vector<BodyPair>>{{{0, 1}, {0, 2}, {1, 2}}});
  CHECK(a[5].contacts.size() == 3);
  CHECK(a[6].outcome == Outcome::invalid_input);
  CHECK(a[7].outcome == Outcome::unsupported);
  CHECK(engine->card().name == "core");
  CHECK(engine->card().tau_factor == 128);
}
