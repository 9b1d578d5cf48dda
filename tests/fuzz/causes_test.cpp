// From findings to causes: folding, interventions, responses, groups, order.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <utility>

#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/causes/assembly.h"
#include "fuzz/causes/causes.h"
#include "fuzz/causes/intervention.h"
#include "fuzz/causes/kept.h"
#include "fuzz/causes/name.h"
#include "fuzz/causes/parting.h"
#include "fuzz/causes/plain_cases.h"
#include "fuzz/judge/truth.h"
#include "fuzz/shrink/keeps_finding.h"
#include "oracles/core/core_engine.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using fuzz::FaultStage;

namespace {

EnginePtr liar(const std::string& name) {
  for (const mutants::Mutant& m : mutants::mutants())
    if (m.name == name) return mutants::make_lying_engine(m);
  return nullptr;
}

fuzz::CampaignResult campaign(const std::vector<std::string>& engines, std::uint64_t cases,
                              const std::string& family = "") {
  fuzz::CampaignConfig config;
  config.engines = engines;
  config.subject = engines.at(0);
  config.family = family;
  config.cases = cases;
  const std::atomic<bool> stop = false;
  const auto make = [&] {
    std::vector<EnginePtr> all;
    for (const std::string& name : engines) {
      all.push_back(liar(name));
      REQUIRE(all.back() != nullptr);
    }
    return all;
  };
  return fuzz::run_campaign(config, make, {}, stop);
}

fuzz::CausesConfig config_for_liars() {
  fuzz::CausesConfig config;
  config.knowledge = fuzz::no_knowledge();
  config.make = liar;
  config.tries = 200;
  return config;
}

Case pair_case(Shape a, Shape b, const Vec3& at, Question q) {
  Case c;
  c.scene.shapes = {std::move(a), std::move(b)};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = at;
  c.queries = {{q, 0, 1}};
  return c;
}

fuzz::Finding finding(const std::string& engine, const std::string& question, const std::string& fault,
                      const std::string& shapes, std::uint64_t count) {
  fuzz::Finding f;
  f.engine = engine;
  f.question = question;
  f.fault = fault;
  f.shapes = shapes;
  f.blame = "algorithm";
  f.degeneracy = "solid";
  f.magnitude = "gross";
  f.count = count;
  return f;
}

fuzz::CampaignResult result_of(const std::vector<fuzz::Finding>& findings) {
  fuzz::CampaignResult r;
  for (const fuzz::Finding& f : findings) r.findings[f.key()] = f;
  return r;
}

}  // namespace

TEST_CASE("findings fold into classes by path, symptom and route", "[causes]") {
  const auto r = result_of({finding("x", "contact", "infeasible", "box-sphere", 3),
                            finding("x", "scene_contacts", "not_minimal", "box-cone", 5),
                            finding("x", "contact", "relation_scale", "box-box", 2),
                            finding("x", "distance", "relation_scale", "box-box", 1),
                            finding("x", "contact", "missed", "mesh-sphere", 1)});
  const auto classes = fuzz::classes_of(r, fuzz::no_knowledge());
  REQUIRE(classes.size() == 3);
  CHECK(classes[0].route == "convex");
  CHECK(classes[0].symptom == fuzz::Symptom{Question::distance, FaultStage::contradiction, "relation_scale"});
  CHECK(classes[1].symptom == fuzz::Symptom{Question::contact, FaultStage::depth, ""});
  CHECK(classes[1].count == 8);
  CHECK(classes[1].findings.front()->fault == "not_minimal");  // the most frequent first
  REQUIRE(classes[1].explained.size() == 1);                   // the contradiction about contacts
  CHECK(classes[1].explained[0]->fault == "relation_scale");
  CHECK(classes[2].route == "mesh");
}

TEST_CASE("a failure is a symptom of its own, named by its place", "[causes]") {
  const fuzz::Finding f = finding("x", "distance", "crashed_distance-inl-h-177", "any", 1);
  CHECK(fuzz::symptom_of(f) ==
        fuzz::Symptom{Question::distance, FaultStage::failure, "crashed_distance-inl-h-177"});
  CHECK(fuzz::severity_of(f) == fuzz::Severity::crash);
  CHECK(fuzz::severity_of(finding("x", "overlap", "timed_out", "box-box", 1)) == fuzz::Severity::hang);
  CHECK(fuzz::severity_of(finding("x", "overlap", "threw", "box-box", 1)) == fuzz::Severity::crash);
  // An engine that says that it has no answer.
  CHECK(fuzz::severity_of(finding("x", "distance", "not_converged", "box-box", 1)) ==
        fuzz::Severity::declined);
  CHECK(fuzz::severity_of(finding("x", "distance", "invalid_input", "box-box", 1)) ==
        fuzz::Severity::declined);
  CHECK(fuzz::severity_of(finding("x", "overlap", "relation_swap", "box-box", 1)) ==
        fuzz::Severity::relation);
}

TEST_CASE("a failure at one place in the code has the shapes of its cases", "[causes]") {
  fuzz::Finding f = finding("x", "distance", "crashed_distance-inl-h-177", "any", 2);
  const auto add_example = [&](const Case& c) {
    fuzz::Example e;
    e.index = f.examples.size();
    e.c = std::make_shared<const Case>(c);
    f.examples.push_back(e);
  };
  add_example(pair_case(Box{Vec3(1, 1, 1)}, Sphere{1}, Vec3::Zero(), Question::distance));
  add_example(pair_case(Sphere{1}, Capsule{1, 1}, Vec3::Zero(), Question::distance));
  add_example(pair_case(Cone{1, 1}, Cone{1, 1}, Vec3::Zero(), Question::overlap));  // another question
  const auto shapes = [&] {
    return fuzz::causes_at_once(result_of({f}), fuzz::no_knowledge()).causes.at(0).shapes;
  };
  CHECK(shapes() == std::vector<std::string>{"box-sphere", "capsule-sphere"});
  f.examples.clear();
  CHECK(shapes() == std::vector<std::string>{"any"});
}

