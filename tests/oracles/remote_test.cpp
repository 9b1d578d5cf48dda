// Every way in which an engine can misbehave while answering: it is charged to the running query, and nothing
// else is lost.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/oracles/remote_fixture.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

constexpr int case_count = 40;
constexpr int bad_case = 17;

struct Expectation {
  const char* engine;
  Outcome outcome;
  const char* detail;  // what the detail must contain
  int restarts;
};

/// Counts the answers that are the same as without any misbehaviour.
int good_answers(const std::vector<Case>& cases, const std::vector<CaseObservations>& results) {
  int good = 0;
  REQUIRE(results.size() == cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    REQUIRE(results[i].answers.size() == cases[i].queries.size());
    for (std::size_t k = 0; k < cases[i].queries.size(); ++k)
      good += is_good(results[i].answers[k], static_cast<int>(i), cases[i].queries[k]);
  }
  return good;
}

}  // namespace

TEST_CASE("one misbehaving query costs one answer and no more", "[oracles][remote]") {
  const std::vector<Expectation> expectations{
      {"loops", Outcome::timed_out, "CPU time", 1},
      {"sleeps", Outcome::timed_out, "wall time", 1},
      {"aborts", Outcome::crashed, "SIGABRT: bad: assertion failed", 1},
      {"segfaults", Outcome::crashed, "SIGSEGV", 1},
      {"overflows", Outcome::crashed, "", 1},
      {"throws", Outcome::threw, "no such luck", 0},
      {"throws_int", Outcome::threw, "other than a std::exception", 0},
      {"eats_memory", Outcome::crashed, "memory limit", 1},
      {"exits", Outcome::crashed, "exit code 0", 1},
      {"exits_3", Outcome::crashed, "exit code 3", 1},
      {"sprays", Outcome::crashed, "rubbish", 1},
      {"closes", Outcome::crashed, "closed its answer stream", 1},
      {"bad_outcome", Outcome::invalid_answer, "outcome that does not exist", 0},
      {"bad_pair", Outcome::invalid_answer, "bodies that do not exist", 0}};
  int reached = 0;
  for (const Expectation& e : expectations) {
    INFO("engine " << e.engine);
    RemoteEngine engine(bad_spec(e.engine));
    const auto cases = make_cases(case_count, bad_case);
    const auto results = engine.run(cases);
    CHECK(good_answers(cases, results) == 3 * case_count - 1);
    const Observation& bad = results[bad_case].answers[1];
    CHECK(bad.outcome == e.outcome);
    CHECK(bad.detail.find(e.detail) != std::string::npos);
    INFO("detail: " << bad.detail);
    CHECK(engine.restarts() == e.restarts);
    ++reached;
  }
  CHECK(reached == 14);
}

TEST_CASE("an exception carries the place that its text names", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("throws_at"));
  const auto results = engine.run(make_cases(case_count, bad_case));
  const Observation& bad = results.at(bad_case).answers.at(1);
  CHECK(bad.outcome == Outcome::threw);
  CHECK(bad.site == "gjk-inl.h:1270");
}

// Its output reaches all descriptors of the process, which depend on how the test was started. The harness
// may see an endless message or garbage. Either way it allocates nothing for it and loses one answer.
TEST_CASE("a frame that announces a gigabyte costs one answer and no memory", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("announces"));
  const auto cases = make_cases(case_count, bad_case);
  const auto results = engine.run(cases);
  CHECK(good_answers(cases, results) == 3 * case_count - 1);
  const Outcome bad = results[bad_case].answers[1].outcome;
  CHECK((bad == Outcome::timed_out || bad == Outcome::crashed));
  CHECK(engine.restarts() == 1);
}

TEST_CASE("an engine may print megabytes to stdout and stderr", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("prints"));
  const auto cases = make_cases(case_count, bad_case);
  CHECK(good_answers(cases, engine.run(cases)) == 3 * case_count);
  CHECK(engine.restarts() == 0);
}

