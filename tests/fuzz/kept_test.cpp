// What reducing keeps: the fault, the library's routine, motion or rest; and of two contradicting forms, the
// wrong one.
#include "fuzz/causes/kept.h"

#include <algorithm>
#include <string>

#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/causes/causes.h"
#include "fuzz/causes/plain_cases.h"
#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/shrink_both.h"
#include "oracles/core/core_engine.h"
#include "scenarios/codec/case_codec.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"

using namespace touchstone;
using fuzz::FaultStage;

namespace {

// Says the opposite of the truth about overlap, and that nothing ever meets.
class Opposite final : public Engine {
 public:
  const EngineCard& card() const override { return core_.card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = core_.run(cases);
    for (CaseObservations& of_case : all)
      for (Observation& o : of_case.answers) {
        if (o.overlap) o.overlap = !*o.overlap;
        o.toi.reset();
      }
    return all;
  }

 private:
  CoreEngine core_;
};

Case pair_case(const Shape& a, const Shape& b, double at, Question q) {
  Case c;
  c.scene.shapes = {a, b};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = {at, 0, 0};
  c.queries = {{q, 0, 1}};
  return c;
}

// The finding that the engine shows in the case.
fuzz::Finding finding_in(const Case& c, const EnginePtr& engine) {
  const auto found = fuzz::findings_of({&c, 1}, engine).at(0);
  REQUIRE(found.size() == 1);
  return found.begin()->second;
}

// Of a library with a routine for each pair of shapes.
fuzz::EngineKnowledge routine_for_each_pair() {
  fuzz::EngineKnowledge k = fuzz::no_knowledge();
  k.route_of = [](const std::string&, Question, ShapeKind a, ShapeKind b) {
    return std::string(type_name(a)) + "-" + std::string(type_name(b));
  };
  k.knows_routes = [](const std::string&) { return true; };
  return k;
}

EnginePtr liar(const std::string& name) {
  for (const mutants::Mutant& m : mutants::mutants())
    if (m.name == name) return mutants::make_lying_engine(m);
  return nullptr;
}

}  // namespace

TEST_CASE("reducing keeps the direction of a wrong verdict, and the routine", "[causes][shrink]") {
  const EnginePtr engine = std::make_unique<Opposite>();
  const fuzz::EngineKnowledge knowledge = routine_for_each_pair();
  const Box box{Vec3(0.5, 0.5, 0.5)};
  const Case ghost = pair_case(box, box, 3, Question::overlap),
             missed = pair_case(box, box, 0.5, Question::overlap),
             spheres = pair_case(Sphere{0.5}, Sphere{0.5}, 3, Question::overlap);
  const auto keeps = [&](const Case& base) {
    const fuzz::Kept kept = fuzz::kept_of(base, finding_in(base, engine), engine, knowledge);
    const Case all[] = {ghost, missed, spheres};
    return fuzz::keeps(engine, kept, knowledge)(all);
  };
  CHECK(finding_in(ghost, engine).fault == "ghost");
  CHECK(keeps(ghost) == std::vector<bool>{true, false, false});
  CHECK(keeps(missed) == std::vector<bool>{false, true, false});
  CHECK(keeps(spheres) == std::vector<bool>{false, false, true});
  const fuzz::Kept kept = fuzz::kept_of(ghost, finding_in(ghost, engine), engine, knowledge);
  const auto shrunk = fuzz::shrink_both(ghost, fuzz::keeps(engine, kept, knowledge), 500);
  CHECK(finding_in(shrunk.minimum.smallest, engine).fault == "ghost");
  REQUIRE(shrunk.defensible);
  CHECK(finding_in(shrunk.defensible->smallest, engine).key() == finding_in(ghost, engine).key());

  // Where routines are guessed, a case on another route shows the fault as well.
  fuzz::EngineKnowledge guessed = routine_for_each_pair();
  guessed.knows_routes = fuzz::no_knowledge().knows_routes;
  const Case all[] = {ghost, missed, spheres};
  CHECK(fuzz::keeps(engine, fuzz::kept_of(ghost, finding_in(ghost, engine), engine, guessed), guessed)(all) ==
        std::vector<bool>{true, false, true});
}

TEST_CASE("reducing keeps what moves moving, and what rests at rest", "[causes][shrink]") {
  const EnginePtr engine = std::make_unique<Opposite>();
  const fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
  Case moving = pair_case(Sphere{0.5}, Sphere{0.5}, 1.5, Question::time_of_impact);
  moving.scene.bodies[1].motion = Motion{Vec3(-1, 0, 0), Vec3(0, 0, 0)};
  Case resting = pair_case(Sphere{0.5}, Sphere{0.5}, 0.5, Question::time_of_impact);
  resting.scene.bodies[1].motion = Motion{};
  for (const Case& base : {moving, resting}) {
    const fuzz::Kept kept = fuzz::kept_of(base, finding_in(base, engine), engine, knowledge);
    const bool moves = base == moving;
    CHECK(kept.moves == moves);
    const Case both[] = {moving, resting};
    CHECK(fuzz::keeps(engine, kept, knowledge)(both) == std::vector<bool>{moves, !moves});
  }
  // About a pose, a motion says nothing.
  Case pose = pair_case(Sphere{0.5}, Sphere{0.5}, 0.5, Question::overlap);
  pose.scene.bodies[1].motion = Motion{Vec3(-1, 0, 0), Vec3(0, 0, 0)};
  CHECK(fuzz::kept_of(pose, finding_in(pose, engine), engine, knowledge).moves == false);
}