TEST_CASE("bodies part from the start if they touch and nothing brings them back", "[causes]") {
  Case c = pair_case(Box{Vec3(1, 1, 1)}, Box{Vec3(1, 1, 1)}, Vec3(1.5, 0, 0), Question::time_of_impact);
  const auto parts = [&](const Vec3& linear, const Vec3& angular = Vec3::Zero()) {
    c.scene.bodies[1].motion = Motion{linear, angular};
    return fuzz::parts_from_start(c, c.queries[0]);
  };
  CHECK(parts(Vec3(1, 0, 0)));
  CHECK(parts(Vec3(0, 1, 0)));  // slides
  CHECK_FALSE(parts(Vec3(-1, 0, 0)));
  CHECK_FALSE(parts(Vec3(-1e-9, 1, 0)));
  CHECK_FALSE(parts(Vec3::Zero()));
  CHECK(parts(Vec3(2, 0, 0), Vec3(0, 0, 1)));
  CHECK_FALSE(parts(Vec3(1, 0, 0), Vec3(0, 0, 1)));  // a corner moves by up to the square root of 3
  c.scene.bodies[1].pose.translation.x() = 2.5;      // apart from the start
  CHECK_FALSE(parts(Vec3(1, 0, 0)));
}

TEST_CASE("impacts that an engine's source says it does not report are documented, others are not",
          "[causes]") {
  const auto missed = [](const std::string& shapes, const Vec3& linear) {
    fuzz::Finding f = finding("x", "time_of_impact", "missed", shapes, 1);
    Case c = pair_case(Box{Vec3(1, 1, 1)}, Box{Vec3(1, 1, 1)}, Vec3(1.5, 0, 0), Question::time_of_impact);
    c.scene.bodies[1].motion = Motion{linear, Vec3::Zero()};
    fuzz::Example e;
    e.c = std::make_shared<const Case>(c);
    f.examples.push_back(e);
    return f;
  };
  fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
  knowledge.documented = [](const std::string&, const fuzz::Symptom&, const std::string&, Fault,
                            bool parting) { return std::string(parting ? "its source" : ""); };
  const fuzz::CampaignResult result =
      result_of({missed("box-box", Vec3(1, 0, 0)), missed("box-hull", Vec3(-1, 0, 0))});
  const fuzz::Causes causes = fuzz::causes_at_once(result, knowledge);
  REQUIRE(causes.causes.size() == 2);
  CHECK(causes.causes[0].documented.empty());
  CHECK(causes.causes[0].shapes == std::vector<std::string>{"box-hull"});
  CHECK(causes.causes[1].documented == "its source");  // comes last
  CHECK(causes.causes[1].shapes == std::vector<std::string>{"box-box"});
}

TEST_CASE("a denied overlap and an invented one are two symptoms", "[causes]") {
  const auto r = result_of({finding("x", "overlap", "missed", "box-box", 3),
                            finding("x", "overlap", "ghost", "box-box", 5),
                            finding("x", "contact", "infeasible", "box-box", 2),
                            finding("x", "contact", "not_minimal", "box-box", 2)});
  CHECK(fuzz::classes_of(r, fuzz::no_knowledge()).size() == 3);
}

TEST_CASE("every representative stands for itself, and every finding has one", "[causes]") {
  const auto r = result_of({finding("x", "contact", "infeasible", "box-sphere", 3),
                            finding("x", "contact", "infeasible", "box-box", 9),
                            finding("y", "contact", "infeasible", "box-box", 1),
                            finding("x", "contact", "not_minimal", "box-box", 4)});
  fuzz::EngineKnowledge k = fuzz::no_knowledge();
  k.path_of = [](const std::string&) { return std::string("one"); };
  const auto classes = fuzz::classes_of(r, k);
  REQUIRE(classes.size() == 1);
  const auto chosen = fuzz::representatives_of(classes[0], 0, 2);
  REQUIRE(chosen.size() == 2);
  CHECK(chosen[0].finding->count == 9);
  CHECK(chosen[1].finding->count == 4);
  std::set<const fuzz::Finding*> stood_for;
  for (const auto& c : chosen)
    for (const auto* f : c.stands_for) CHECK(stood_for.insert(f).second);
  CHECK(stood_for.size() == 4);
}

TEST_CASE("every intervention changes some case of a campaign, and leaves it valid", "[causes]") {
  std::set<std::string_view> applied;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Case c = fuzz::make_case(5, i);
    for (const fuzz::Intervention& x : fuzz::interventions) {
      if (applied.contains(x.name)) continue;
      const auto changed = x.changed(c);
      if (!changed) continue;
      CHECK_NOTHROW(validate(changed->scene));
      CHECK_FALSE(changed->queries.empty());
      if (changed->scene != c.scene || changed->queries != c.queries) applied.insert(x.name);
    }
  }
  for (const fuzz::Intervention& x : fuzz::interventions) {
    INFO(x.name);
    CHECK((applied.contains(x.name) || x.name == "leave_groups"));
  }
}

TEST_CASE("interventions that keep the set keep the signed gap", "[causes]") {
  const Case c = pair_case(Box{Vec3(0.5, 1, 0.25)}, Sphere{0.75}, Vec3(0.5, 1.5, 0.25), Question::distance);
  const auto gap = [](const Case& x) {
    fuzz::Truth truth(x.scene);
    return truth.pair(0, x.queries[0].a, x.queries[0].b).gap;
  };
  const auto before = gap(c);
  for (const auto change : {fuzz::exchange, fuzz::move_away, fuzz::turn_world, fuzz::box_as_hull,
                            fuzz::sphere_as_ellipsoid, fuzz::sphere_as_capsule}) {
    const auto changed = change(c);
    REQUIRE(changed);
    const auto after = gap(*changed);
    CHECK(after.lo <= before.hi + 1e-12);
    CHECK(after.hi >= before.lo - 1e-12);
  }
  const auto scaled = fuzz::scale_up(c);
  REQUIRE(scaled);
  CHECK(std::abs(gap(*scaled).lo - 1024 * before.lo) < 1e-9);
}