TEST_CASE("NaN and infinity are answers, and travel unchanged", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("answers_nan"));
  const auto cases = make_cases(3, 1);
  const auto results = engine.run(cases);
  const Observation& o = results[1].answers[1];
  REQUIRE(o.outcome == Outcome::answered);
  REQUIRE((o.distance && o.depth && o.normal));
  CHECK(std::isnan(*o.distance));
  CHECK(std::isnan(*o.depth));
  CHECK(std::isinf(o.normal->x()));
}

TEST_CASE("a detail without a terminating zero is cut at its field", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("long_detail"));
  const auto cases = make_cases(2, 1);
  CHECK(engine.run(cases)[1].answers[1].detail == std::string(128, 'd'));
}

TEST_CASE("a failure to load a scene is charged only to that scene", "[oracles][remote]") {
  const std::vector<Expectation> expectations{
      {"aborts_in_load", Outcome::crashed, "SIGABRT", 1},
      {"loops_in_load", Outcome::timed_out, "CPU time while loading the scene", 1},
      {"refuses_load", Outcome::invalid_input, "not this scene", 0},
      {"reports_strangers", Outcome::invalid_answer, "that the scene does not have", 0}};
  for (const Expectation& e : expectations) {
    INFO("engine " << e.engine);
    RemoteEngine engine(bad_spec(e.engine));
    const auto cases = make_cases(case_count, bad_case);
    const auto results = engine.run(cases);
    CHECK(good_answers(cases, results) == 3 * (case_count - 1));
    for (const Observation& o : results[bad_case].answers) {
      CHECK(o.outcome == e.outcome);
      CHECK(o.detail.find(e.detail) != std::string::npos);
    }
    CHECK(engine.restarts() == e.restarts);
  }
}

TEST_CASE("a crash is named by its site, the same every time", "[oracles][remote]") {
  const std::pair<const char*, const char*> expected[] = {
      {"writes_nowhere", "libts_bad_behaviours:bad_writes_nowhere"},
      {"calls_nothing", "libts_bad_behaviours:bad_calls_nothing"},
      {"asserts", "behaviours.cpp:"}};
  for (const auto& [name, site] : expected) {
    INFO("engine " << name);
    std::vector<std::string> sites, details;
    for (int run = 0; run < 2; ++run) {
      RemoteEngine engine(bad_spec(name));
      const Case c = make_case(0, true);
      const Observation o = engine.run({&c, 1})[0].answers[1];
      INFO(o.detail);
      CHECK(o.outcome == Outcome::crashed);
      CHECK(o.site.starts_with(site));
      sites.push_back(o.site);
      details.push_back(o.detail);
    }
    CHECK(sites[0] == sites[1]);
    CHECK(details[0] == details[1]);  // no addresses
  }
}

TEST_CASE("unwritten memory has reproducible contents, which differ when asked again", "[oracles][remote]") {
#ifdef TS_ADDRESS_SANITIZER  // it fills the heap itself
  const std::vector<const char*> names{"reads_the_stack"};
#else
  const std::vector<const char*> names{"reads_the_stack", "reads_the_heap"};
#endif
  for (const char* name : names) {
    INFO("engine " << name);
    RemoteEngine engine(bad_spec(name));
    const std::vector<Case> cases = make_cases(3, 1);
    const double first = *engine.run(cases)[1].answers[1].distance;
    const auto again = engine.run_again(cases);
    CHECK(first == 0);
    CHECK(*again[1].answers[1].distance > 1e6);
    CHECK(good_answers(cases, again) == 8);
    CHECK(*engine.run(cases)[1].answers[1].distance == 0);
  }
}

