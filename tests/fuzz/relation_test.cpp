// Relations find what the referee cannot see, and never accuse an answer that the definition accepts.
#include <cstdio>
#include <filesystem>
#include <limits>

#include "fuzz/campaign/campaign.h"
#include "fuzz/judge/exact_map.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/relation.h"
#include "fuzz/shrink/keeps_finding.h"
#include "oracles/client/remote_engine.h"
#include "oracles/core/core_engine.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/skip.h"

using namespace touchstone;

namespace {

const mutants::Mutant& mutant(std::string_view name) {
  for (const auto& m : mutants::mutants())
    if (m.name == name) return m;
  throw std::logic_error("no such mutant");
}

struct Count {
  std::size_t derived = 0, broken = 0, explained = 0, only_relation = 0;
};

bool referee_finds_fault(const Case& c, const EngineCard& card, const CaseObservations& o) {
  fuzz::Truth truth(c.scene);
  for (const auto& j : fuzz::judge(c, card, o, truth))
    if (!j.faults.empty()) return true;
  return false;
}

// Every relation broken by disjoint intervals must have a wrong answer on one side.
void count_case(const Case& c, const EnginePtr& engine, Count& n) {
  const auto base = engine->run({&c, 1})[0];
  const fuzz::RelationInput in{c, engine->card(), base};
  for (const fuzz::Relation& r : fuzz::relations())
    for (const fuzz::Derived& d : r.derive(in)) {
      ++n.derived;
      const auto observed = engine->run({&d.c, 1})[0];
      const auto broken = fuzz::find_break(r, in, d, observed);
      if (!broken) continue;
      ++n.broken;
      if (broken->error_in_l == 0 || !d.body_of.empty()) {
        ++n.only_relation;  // a missing answer or a superfluous pair: no error to measure
        continue;
      }
      const bool wrong = referee_finds_fault(c, in.card, base) || referee_finds_fault(d.c, in.card, observed);
      n.explained += wrong;
      if (!wrong) UNSCOPED_INFO(in.card.name << " " << c.id << " " << r.name << ": " << broken->words);
    }
}

}  // namespace

TEST_CASE("the core breaks no relation", "[relations][core]") {
  const EnginePtr core = make_core_engine();
  Count n;
  for (std::uint64_t i = 0; i < 800; ++i) count_case(fuzz::make_case(3, i), core, n);
  INFO(n.derived << " derived cases");
  CHECK(n.derived > 4000);
  CHECK(n.broken == 0);
}

TEST_CASE("an engine that breaks a relation is also wrong by the referee, where it can tell", "[relations]") {
  std::size_t explained = 0;
  for (const char* name :
       {"depth_halved", "depth_absolute", "distance_relative", "errs_when_large", "distance_one_order",
        "jumps_when_touching", "casts_nothing", "normal_tilted", "overlap_deep_denied"}) {
    for (const auto& m : mutants::mutants()) {
      if (m.name != name) continue;
      Count n;
      const EnginePtr engine = mutants::make_lying_engine(m);
      for (std::uint64_t i = 0; i < 60; ++i) count_case(fuzz::make_case(4, i), engine, n);
      CHECK(n.explained + n.only_relation == n.broken);
      explained += n.explained;
    }
  }
  CHECK(explained > 100);
}

TEST_CASE("relations accuse other engines too only where the referee finds them wrong",
          "[relations][optional]") {
  const std::filesystem::path build = TS_BINARY_DIR;
  struct Row {
    const char *library, *engine;
  };
  std::size_t engines = 0, explained = 0;
  for (const Row& row :
       {Row{"libtouchstone_fcl.so", "fcl-libccd"}, Row{"libtouchstone_bullet_f64.so", "bullet-f64-query"},
        Row{"libtouchstone_libccd.so", "libccd-mpr"}}) {
    if (!std::filesystem::exists(build / "lib" / row.library)) {
      std::printf("left out: %s is not built\n", row.engine);
      continue;
    }
    const EnginePtr engine = std::make_unique<RemoteEngine>(
        RemoteSpec{build / "bin/touchstone-host", build / "lib" / row.library, row.engine, {}});
    Count n;
    for (std::uint64_t i = 0; i < 120; ++i) count_case(fuzz::make_case(8, i), engine, n);
    CHECK(n.explained + n.only_relation == n.broken);
    explained += n.explained;
    ++engines;
  }
  if (engines == 0) return test::skip("no other engine is built");
  if (engines == 3) CHECK(explained > 50);
}

