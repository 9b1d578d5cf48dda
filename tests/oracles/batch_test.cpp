// Engines that answer several cases at once: the same answers, and failures charged to the right question.
#include <string>

#include "tests/oracles/remote_fixture.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

constexpr int pair_count = 50, of_three_bodies = 20, bad_pair = 33;

// Spheres of increasing size; the case of_three_bodies cannot be part of a batch.
std::vector<Case> pair_cases(bool triggered = false) {
  std::vector<Case> all(pair_count);
  for (int i = 0; i < pair_count; ++i) {
    Case& c = all[static_cast<std::size_t>(i)];
    c.scene.shapes = {Sphere{1}, Sphere{0.5 + 0.01 * i}};
    c.scene.bodies.resize(i == of_three_bodies ? 3 : 2);
    c.scene.bodies[1].shape = 1;
    for (std::size_t b = 0; b < c.scene.bodies.size(); ++b)
      c.scene.bodies[b].pose.translation = Vec3(0.1 + static_cast<double>(b), 0.03 * i, 0);
    if (triggered && i == bad_pair) c.scene.bodies[0].pose.translation.x() = 666;
    c.queries = {{Question::overlap, 0, 1},
                 {Question::contact, 1, 0},
                 {Question::distance, 0, 1},
                 {Question::time_of_impact, 0, 1}};
  }
  return all;
}

RemoteSpec batch_spec(const char* engine) {
  return {host_path(), plugin_path("ts_batches"), engine, short_limits()};
}

constexpr std::int64_t stated_together = 5, stated_alone = 3;

bool same_answers(const CaseObservations& x, const CaseObservations& y) {
  return x.answers == y.answers && x.received == y.received;
}

}  // namespace

TEST_CASE("pairs are asked together, and get the answers that they get alone", "[oracles][batch]") {
  const auto all = pair_cases();
  for (const char* name : {"together", "floats"}) {
    RemoteEngine engine(batch_spec(name));
    const auto at_once = engine.run(all);
    int together = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      INFO(name << " case " << i);
      const auto alone = engine.run({&all[i], 1});
      CHECK(same_answers(at_once[i], alone[0]));
      CHECK(alone[0].answers[0].elapsed_ns == stated_alone);
      CHECK(alone[0].answers[3].detail == "spheres only");
      CHECK(at_once[i].answers[1].manifold.size() == (at_once[i].answers[1].overlap.value() ? 1 : 0));
      for (const CaseObservations& o : {at_once[i], alone[0]})
        for (const ManifoldPoint& p : o.answers[1].manifold)
          CHECK(p.id == (std::string(name) == "floats" ? std::optional<std::uint64_t>(17) : std::nullopt));
      CHECK(at_once[i].received.bodies[0].has_value() == (std::string(name) == "floats"));
      together += at_once[i].answers[0].elapsed_ns == stated_together;
      if (i == of_three_bodies) CHECK(at_once[i].answers[0].elapsed_ns == stated_alone);
    }
    // How many arrive together depends on when they are read; the first may be alone.
    CHECK(together >= pair_count - 5);
    CHECK(engine.restarts() == 0);
  }
}

TEST_CASE("questions asked again are asked alone", "[oracles][batch]") {
  const auto all = pair_cases();
  RemoteEngine engine(batch_spec("together"));
  for (const CaseObservations& c : engine.run_again(all)) CHECK(c.answers[0].elapsed_ns == stated_alone);
}

TEST_CASE("a failure within a batch is charged to the question that causes it", "[oracles][batch]") {
  const auto all = pair_cases(true);
  for (const auto& [name, outcome] : {std::pair("dies", Outcome::crashed), {"loops", Outcome::timed_out}}) {
    RemoteEngine engine(batch_spec(name));
    const auto results = engine.run(all);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const std::size_t q : {0U, 2U}) {
        INFO(name << " case " << i << " question " << q << ": " << results[i].answers[q].detail);
        CHECK(results[i].answers[q].outcome == (i == bad_pair ? outcome : Outcome::answered));
      }
    CHECK(results[bad_pair].answers[0].detail.find("did not recur") == std::string::npos);
    // The next run may have batches again.
    const auto healthy = pair_cases();
    CHECK(engine.run(healthy).back().answers[0].elapsed_ns == stated_together);
  }
}

TEST_CASE("a crash that happens in batches alone is charged once", "[oracles][batch]") {
  RemoteEngine engine(batch_spec("dies_together"));
  const auto all = pair_cases();
  int crashed = 0;
  for (const CaseObservations& c : engine.run(all))
    for (const Observation& o : c.answers)
      if (o.outcome == Outcome::crashed) {
        ++crashed;
        CHECK(o.detail.find("it did not recur when asked again") != std::string::npos);
      }
  CHECK(crashed == 1);
}

TEST_CASE("a batch that throws, or reports about a pair that is not there, is asked one by one",
          "[oracles][batch]") {
  const auto all = pair_cases();
  RemoteEngine plain(batch_spec("together"));
  const auto expected = plain.run(all);
  for (const char* name : {"throws_together", "strangers"}) {
    RemoteEngine engine(batch_spec(name));
    const auto results = engine.run(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      INFO(name << " case " << i);
      CHECK(same_answers(results[i], expected[i]));
      CHECK(results[i].answers[0].elapsed_ns == stated_alone);
    }
    CHECK(engine.restarts() == 0);
  }
}

TEST_CASE("a scene with a shape that the card does not list is not sent", "[oracles][batch][card]") {
  RemoteEngine engine(batch_spec("partial"));
  CHECK(engine.card().shapes == std::vector{ShapeKind::sphere, ShapeKind::box});
  auto all = pair_cases();
  all[7].scene.shapes[1] = Capsule{1, 1};
  const auto results = engine.run(all);
  for (std::size_t i = 0; i < all.size(); ++i)
    CHECK(results[i].answers[0].outcome == (i == 7 ? Outcome::unsupported : Outcome::answered));
  CHECK(results[7].answers[0].detail.find("does not list capsule") != std::string::npos);
}

TEST_CASE("a plug-in built with the header of version 1 works", "[oracles][abi]") {
  RemoteEngine engine({host_path(), plugin_path("ts_version_1"), "", short_limits()});
  CHECK(engine.card().name == "version 1");
  CHECK(engine.card().more_shapes == std::vector{ShapeKind::rounded_box});  // it was told the minor version
  const auto all = pair_cases();
  for (const CaseObservations& c : engine.run(all)) {
    CHECK(c.answers[0].outcome == Outcome::answered);
    CHECK(c.answers[0].detail == "version 1");
    CHECK(c.received.shapes[1] == Shape(Sphere{2}));
    CHECK(c.answers[2].outcome == Outcome::unsupported);
  }
}