TEST_CASE("depths are halved, resolved and produced along the true normal", "[causes]") {
  const Case deep = pair_case(Sphere{1}, Sphere{1}, Vec3(1.5, 0, 0), Question::contact);
  const auto gap_after = [](const std::optional<Case>& x) {
    REQUIRE(x);
    fuzz::Truth truth(x->scene);
    const auto& g = truth.pair(0, 0, 1).gap;
    return (g.lo + g.hi) / 2;
  };
  CHECK(std::abs(gap_after(fuzz::halve_depth(deep)) + 0.25) < 1e-12);
  CHECK(gap_after(fuzz::pull_apart(deep)) > 0);
  CHECK_FALSE(fuzz::push_together(deep));
  const Case apart = pair_case(Sphere{1}, Sphere{1}, Vec3(3, 0, 0), Question::contact);
  CHECK_FALSE(fuzz::halve_depth(apart));
  CHECK(gap_after(fuzz::push_together(apart)) < 0);
}

TEST_CASE("gaps are set to shares of the smaller body, whatever they were", "[causes]") {
  const auto gap_after = [](const std::optional<Case>& x) {
    REQUIRE(x);
    fuzz::Truth truth(x->scene);
    const auto& g = truth.pair(0, 0, 1).gap;
    return (g.lo + g.hi) / 2;
  };
  for (const double at : {0.5, 1.99, 2.0, 3.5}) {  // deep, shallow, touching, apart
    const Case c = pair_case(Sphere{1}, Sphere{1}, Vec3(at, 0, 0), Question::overlap);
    CHECK(std::abs(gap_after(fuzz::overlap_by_half(c)) + 0.5) < 1e-14);
    CHECK(std::abs(gap_after(fuzz::overlap_by_millionth(c)) + 0x1p-20) < 1e-14);
    CHECK(std::abs(gap_after(fuzz::apart_by_256th(c)) - 0x1p-8) < 1e-14);
    CHECK(std::abs(gap_after(fuzz::apart_by_four(c)) - 4) < 1e-14);
    // A larger or another body keeps the gap.
    CHECK(std::abs(gap_after(fuzz::grow_a_much(c)) - (at - 2)) < 1e-13);
    CHECK(std::abs(gap_after(fuzz::b_as_cube(c)) - (at - 2)) < 1e-13);
  }
}

TEST_CASE("interventions about an impact leave alone a question that names no bodies", "[causes]") {
  Case c = pair_case(Sphere{1}, Sphere{1}, Vec3(4, 0, 0), Question::swept_candidates);
  c.queries = {{Question::swept_candidates, -1, -1}};
  c.scene.bodies[1].motion = Motion{Vec3(-4, 0, 0), Vec3(0, 0, 1)};
  for (const auto change : {fuzz::let_a_turn, fuzz::let_b_turn, fuzz::stop_turning_a, fuzz::stop_turning_b,
                            fuzz::move_b_only, fuzz::meet_early, fuzz::meet_head_on, fuzz::move_faster})
    CHECK_FALSE(change(c));
}

TEST_CASE("an impact is moved to another time of the step", "[causes]") {
  Case c = pair_case(Sphere{0.5}, Sphere{0.5}, Vec3(3, 0, 0), Question::time_of_impact);
  c.scene.bodies[1].motion = Motion{Vec3(-8, 0, 0), Vec3::Zero()};
  const auto time_after = [](const std::optional<Case>& x) {
    REQUIRE(x);
    fuzz::Truth truth(x->scene);
    const auto& t = truth.motion(0, 0, 1);
    return (t.t_lo + t.t_hi) / 2;
  };
  CHECK(std::abs(time_after(fuzz::meet_early(c)) - 0.0625) < 1e-9);
  CHECK(std::abs(time_after(fuzz::meet_late(c)) - 0.9375) < 1e-9);
  CHECK(std::abs(time_after(fuzz::move_faster(c)) - 0.5) < 1e-9);
  CHECK(fuzz::move_faster(c)->scene.bodies[1].motion->linear.x() == -512);
  CHECK_FALSE(fuzz::turn_faster(c));
  CHECK(fuzz::let_b_turn(c));
}

TEST_CASE("only faults of the case itself count, not those of what was added", "[causes]") {
  fuzz::EnginePool pool(liar);
  Case crowd;
  crowd.scene.shapes = {Box{Vec3(0.5, 0.5, 0.5)}};
  crowd.scene.bodies.resize(2);
  crowd.scene.bodies[1].pose.translation = Vec3(0.5, 0, 0);
  crowd.queries = {{Question::candidates, 0, 1}};
  const fuzz::Symptom lost{Question::candidates, FaultStage::verdict, "missed"};
  const auto response = [&](const std::string& engine, const std::string& intervention) {
    const fuzz::Responses r = fuzz::respond(crowd, lost, engine, {}, pool);
    CHECK(r.shown);
    for (const fuzz::Responded& x : r.responses)
      if (x.intervention == intervention) return x.response;
    return fuzz::Response::not_applicable;
  };
  CHECK(response("first_pair_dropped", "add_pair_first") == fuzz::Response::gone);
  CHECK(response("first_pair_dropped", "add_pair_last") == fuzz::Response::stays);
  CHECK(response("first_pair_dropped", "add_body_between") == fuzz::Response::stays);
  CHECK(response("first_pair_dropped", "query_afterwards") == fuzz::Response::stays);
  CHECK(response("last_query_unanswered", "query_afterwards") != fuzz::Response::stays);
  CHECK(response("last_query_unanswered", "query_twice") != fuzz::Response::gone);
}

TEST_CASE("the errors of one fault follow a law", "[causes]") {
  fuzz::EnginePool pool(liar);
  const auto law = [&](const std::string& engine, const Case& c, const fuzz::Symptom& s) {
    const fuzz::Responses r = fuzz::respond(c, s, engine, {}, pool);
    CHECK(r.shown);
    return r.laws;
  };
  const Case deep =
      pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.75}, Vec3(1, 0.125, 0.25), Question::contact);
  const auto halved = law("depth_halved", deep, {Question::contact, FaultStage::depth, ""});
  REQUIRE(halved.size() == 1);
  CHECK(halved[0].reference == fuzz::Reference::truth);
  CHECK(std::abs(halved[0].factor + 0.5) < 1e-5);
  const Case apart = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  const auto margin = law("distance_margin", apart, {Question::distance, FaultStage::distance, ""});
  REQUIRE(margin.size() == 1);
  CHECK(margin[0].reference == fuzz::Reference::one);
  CHECK(std::abs(margin[0].factor + 0.04) < 1e-9);
  CHECK_FALSE(fuzz::obey_one_law(halved, margin));
  CHECK(fuzz::obey_one_law(halved, std::array{fuzz::ErrorLaw{fuzz::Reference::truth, -0.51}}));
  CHECK_FALSE(fuzz::obey_one_law(halved, std::array{fuzz::ErrorLaw{fuzz::Reference::truth, 0.5}}));
  CHECK_FALSE(fuzz::obey_one_law(halved, {}));
}

