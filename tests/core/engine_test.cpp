// The core behind the engine interface: complete, and no exception escapes.
#include <array>

#include "core/broad/catalog.h"
#include "core/math/through_float.h"
#include "oracles/core/core_engine.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

TEST_CASE("the core engine answers every question of a case, in order", "[engine]") {
  Case c;
  c.scene.shapes = {Sphere{1}, HalfSpace{}};
  c.scene.bodies.resize(3);
  c.scene.bodies[1].pose.translation = Vec3(1.5, 0, 0.5);
  c.scene.bodies[2].shape = 1;
  c.scene.bodies[2].is_static = true;
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

TEST_CASE("every number that the float core has received is a float", "[engine][float]") {
  Case c;
  const Vec3 odd(1.0 / 3, 0.1, 0.7);
  c.scene.shapes = {Box{odd}, make_hull({odd, -odd, Vec3(0.1, -0.7, 0.3), Vec3(-0.9, 0.2, 0.1)}),
                    Ellipsoid{odd}, Capsule{1.0 / 3, 0.1}};
  c.scene.bodies.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    c.scene.bodies[i].shape = static_cast<int>(i);
    c.scene.bodies[i].pose.translation = odd * 3;
  }
  c.queries = {{Question::overlap, 0, 1}};
  const auto answers = CoreEngine(Arithmetic::float32).run(std::span(&c, 1));
  const ReceivedScene& r = answers.at(0).received;
  CHECK(std::get<Box>(*r.shapes.at(0)).half_extents == through_float(odd));
  CHECK(std::get<Hull>(*r.shapes.at(1)).vertices[0] == through_float(odd));
  CHECK(std::get<Ellipsoid>(*r.shapes.at(2)).semi_axes == through_float(odd));
  CHECK(std::get<Capsule>(*r.shapes.at(3)).radius == through_float(1.0 / 3));
  for (std::size_t i = 0; i < 4; ++i) CHECK(r.bodies.at(i)->translation == through_float(odd * 3));
  CHECK(through_float(odd) != odd);
}

TEST_CASE("a time of impact of two static bodies is answered like any other", "[engine]") {
  Case c;
  c.scene.shapes = {Box{{1, 1, 1}}};
  c.scene.bodies.resize(3);
  c.scene.bodies[1].pose.translation = {1.5, 0, 0};
  c.scene.bodies[2].pose.translation = {9, 0, 0};
  for (Body& b : c.scene.bodies) b.is_static = true;
  c.queries = {{Question::time_of_impact, 0, 1}, {Question::time_of_impact, 0, 2}};
  for (const auto& engine : {make_core_engine(), std::unique_ptr<Engine>(make_kept_engine())}) {
    INFO(engine->card().name);
    const auto answers = engine->run(std::span(&c, 1)).at(0).answers;
    CHECK(answers[0].toi == 0.0);
    CHECK(answers[1].outcome == Outcome::answered);
    CHECK_FALSE(answers[1].toi.has_value());
  }
}

TEST_CASE("with acceleration structures and caches the core answers what it answers without", "[engine]") {
  const auto core = make_core_engine();
  const auto kept = make_kept_engine();
  std::array<int, question_names.size()> answered{};
  for (std::uint64_t i = 0; i < 1600; ++i) {
    const Case c = fuzz::make_case(1, i);
    const auto plain = core->run({&c, 1}), cached = kept->run({&c, 1});
    for (std::size_t q = 0; q < c.queries.size(); ++q) {
      INFO(c.id << ' ' << to_string(c.queries[q].question));
      if (plain[0].answers[q].outcome != Outcome::answered) continue;
      ++answered[static_cast<std::size_t>(c.queries[q].question)];
      CHECK(cached[0].answers[q].outcome == Outcome::answered);
    }
  }
  for (const int n : answered) CHECK(n > 5);
}

TEST_CASE("extended precision alone agrees with the core", "[engine]") {
  const auto core = make_core_engine();
  const auto extended = make_native_core("core-extended");
  REQUIRE(extended);
  int overlaps = 0, distances = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Case c = fuzz::make_case(2, i);
    const auto usual = core->run({&c, 1}), other = extended->run({&c, 1});
    for (std::size_t q = 0; q < c.queries.size(); ++q) {
      const Observation &x = usual[0].answers[q], &y = other[0].answers[q];
      if (x.outcome != Outcome::answered || y.outcome != Outcome::answered) continue;
      INFO(c.id << ' ' << to_string(c.queries[q].question));
      if (c.queries[q].question == Question::overlap) {
        ++overlaps;
        CHECK(x.overlap == y.overlap);
      }
      if (c.queries[q].question == Question::distance) {
        ++distances;
        REQUIRE(y.distance);
        CHECK(std::abs(*x.distance - *y.distance) <=
              0x1p-40 * scale_of_pair(c.scene, c.queries[q].a, c.queries[q].b));
      }
    }
  }
  CHECK(overlaps > 50);
  CHECK(distances > 50);
}

TEST_CASE("every broad phase of the catalog reports the core's pairs in scripts, moved alone or together",
          "[engine]") {
  const auto core = make_core_engine();
  std::size_t single_moves = 0, several_moves = 0;
  for (const broad::CatalogRow& row : broad::catalog) {
    const auto phase = make_native_core(native_name(row.name, BroadBoxes::bodies));
    INFO(row.name);
    REQUIRE(phase);
    for (std::uint64_t i = 0; i < 60; ++i) {
      Case c = fuzz::make_case(3, i, "script");
      c.queries = {{Question::candidates, -1, -1}};
      std::size_t moves = 0;
      for (const Step& s : c.scene.script) {
        moves = s.op == Step::Op::move ? moves + 1 : 0;
        single_moves += moves == 1;
        several_moves += moves > 1;
      }
      const auto usual = core->run({&c, 1}), other = phase->run({&c, 1});
      INFO(c.id);
      REQUIRE(usual[0].answers[0].outcome == Outcome::answered);
      CHECK(other[0].answers[0].candidate_pairs == usual[0].answers[0].candidate_pairs);
    }
  }
  CHECK(single_moves > 100);
  CHECK(several_moves > 100);
}