TEST_CASE("only relations find some lies", "[relations][mutants]") {
  for (const char* name :
       {"declines_one_order", "declines_one_side", "declines_large", "errs_when_large", "declines_off_origin",
        "superfluous_by_order", "superfluous_once", "answers_once"}) {
    std::vector<EnginePtr> engine;
    engine.push_back(mutants::make_lying_engine(mutant(name)));
    std::vector<Case> cases;
    for (std::uint64_t i = 0; i < 300; ++i) cases.push_back(fuzz::make_case(1, i, mutant(name).family));
    fuzz::CampaignResult without, with;
    fuzz::ask_and_judge(without, cases, 0, engine, 0);
    fuzz::ask_and_judge(with, cases, 0, engine, 4);
    INFO(name);
    CHECK(without.findings.empty());
    CHECK(with.wrong_of(name) > 0);
  }
}

TEST_CASE("a broken relation shrinks and keeps its key", "[relations][shrink]") {
  const EnginePtr engine = mutants::make_lying_engine(mutant("errs_when_large"));
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Case c = fuzz::make_case(2, i, "separate");
    const auto found = fuzz::findings_of({&c, 1}, engine, fuzz::FoundBy::relations)[0];
    if (found.empty()) continue;
    const std::string key = found.begin()->first;
    const fuzz::Shrunk s = fuzz::shrink(c, fuzz::keeps_finding(engine, key));
    CHECK(s.exit == fuzz::ShrinkExit::smallest);
    CHECK(s.after < s.before);
    CHECK(fuzz::findings_of({&s.smallest, 1}, engine, fuzz::FoundBy::relations)[0].contains(key));
    return;
  }
  FAIL("nothing found to shrink");
}

TEST_CASE("an answer implies exactly the gaps that a right answer may have", "[relations]") {
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation.x() = 1.5;
  const EngineCard card{"test", "", "", "", 0, 0, "its documentation"};
  Observation o;
  o.outcome = Outcome::answered;
  o.overlap = true;
  o.claimed_tolerance = 0.125;
  const auto of = [&](Question q) { return fuzz::implied_gap(c.scene, {q, 0, 1}, o, card); };
  CHECK(of(Question::overlap).hi == 0.125);
  CHECK(of(Question::overlap).lo == -std::numeric_limits<double>::infinity());
  o.normal = Vec3(1, 0, 0);
  o.depth = 0.5;
  CHECK(of(Question::contact).lo == -0.625);
  CHECK(of(Question::contact).hi == -0.25);
  o.distance = -0.5;
  CHECK(of(Question::distance).lo == -0.625);
  CHECK(of(Question::distance).hi == -0.375);
  o.outcome = Outcome::unsupported;
  CHECK(of(Question::distance).says_nothing());
}

TEST_CASE("derived cases stay within the range of doubles, or are not asked", "[relations]") {
  Scene far;
  far.shapes = {make_hull({{1e308, 0, 0}, {0, 1e308, 0}, {0, 0, 1e308}, {-1e308, 0, 0}})};
  far.bodies.resize(2);
  Scene scaled = far;
  CHECK(!fuzz::scale_by(scaled, 0x1p20));
  CHECK(scaled.shapes == far.shapes);
  CHECK(fuzz::scale_by(scaled, 0x1p-12));
  CHECK(scaled.shapes != far.shapes);
  CHECK(fuzz::is_within_numbers(far, far));  // exchanged, permuted: as far out as its base
  CHECK(fuzz::is_within_numbers(far, scaled));
  Scene beyond = far;
  beyond.bodies[1].pose.translation = {1.5e308, 0, 0};
  CHECK(!fuzz::is_within_numbers(far, beyond));
  beyond.bodies[1].pose.translation = {infinity, 0, 0};
  CHECK(!fuzz::is_within_numbers(beyond, beyond));
}