TEST_CASE("another engine that makes another call is not applicable", "[causes]") {
  fuzz::EnginePool pool(liar);
  const Case c = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  const fuzz::Symptom off{Question::distance, FaultStage::distance, ""};
  const auto with = [&](const std::vector<Question>& other_calls) {
    return fuzz::respond(c, off, "distance_margin",
                         {{"tighter", "tight", "", "depth_halved", 0, other_calls}}, pool)
        .responses.back()
        .response;
  };
  CHECK(with({}) == fuzz::Response::gone);
  CHECK(with({Question::contact}) == fuzz::Response::gone);
  CHECK(with({Question::distance}) == fuzz::Response::not_applicable);
}

TEST_CASE("the response tells what a lie depends on", "[causes]") {
  fuzz::EnginePool pool(liar);
  const auto response = [&](const std::string& engine, const Case& c, const fuzz::Symptom& s,
                            const std::string& intervention) {
    const fuzz::Responses r = fuzz::respond(c, s, engine, {}, pool);
    CHECK(r.shown);
    for (const fuzz::Responded& x : r.responses)
      if (x.intervention == intervention) return x.response;
    return fuzz::Response::not_applicable;
  };
  const fuzz::Symptom off{Question::distance, FaultStage::distance, ""};
  const Case boxes = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  // off by 0.04 where a box is concerned
  CHECK(response("distance_margin", boxes, off, "box_as_hull") == fuzz::Response::gone);
  CHECK(response("distance_margin", boxes, off, "exchange") == fuzz::Response::stays);
  CHECK(response("distance_margin", boxes, off, "fresh_process") == fuzz::Response::stays);
  // wrong when B's kind is the lower one
  const Case ordered = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  CHECK(response("distance_one_order", ordered, off, "exchange") == fuzz::Response::gone);
  // 1e-12 too large, whatever the scale
  CHECK(response("distance_absolute", boxes, off, "scale_up") == fuzz::Response::gone);
}

namespace {

// The core's answers, changed, from an engine that documents what its card and answers claim.
class Altered final : public Engine {
 public:
  explicit Altered(std::function<void(Observation&)> change, double contact_offset = 0)
      : change_(std::move(change)), card_(core_.card()) {
    card_.source = "the test";
    card_.contact_offset = contact_offset;
  }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = core_.run(cases);
    for (CaseObservations& of_case : all)
      for (Observation& o : of_case.answers) change_(o);
    return all;
  }

 private:
  CoreEngine core_;
  std::function<void(Observation&)> change_;
  EngineCard card_;
};

}  // namespace

TEST_CASE("another engine that only claims more for the same wrong answer does not repair it", "[causes]") {
  fuzz::EnginePool pool([](const std::string& name) -> EnginePtr {
    return std::make_unique<Altered>([claim = name == "generous" ? 1e-2 : 0](Observation& o) {
      if (o.distance) *o.distance += 1e-3;
      o.claimed_tolerance = claim;
    });
  });
  const Case c = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  const fuzz::Symptom off{Question::distance, FaultStage::distance, ""};
  const auto r = fuzz::respond(c, off, "strict", {{"looser", "a claim of 1e-2", "", "generous"}}, pool);
  CHECK(r.shown);
  REQUIRE(r.responses.back().intervention == "looser");
  CHECK(r.responses.back().response == fuzz::Response::stays);
}

TEST_CASE("a fault does not vanish because a claimed length allows it in a smaller scene", "[causes]") {
  const auto response = [](void (*change)(Observation&), double offset, const Case& c,
                           const fuzz::Symptom& s) {
    fuzz::EnginePool pool(
        [=](const std::string&) -> EnginePtr { return std::make_unique<Altered>(change, offset); });
    const auto r = fuzz::respond(c, s, "altered", {}, pool);
    CHECK(r.shown);
    const auto found =
        std::ranges::find(r.responses, std::string("scale_down"), &fuzz::Responded::intervention);
    REQUIRE(found != r.responses.end());
    return found->response;
  };
  // A hundredth too far; 1/1024 of that is less than the claim.
  const Case apart = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  const auto too_far = [](Observation& o) {
    if (o.distance) *o.distance *= 1.01;
    o.claimed_tolerance = 1e-3;
  };
  CHECK(response(too_far, 0, apart, {Question::distance, FaultStage::distance, ""}) == fuzz::Response::stays);
  // 1 apart; 1/1024 is less than the contact offset.
  const Case asked = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::overlap);
  const auto overlapping = [](Observation& o) {
    if (o.overlap) o.overlap = true;
  };
  CHECK(response(overlapping, 0.01, asked, {Question::overlap, FaultStage::verdict, "ghost"}) ==
        fuzz::Response::stays);
}

TEST_CASE("causes of a campaign: every key in one cause, the same for any number of jobs", "[causes]") {
  const auto result = campaign({"distance_margin", "depth_halved", "witness_swapped", "overlap_always"}, 200,
                               "separate,deep");
  REQUIRE(result.findings.size() > 4);
  fuzz::CausesConfig config = config_for_liars();
  const fuzz::Causes one = fuzz::causes_of(result, config);
  config.jobs = 3;
  const fuzz::Causes three = fuzz::causes_of(result, config);
  CHECK(to_json(one) == to_json(three));
  std::set<std::string> assigned, ids;
  for (const fuzz::Cause& c : one.causes) {
    CHECK(ids.insert(c.id).second);
    CHECK_FALSE(c.title.empty());
    CHECK(c.wrong > 0);
    CHECK(c.asked >= c.wrong);
    CHECK_FALSE(c.shown().c.is_null());
    for (const std::string& key : c.keys) CHECK(assigned.insert(key).second);
  }
  CHECK(assigned.size() == result.findings.size());
  CHECK(one.keys == result.findings.size());
}