TEST_CASE("reducing keeps whether bodies part from the start, where that is documented", "[causes][shrink]") {
  const EnginePtr engine = std::make_unique<Opposite>();
  Case parting = pair_case(Sphere{0.5}, Sphere{0.5}, 0.5, Question::time_of_impact), meeting = parting;
  parting.scene.bodies[1].motion = Motion{Vec3(1, 0, 0), Vec3(0, 0, 0)};
  meeting.scene.bodies[1].motion = Motion{Vec3(-1, 0, 0), Vec3(0, 0, 0)};
  const Case both[] = {parting, meeting};
  fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
  const auto keeps = [&](const Case& base) {
    return fuzz::keeps(engine, fuzz::kept_of(base, finding_in(base, engine), engine, knowledge),
                       knowledge)(both);
  };
  CHECK(keeps(parting) == std::vector<bool>{true, true});
  knowledge.documented = [](const std::string&, const fuzz::Symptom&, const std::string&, Fault,
                            bool of_parting) { return std::string(of_parting ? "its source" : ""); };
  CHECK(keeps(parting) == std::vector<bool>{true, false});
  CHECK(keeps(meeting) == std::vector<bool>{false, true});
}

TEST_CASE("the smallest case keeps volume and plain numbers if the case has them", "[causes][shrink]") {
  const EnginePtr engine = std::make_unique<Opposite>();
  const Box box{Vec3(0.5, 0.75, 0.5)};
  const Case base = pair_case(box, box, 0.5, Question::overlap);
  const fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
  const auto still =
      fuzz::keeps(engine, fuzz::kept_of(base, finding_in(base, engine), engine, knowledge), knowledge);
  const auto solid = fuzz::shrink_solid(base, still, 500);
  CHECK(fuzz::is_solid(solid.minimum.smallest));
  CHECK(solid.minimum.after < solid.minimum.before);
  CHECK(still({&solid.minimum.smallest, 1})[0]);
  // A point has no volume, and a body that has shows another key.
  const Case point = pair_case(Sphere{0.5}, Sphere{0}, 0.25, Question::overlap);
  const auto of_point = fuzz::keeps_finding(engine, finding_in(point, engine).key());
  const auto as_it_is = fuzz::shrink_solid(point, of_point, 500);
  CHECK(as_it_is.minimum.exit == fuzz::ShrinkExit::smallest);
  CHECK(of_point({&as_it_is.minimum.smallest, 1})[0]);
  CHECK_FALSE(fuzz::is_solid(as_it_is.minimum.smallest));
}

TEST_CASE("of two forms that contradict each other, the wrong one is found", "[causes][relations]") {
  const Case c = pair_case(Sphere{0.5}, Sphere{0.5}, 3, Question::distance);
  const EnginePtr errs = liar("errs_when_large");
  const auto form = fuzz::plain_form(c, Question::distance, errs);
  REQUIRE(form);
  CHECK(form->finding.fault == "distance_off");
  CHECK(std::get<Sphere>(form->c.scene.shapes[0]).radius > 1000);
  CHECK(fuzz::findings_of({&form->c, 1}, errs).at(0).contains(form->finding.key()));
  // An engine that gives no answer to the larger form is not wrong there.
  const Case deep = pair_case(Sphere{0.5}, Sphere{0.5}, 0.5, Question::overlap);
  CHECK_FALSE(fuzz::plain_form(deep, Question::overlap, liar("declines_large")));
}

TEST_CASE("a contradiction that nothing explains shows the form that is wrong", "[causes][relations]") {
  fuzz::CampaignConfig campaign;
  campaign.engines = {"errs_when_large"};
  campaign.subject = "errs_when_large";
  campaign.family = "separate";
  campaign.cases = 64;
  const std::atomic<bool> stop = false;
  fuzz::CampaignResult result = fuzz::run_campaign(
      campaign,
      [&] {
        std::vector<EnginePtr> all;
        all.push_back(liar("errs_when_large"));
        return all;
      },
      {}, stop);
  std::erase_if(result.findings, [](const auto& f) { return f.second.fault != "relation_scale"; });
  REQUIRE_FALSE(result.findings.empty());
  fuzz::CausesConfig config;
  config.knowledge = fuzz::no_knowledge();
  config.make = liar;
  config.tries = 200;
  const fuzz::Causes causes = fuzz::causes_of(result, config);
  REQUIRE_FALSE(causes.causes.empty());
  const fuzz::Cause& cause = causes.causes[0];
  CHECK(cause.faults == std::vector<std::string>{"relation_scale"});
  INFO(cause.shown().key << ": " << cause.shown().words);
  CHECK(cause.shown().key.find(".distance.distance_off.") != std::string::npos);
  const Case shown = case_from_json(cause.shown().c, "shown");
  CHECK(fuzz::findings_of({&shown, 1}, liar("errs_when_large")).at(0).contains(cause.shown().key));
  CHECK(shown.scene.bodies.size() == 2);
}