TEST_CASE("the poses of a script change with those of its bodies", "[relations]") {
  Scene s;
  s.shapes = {Sphere{1}};
  s.bodies.resize(1);
  Pose at;
  at.translation = {3, 5, -7};
  s.script = {{Step::Op::insert, 0, std::nullopt}, {Step::Op::move, 0, at}, {}};
  const auto moved_to = [](const Scene& x) { return x.script[1].pose->translation; };
  Scene r = s;
  REQUIRE(fuzz::scale_by(r, 0x1p20));
  CHECK(moved_to(r) == Vec3(at.translation * 0x1p20));
  r = s;
  CHECK(fuzz::translate_by(r, Vec3(1, 1, 1)));
  CHECK(moved_to(r) == Vec3(4, 6, -6));
  r = s;
  fuzz::half_turn(r, 2);
  CHECK(moved_to(r) == Vec3(-3, -5, -7));
  r = s;
  REQUIRE(fuzz::cycle_axes(r));
  CHECK(moved_to(r) == Vec3(5, -7, 3));
  r = s;
  r.script[1].pose->translation.x() = 1e308;
  CHECK_FALSE(fuzz::scale_by(r, 0x1p20));
}

TEST_CASE("a pair is pushed apart only by a complete claim of an overlap", "[relations]") {
  Case c;
  c.scene.shapes = {Box{{1, 1, 1}}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation = {1.5, 0, 0};
  c.queries = {{Question::contact, 0, 1}};
  Observation complete;
  complete.outcome = Outcome::answered;
  complete.overlap = true;
  complete.normal = Vec3(1, 0, 0);
  complete.depth = 0.5;
  const auto pushed = [&](const Observation& o) {
    const CaseObservations base{{}, {o}};
    const EngineCard card{"test", "", "", "", 0x1p-53, 64, "a page"};
    return fuzz::derive_push({c, card, base}).size();
  };
  CHECK(pushed(complete) == 1);
  using Change = void (*)(Observation&);
  const Change changes[] = {[](Observation& o) { o.overlap.reset(); },
                            [](Observation& o) { o.overlap = false; },
                            [](Observation& o) { o.normal.reset(); },
                            [](Observation& o) { o.depth.reset(); },
                            [](Observation& o) { o.depth = std::numeric_limits<double>::infinity(); },
                            [](Observation& o) { o.normal = Vec3::Zero(); },
                            [](Observation& o) { o.outcome = Outcome::not_converged; }};
  for (const Change change : changes) {
    Observation o = complete;
    change(o);
    CHECK(pushed(o) == 0);
  }
}

TEST_CASE("only a time within the step is compared with the poses within the step", "[relations]") {
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation = {4, 0, 0};
  c.scene.bodies[1].motion = Motion{{-4, 0, 0}, Vec3::Zero()};
  c.queries = {{Question::time_of_impact, 0, 1}};
  const EngineCard card{"test", "", "", "", 0x1p-53, 64, "a page"};
  const auto derived_from = [&](double toi) {
    Observation o;
    o.outcome = Outcome::answered;
    o.toi = toi;
    const CaseObservations base{{}, {o}};
    return fuzz::derive_step({c, card, base});
  };
  // The spheres meet at 0.5: nothing follows about the poses after that, and nine are probed.
  const auto derived = derived_from(0.5);
  REQUIRE(derived.size() == 6);
  for (const fuzz::Derived& d : derived) CHECK(d.c.scene.bodies[1].pose.translation.x() >= 2);
  for (const double outside : {-0.5, 1.5, -std::numeric_limits<double>::infinity(), infinity,
                               std::numeric_limits<double>::quiet_NaN()}) {
    INFO(outside);
    CHECK(derived_from(outside).empty());
  }
}

TEST_CASE("the gradient that points imply is not claimed more exactly than the distance implies",
          "[relations]") {
  Case c;
  c.scene.shapes = {Box{{1, 1, 1}}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation = {2.5, 0.25, 0};
  c.queries = {{Question::distance, 0, 1}};
  const EngineCard card{"test", "", "", "", 0x1p-53, 64, "a page"};
  // Two faces 0.5 apart; the points lie beside each other by a share of the root of the engine's rounding.
  const auto is_broken = [&](double beside) {
    Observation o;
    o.outcome = Outcome::answered;
    o.distance = 0.5;
    o.witness = {Vec3(1, 0, 0), Vec3(1.5, beside, 0)};
    const CaseObservations base{{}, {o}};
    const fuzz::RelationInput in{c, card, base};
    const EnginePtr core = make_core_engine();
    for (const fuzz::Derived& d : fuzz::derive_slope(in))
      if (fuzz::find_break(fuzz::relations()[7], in, d, core->run({&d.c, 1})[0])) return true;
    return false;
  };
  REQUIRE(fuzz::relations()[7].name == "relation_slope");
  CHECK_FALSE(is_broken(0));
  CHECK_FALSE(is_broken(1e-8));
  CHECK(is_broken(0.25));
}