TEST_CASE("examinations that were kept are not asked again, whenever they were interrupted", "[causes]") {
  const auto result = campaign({"distance_margin", "depth_halved", "overlap_always"}, 200, "separate,deep");
  fuzz::CausesConfig config = config_for_liars();
  config.knowledge.path_of = [](const std::string&) {
    return std::string("liar");
  };  // one liar asks the other
  const fuzz::Causes whole = fuzz::causes_of(result, config);
  const test::Workspace w("examinations");
  const auto file = w.dir / "causes.examined";
  const fuzz::Json about = {{"digest", "1"}};
  std::atomic<bool> stop = false;
  std::size_t all = 0;
  const auto go_on = [&](std::size_t examine_most) {
    fuzz::Examinations kept(file, about);
    const std::size_t before = kept.size();
    stop = false;
    config.stop = &stop;
    config.progress = [&](std::size_t done, std::size_t of) {
      all = of;
      stop = done >= before + examine_most;
    };
    config.examinations = &kept;
    const fuzz::Causes causes = fuzz::causes_of(result, config);
    CHECK(kept.not_kept().empty());
    CHECK(kept.size() == std::min(before + examine_most, all));
    return causes;
  };
  go_on(2);
  REQUIRE(all > 6);
  const std::string text = test::read_all(file);
  std::ofstream(file, std::ios::app) << R"({"key": "liar.dis)";  // killed while it wrote
  go_on(3);
  CHECK(test::read_all(file).starts_with(text));
  CHECK(fuzz::Examinations(file, about).size() == 5);
  CHECK(fuzz::Examinations(file, {{"digest", "2"}}).size() == 0);  // of another campaign
  CHECK(to_json(go_on(all)) == to_json(whole));
  // Nothing is left to examine: without engines, the same groups.
  config.make = [](const std::string&) { return EnginePtr(); };
  const fuzz::Causes again = go_on(0);
  CHECK(again.answers == whole.answers);
  CHECK(again.notes.empty());
  std::ofstream(file, std::ios::app) << "{\"key\": 3}\n";
  CHECK_THROWS_WITH(fuzz::Examinations(file, about), Catch::Contains("line"));
}

TEST_CASE("a contradiction is explained by the fault that the referee finds in one of its forms",
          "[causes]") {
  const Case c = pair_case(Box{Vec3(0.5, 0.5, 0.5)}, Sphere{0.5}, Vec3(2, 0, 0), Question::distance);
  // Right about this case, off by 1 about bodies larger than 1000.
  const auto errs = fuzz::plain_form(c, Question::distance, liar("errs_when_large"));
  REQUIRE(errs);
  CHECK(fuzz::symptom_of(errs->finding) == fuzz::Symptom{Question::distance, FaultStage::distance, ""});
  CHECK(extent(errs->c.scene.shapes[0]) > 1000);
  // Wrong about overlaps only.
  CHECK_FALSE(fuzz::plain_form(c, Question::distance, liar("depth_halved_deep")));
}

namespace {

// Of a library with one routine for all pairs.
fuzz::EngineKnowledge one_route() {
  fuzz::EngineKnowledge k = fuzz::no_knowledge();
  k.route_of = [](const std::string&, Question, ShapeKind, ShapeKind) { return std::string("all"); };
  return k;
}

}  // namespace

TEST_CASE("a case becomes as plain as its fault allows", "[causes]") {
  const fuzz::Symptom depth{Question::contact, FaultStage::depth, ""};
  Case c = pair_case(Box{Vec3(0.5, 0.75, 0.25)}, Box{Vec3(0.25, 0.5, 1)}, Vec3(0.375, 0.25, 1.125),
                     Question::contact);
  c.scene.bodies[0].pose.rotation = {0.25, 0, 0, 1};
  const auto plain = [&](const std::string& engine) {
    const EnginePtr e = liar(engine);
    const fuzz::EngineKnowledge knowledge = one_route();
    const auto found = fuzz::findings_of({&c, 1}, e);
    const auto wrong =
        std::ranges::find_if(found.at(0), [&](const auto& f) { return fuzz::symptom_of(f.second) == depth; });
    REQUIRE(wrong != found.at(0).end());
    const auto still = fuzz::keeps(e, fuzz::kept_of(c, wrong->second, e, knowledge), knowledge);
    REQUIRE(still({&c, 1})[0]);
    const Case r = fuzz::normal_form(c, still);
    CHECK(still({&r, 1})[0]);
    return r;
  };
  const Case any = plain("depth_halved");
  CHECK(any.scene.shapes == std::vector<Shape>{Sphere{1}, Sphere{1}});
  CHECK(any.scene.bodies[0].pose == Pose{});
  const Case boxes = plain("depth_halved_boxes");
  CHECK(boxes.scene.shapes == std::vector<Shape>{Box{Vec3::Ones()}, Box{Vec3::Ones()}});
  const Case turned = plain("depth_halved_turned");  // where A is turned
  CHECK_FALSE(turned.scene.bodies[0].pose == Pose{});
  CHECK(turned.scene.bodies[1].pose.rotation == Quat{});
  CHECK(kind_of(turned.scene.shape_of(1)) == ShapeKind::sphere);
}