TEST_CASE("an answer that exceeds its time limit is kept and marked slow", "[oracles][remote]") {
  const Case c = make_case(0, true);
  RemoteSpec spec = bad_spec("ponders");
  CHECK(RemoteEngine(spec).run({&c, 1})[0].answers[1].outcome == Outcome::timed_out);
  spec.limits.patience = 100;
  const auto answers = RemoteEngine(spec).run({&c, 1})[0].answers;
  CHECK(answers[1].outcome == Outcome::answered);
  CHECK(answers[1].slow);
  CHECK_FALSE(answers[0].slow);
  Observation quick = answers[1];
  quick.slow = false;
  CHECK(quick == answers[1]);
}

TEST_CASE("an engine may report that it holds another shape", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("holds_others"));
  const auto cases = make_cases(2, 1);
  const auto results = engine.run(cases);
  CHECK_FALSE(results[0].received.shapes[0]);
  REQUIRE(results[1].received.shapes[0]);
  const Hull& held = std::get<Hull>(*results[1].received.shapes[0]);
  CHECK(held.vertices.size() == 4);
  CHECK(held.dimension == 3);
  CHECK(good_answers(cases, results) == 6);
}

TEST_CASE("every case of a batch may kill its worker", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("segfaults"));
  std::vector<Case> cases;
  for (int i = 0; i < 25; ++i) cases.push_back(make_case(i, true));
  const auto results = engine.run(cases);
  // (0,1) is asked before and (1,2) after the crash.
  CHECK(good_answers(cases, results) == 2 * 25);
  for (const auto& r : results) {
    CHECK(r.answers[0].outcome == Outcome::answered);
    CHECK(r.answers[1].outcome == Outcome::crashed);
    CHECK(r.answers[2].outcome == Outcome::answered);
  }
  CHECK(engine.restarts() == 25);
}

TEST_CASE("received placements arrive exactly, and again after a restart", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("segfaults"));
  const auto cases = make_cases(5, 2);
  const auto results = engine.run(cases);
  int seen = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t b = 0; b < 3; ++b) {
      REQUIRE(results[i].received.bodies[b]);
      CHECK(results[i].received.bodies[b]->translation == cases[i].scene.bodies[b].pose.translation);
      ++seen;
    }
  CHECK(seen == 15);
}

TEST_CASE("queries about bodies that do not exist are refused without asking the engine",
          "[oracles][remote]") {
  RemoteEngine engine(bad_spec("segfaults"));
  auto cases = make_cases(2, -1);
  cases[0].queries = {{Question::overlap, 0, 3}, {Question::contact, -1, 1}, {Question::distance, 1, 1}};
  const auto results = engine.run(cases);
  for (const Observation& o : results[0].answers) CHECK(o.outcome == Outcome::invalid_input);
  CHECK(engine.restarts() == 0);
}

TEST_CASE("empty batches, empty scenes and cases without queries are complete", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("good"));
  CHECK(engine.run({}).empty());
  auto cases = make_cases(4, -1);
  cases[0].queries.clear();
  cases[3].queries.clear();
  const auto results = engine.run(cases);
  REQUIRE(results.size() == 4);
  CHECK(results[0].answers.empty());
  CHECK(is_good(results[1].answers[0], 1, cases[1].queries[0]));
  CHECK(results[3].answers.empty());
}

TEST_CASE("a batch larger than all pipes together does not deadlock", "[oracles][remote]") {
  RemoteEngine engine(bad_spec("good"));
  std::vector<Case> cases = make_cases(3, -1);
  std::vector<Vec3> points;
  for (int i = 0; i < 60000; ++i) points.emplace_back(std::cos(i), std::sin(i), i % 7);
  for (Case& c : cases) {
    c.scene.shapes.push_back(TriangleMesh{points, {{0, 1, 2}}});  // 1.4 MB per case
    c.queries.clear();
    for (int k = 0; k < 20000; ++k) c.queries.push_back({Question::overlap, 0, 1});  // 1.6 MB of answers
  }
  const auto results = engine.run(cases);
  int answered = 0;
  for (const auto& r : results)
    for (const auto& o : r.answers) answered += o.outcome == Outcome::answered;
  CHECK(answered == 60000);
}