TEST_CASE("a fault of one kind of shape becomes a plain pair with that kind", "[causes]") {
  const fuzz::Symptom missed{Question::overlap, FaultStage::verdict, "missed"};
  const auto plain = [&](const std::string& engine, const Case& c) {
    const EnginePtr e = liar(engine);
    const fuzz::EngineKnowledge knowledge = one_route();
    const auto found = fuzz::findings_of({&c, 1}, e);
    const auto wrong = std::ranges::find_if(
        found.at(0), [&](const auto& f) { return fuzz::symptom_of(f.second) == missed; });
    REQUIRE(wrong != found.at(0).end());
    const auto still = fuzz::keeps(e, fuzz::kept_of(c, wrong->second, e, knowledge), knowledge);
    const Case r = fuzz::normal_form(c, still);
    CHECK(still({&r, 1})[0]);
    return r;
  };
  const Case cylinders = plain("overlap_denied_cylinders", pair_case(Cylinder{0.5, 2}, Cylinder{0.25, 3},
                                                                     Vec3(0.5, 0.25, 1), Question::overlap));
  CHECK(cylinders.scene.shapes == std::vector<Shape>{Cylinder{1, 1}, Cylinder{1, 1}});
  const Case cone = plain("overlap_one_pair_denied",
                          pair_case(Cone{0.5, 2}, Capsule{0.25, 3}, Vec3(0.125, 0.25, 1), Question::overlap));
  CHECK(cone.scene.shapes == std::vector<Shape>{Capsule{1, 1}, Cone{1, 1}});
  // A capsule without height stays one.
  const Case flat = plain("zero_capsule_short", pair_case(Box{Vec3(0.5, 0.75, 0.25)}, Capsule{0.25, 0},
                                                          Vec3(0.5, 0.25, 0.125), Question::overlap));
  CHECK(flat.scene.shapes == std::vector<Shape>{Capsule{1, 0}, Sphere{1}});
}

TEST_CASE("a fault of a whole scene becomes a plain scene with what it needs", "[causes]") {
  const auto plain = [&](const std::string& engine, Case c) {
    const EnginePtr e = liar(engine);
    const fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
    const auto found = fuzz::findings_of({&c, 1}, e);
    REQUIRE(found.at(0).size() == 1);
    const auto still = fuzz::keeps(e, fuzz::kept_of(c, found[0].begin()->second, e, knowledge), knowledge);
    const Case r = fuzz::normal_form(c, still);
    CHECK(still({&r, 1})[0]);
    return r.scene;
  };
  Case c = pair_case(Box{Vec3(0.5, 0.75, 0.25)}, Box{Vec3(0.25, 0.5, 1)}, Vec3(0.375, 0.25, 1.125),
                     Question::candidates);
  using Op = Step::Op;
  c.scene.script = {{Op::insert, 0, {}}, {Op::insert, 1, {}}, {Op::query, -1, {}}, {Op::remove, 1, {}},
                    {Op::query, -1, {}}, {Op::insert, 1, {}}, {Op::query, -1, {}}};
  const Scene again = plain("lost_on_reinsert", c);
  CHECK(again.shapes == std::vector<Shape>{Box{Vec3::Ones()}});
  CHECK(again.bodies.size() == 2);
  CHECK(again.script.size() == 6);  // inserted, asked, one removed and inserted, asked
  CHECK(std::ranges::count(again.script, Op::remove, &Step::op) == 1);
  // A lie that needs no history is shown without one.
  const Scene any = plain("first_pair_dropped", c);
  CHECK(any.script.empty());
  CHECK(any.bodies.size() == 2);
}

TEST_CASE("an impact becomes as plain as its fault allows", "[causes]") {
  Case c = pair_case(Box{Vec3(0.5, 0.75, 0.25)}, Box{Vec3(0.25, 0.5, 1)}, Vec3(3.375, 0.25, 1.125),
                     Question::time_of_impact);
  c.scene.bodies[0].motion = Motion{Vec3(0.5, 0, 0), Vec3(0.25, 0, 0.125)};
  c.scene.bodies[1].motion = Motion{Vec3(-4, 0, -0.5), Vec3(0, 0.5, 0.25)};
  const auto plain = [&](const std::string& engine) {
    const EnginePtr e = liar(engine);
    const fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
    const auto found = fuzz::findings_of({&c, 1}, e);
    REQUIRE(found.at(0).size() == 1);
    const auto still = fuzz::keeps(e, fuzz::kept_of(c, found[0].begin()->second, e, knowledge), knowledge);
    const Case r = fuzz::normal_form(c, still);
    CHECK(still({&r, 1})[0]);
    return r;
  };
  const Case any = plain("impact_denied");
  CHECK(any.scene.shapes == std::vector<Shape>{Sphere{1}, Sphere{1}});
  CHECK_FALSE(any.scene.bodies[0].motion);
  REQUIRE(any.scene.bodies[1].motion);
  CHECK(any.scene.bodies[1].motion->angular.isZero(0));
  // Where the rotation is ignored, a body that is not round turns.
  const Case turning = plain("impact_rotation_ignored");
  REQUIRE(turning.scene.bodies[1].motion);
  CHECK_FALSE(turning.scene.bodies[1].motion->angular.isZero(0));
  CHECK(turning.scene.shape_of(1) == Shape{Box{Vec3::Ones()}});
}

namespace {

// One finding of each of two classes, examined: their faults survive every change.
struct TwoExamined {
  TwoExamined(const fuzz::Finding& x, const fuzz::Finding& y)
      : result(result_of({x, y})), classes(fuzz::classes_of(result, knowledge)) {
    for (std::size_t i = 0; i < classes.size(); ++i) {
      all.push_back(std::move(fuzz::representatives_of(classes[i], i, 1).at(0)));
      fuzz::Representative& r = all.back();
      r.asked = true;
      r.first.smallest = r.first.canonical =
          pair_case(Sphere{1}, Sphere{1}, Vec3(static_cast<double>(i), 0, 0), Question::contact);
      r.first.responses.shown = true;
      r.first.responses.faults = {"infeasible"};
      for (const fuzz::Intervention& change : fuzz::interventions)
        r.first.responses.responses.push_back({std::string(change.name), "", fuzz::Response::stays});
      r.first.responses.responses.push_back(
          {std::string(fuzz::other_precision), "", fuzz::Response::not_applicable});
    }
    REQUIRE(all.size() == 2);
  }
  std::size_t groups(const fuzz::Noise& noise = {}) const {
    const std::vector<double> rates(classes.size(), 0.0);
    return fuzz::grouped({classes, all, rates, knowledge, noise}).size();
  }
  fuzz::Parts parts(const fuzz::Noise& noise = {}) const {
    fuzz::Parts p;
    p.classes = classes;
    p.all = all;
    p.noise = noise;
    return p;
  }
  fuzz::Responded& response(std::size_t i, std::string_view name) {
    return *std::ranges::find(all[i].first.responses.responses, name, &fuzz::Responded::intervention);
  }
  fuzz::EngineKnowledge knowledge = fuzz::no_knowledge();
  fuzz::CampaignResult result;
  std::vector<fuzz::FindingClass> classes;
  std::vector<fuzz::Representative> all;
};

}  // namespace

TEST_CASE("findings of one library that are reduced to one case are one, whatever their path", "[causes]") {
  TwoExamined two(finding("fcl-x", "contact", "infeasible", "box-box", 3),
                  finding("fcl-y", "contact", "infeasible", "box-box", 2));
  CHECK(two.groups() == 2);
  two.all[1].first.canonical = two.all[0].first.canonical;
  CHECK(two.groups() == 1);
  two.response(0, "exchange").response = fuzz::Response::gone;
  CHECK(two.groups() == 2);
  two.response(1, "exchange").response = fuzz::Response::gone;
  CHECK(two.groups() == 1);
  two.all[1].first.responses.deviation.manner = "normal";
  CHECK(two.groups() == 2);
}

TEST_CASE("engines of one path are told apart by each other's cases", "[causes]") {
  const auto parts = [](const std::string& x, const std::string& y, const fuzz::Noise& noise) {
    TwoExamined two(finding(x, "contact", "infeasible", "box-box", 9),
                    finding(y, "contact", "infeasible", "box-box", 5));
    fuzz::EnginePool pool([](const std::string& name) { return liar(name.substr(0, name.find('@'))); });
    const Shape shapes[] = {Sphere{1}, Box{Vec3::Ones()}};
    for (std::size_t i = 0; i < two.all.size(); ++i) {
      fuzz::Representative& r = two.all[i];
      const bool of_boxes = r.finding->engine.starts_with("depth_halved_boxes");
      r.first.smallest = pair_case(shapes[of_boxes], shapes[of_boxes], Vec3(1.5, 0, 0), Question::contact);
      const auto shown = fuzz::shown_by(r.finding->engine, r.first.smallest, r.symptom, pool);
      REQUIRE(shown);
      r.first.responses.deviation = *shown;
    }
    fuzz::Group g;
    g.members = {0, 1};
    const std::vector<double> rates(two.classes.size(), 0.0);
    return fuzz::told_apart({g}, {two.classes, two.all, rates, two.knowledge, noise}, pool).size();
  };
  CHECK(parts("depth_halved", "depth_halved_boxes", {}) == 2);  // right about spheres
  CHECK(parts("depth_halved", "depth_less_share", {}) == 2);    // wrong by another law
  CHECK(parts("depth_halved", "depth_halved@later", {}) == 1);
  // Where responses of one cause differ by chance, so do these.
  CHECK(parts("depth_halved", "depth_halved_boxes", {{"depth_halved", 0.1}, {"depth_halved_boxes", 0.1}}) ==
        1);
}

TEST_CASE("a title names no kind of shape that none of the cause's pairs has", "[causes]") {
  const auto title = [](const std::string& pair) {
    TwoExamined two(finding("x", "contact", "infeasible", pair, 9),
                    finding("y", "contact", "infeasible", pair, 5));
    two.response(0, "box_as_hull").response = fuzz::Response::gone;
    const fuzz::Parts p = two.parts();
    const fuzz::Assembly assembly(two.result, p, two.knowledge);
    fuzz::Group first;
    first.members = {0};
    return assembly.cause_of(assembly.identified({first}).at(0)).title;
  };
  const auto speaks_of_boxes = [&](const std::string& pair) {
    return title(pair).find("a routine for boxes") != std::string::npos;
  };
  CHECK(speaks_of_boxes("box-cone"));
  CHECK(speaks_of_boxes("scene"));  // of no known kinds
  CHECK_FALSE(speaks_of_boxes("cone-cylinder"));
}

TEST_CASE("a cause is shown by a case with the gravest of its faults, which its title names", "[causes]") {
  TwoExamined two(finding("x", "contact", "not_minimal", "box-box", 9),
                  finding("x", "contact", "infeasible", "mesh-sphere", 1));
  const std::size_t mild = two.all[0].finding->fault == "not_minimal" ? 0 : 1;
  fuzz::Parts p = two.parts();
  const fuzz::Assembly assembly(two.result, p, two.knowledge);
  fuzz::Group both;
  both.members = {mild, 1 - mild};
  const auto identified = assembly.identified({both});
  REQUIRE(identified.size() == 1);
  CHECK(assembly.leader(identified[0]).finding->fault == "infeasible");
  const fuzz::Cause cause = assembly.cause_of(identified[0]);
  CHECK(cause.severity == fuzz::Severity::infeasible);
  CHECK(cause.title.starts_with("Depth and normal do not separate (box-box, mesh-sphere)"));
  // A fault that no case shows is not in the title.
  p.all[1 - mild].first.responses.shown = false;
  const auto again = assembly.identified({both});
  CHECK(assembly.cause_of(again.at(0)).title.starts_with("Normals are not those of the least depth"));
}

TEST_CASE("the id of a cause does not depend on findings that are rare in the campaign", "[causes]") {
  const auto id = [](std::uint64_t of_a, std::uint64_t of_b) {
    TwoExamined two(finding("a", "overlap", "missed", "box-box", of_a),
                    finding("b", "contact", "missed", "mesh-sphere", of_b));
    const fuzz::Parts p = two.parts({{"a", 0.1}, {"b", 0.1}});
    fuzz::Group both;
    both.members = {0, 1};
    return fuzz::Assembly(two.result, p, two.knowledge).identified({both}).at(0).id;
  };
  CHECK(id(1, 80) == id(2, 99));
  CHECK(id(1, 80).starts_with("b-verdict-"));
  CHECK(id(80, 1).starts_with("a-verdict-"));
  CHECK(id(80, 1) == id(40, 40));
  CHECK(id(20, 80) == id(40, 40));
}

TEST_CASE("the most frequent groups of two stages in one place keep their ids beside each other",
          "[causes]") {
  const auto ids = [](std::uint64_t depths, std::uint64_t points) {
    TwoExamined two(finding("a", "contact", "infeasible", "box-box", depths),
                    finding("a", "contact", "point_off", "box-box", points));
    const fuzz::Parts p = two.parts({{"a", 0.1}});
    fuzz::Group one, other;
    one.members = {0};
    other.members = {1};
    std::set<std::string> all;
    for (const fuzz::Group& g : fuzz::Assembly(two.result, p, two.knowledge).identified({one, other}))
      all.insert(g.id);
    return all;
  };
  CHECK(ids(9, 5).size() == 2);
  CHECK(ids(9, 5) == ids(5, 9));
}

TEST_CASE("a title says which answers deny an overlap or claim one", "[causes]") {
  const auto title = [](Question q, fuzz::Severity severity, bool one) {
    return fuzz::describe_fault({severity, {q, FaultStage::verdict, ""}, "", "", {"convex"}, {}, one});
  };
  CHECK(title(Question::overlap, fuzz::Severity::missed, true) == "Overlaps are denied");
  CHECK(title(Question::distance, fuzz::Severity::missed, true) == "Distances deny overlaps");
  CHECK(title(Question::distance, fuzz::Severity::missed, false) == "Overlaps are denied");
  CHECK(title(Question::distance, fuzz::Severity::ghost, true) ==
        "Distances claim overlaps that do not exist");
  CHECK(title(Question::contact, fuzz::Severity::missed, true) == "Contacts are missing");
  CHECK(title(Question::contact, fuzz::Severity::ghost, true) ==
        "Contacts are reported where there are none");
  CHECK(title(Question::time_of_impact, fuzz::Severity::hang, true) ==
        "Questions about time of impact are not answered in time");
}

TEST_CASE("a fault of single precision is not one of both precisions", "[causes]") {
  TwoExamined two(finding("x", "contact", "unstable", "box-box", 3),
                  finding("x", "contact", "unstable", "mesh-sphere", 2));
  const fuzz::Noise noise{{"x", 0.125}};
  two.response(0, "exchange").response = fuzz::Response::gone;  // less than responses vary by chance
  CHECK(two.groups(noise) == 1);
  two.response(0, fuzz::other_precision).response = fuzz::Response::stays;
  CHECK(two.groups(noise) == 1);
  two.response(1, fuzz::other_precision).response = fuzz::Response::gone;
  CHECK(two.groups(noise) == 2);
}

TEST_CASE("two lies are two causes, and one lie is one", "[causes]") {
  fuzz::CausesConfig config = config_for_liars();
  config.knowledge.path_of = [](const std::string&) { return std::string("liar"); };
  config.representatives = 100;  // every finding, so that none is taken for one that it is like
  const auto result = campaign({"distance_margin", "distance_one_order"}, 300, "separate");
  const fuzz::Causes causes = fuzz::causes_of(result, config);
  std::set<std::set<std::string>> engines;
  for (const fuzz::Cause& c : causes.causes) engines.insert({c.engines.begin(), c.engines.end()});
  CHECK(engines == std::set<std::set<std::string>>{{"distance_margin"}, {"distance_one_order"}});
}

TEST_CASE("causes at once ask nothing and assign every key", "[causes]") {
  const auto result = campaign({"distance_margin", "depth_halved"}, 100);
  const fuzz::Causes causes = fuzz::causes_at_once(result, fuzz::no_knowledge());
  std::set<std::string> assigned;
  for (const fuzz::Cause& c : causes.causes) {
    CHECK(c.response.empty());
    for (const std::string& key : c.keys) CHECK(assigned.insert(key).second);
  }
  CHECK(assigned.size() == result.findings.size());
}

TEST_CASE("reading order: documented last, by severity, most unlike first", "[causes]") {
  std::vector<fuzz::Cause> causes(5);
  const double place[] = {0, 0.1, 1, 0.6, 0};
  for (std::size_t i = 0; i < causes.size(); ++i) {
    causes[i].id = std::to_string(i);
    causes[i].severity = fuzz::Severity::distance;
    causes[i].wrong = 10 - i;
  }
  causes[0].documented = "manual, page 3";
  causes[4].severity = fuzz::Severity::crash;
  const auto order = fuzz::reading_order(
      causes, [&](std::size_t x, std::size_t y) { return std::abs(place[x] - place[y]); });
  // The crash; then the most frequent distance; then the one farthest from it; then the middle.
  CHECK(order == std::vector<std::size_t>{4, 1, 2, 3, 0});
}

TEST_CASE("a title names the most telling change", "[causes]") {
  fuzz::Responses r;
  for (const fuzz::Intervention& i : fuzz::interventions)
    r.responses.push_back({std::string(i.name), std::string(i.change), fuzz::Response::stays});
  CHECK(fuzz::main_reason(r, FaultStage::depth) == "steady");
  for (fuzz::Responded& x : r.responses)
    if (x.intervention == "scale_up" || x.intervention == "grow_a") x.response = fuzz::Response::gone;
  CHECK(fuzz::main_reason(r, FaultStage::depth) == "scale_up");
  CHECK(fuzz::describe_reason("scale_up", r, {}).find("absolute tolerance") != std::string::npos);
  for (fuzz::Responded& x : r.responses) x.response = fuzz::Response::gone;
  CHECK(fuzz::main_reason(r, FaultStage::depth) == "fragile");
}

TEST_CASE("a title says that a fault stays under all changes only if it does", "[causes]") {
  fuzz::Responses r;
  for (const auto& [name, response] :
       {std::pair("scale_up", fuzz::Response::stays), std::pair("a_as_cube", fuzz::Response::stays),
        std::pair("normalize_rotations", fuzz::Response::not_applicable)})
    r.responses.push_back({name, "", response});
  CHECK(fuzz::describe_reason("steady", r, {}) == "stays under all 2 changes");
  r.responses[1].response = fuzz::Response::gone;
  CHECK(fuzz::main_reason(r, FaultStage::depth) == "steady");
  CHECK(fuzz::describe_reason("steady", r, {}) == "stays under 1 of 2 changes");
}
