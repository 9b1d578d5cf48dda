// Certificates of broad phases: every broad phase of the core gets one, every lying one is refuted.
#include "fuzz/certify/certify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/input_error.h"
#include "fuzz/certify/candidate_verdict.h"
#include "fuzz/shrink/defensible.h"
#include "fuzz/shrink/keeps_finding.h"
#include "oracles/core/core_engine.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/exhaustive/box_scene.h"
#include "scenarios/exhaustive/suites.h"
#include "tests/mutants/lying_engine.h"
#include "tests/mutants/topics.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"

using namespace touchstone;
using namespace touchstone::fuzz;

namespace {

const std::atomic<bool> never{false};

Subject core_subject(std::string_view name) {
  return {std::string(name), "", true, [name](BroadLevel level) {
            return make_broad_engine(name,
                                     level == BroadLevel::boxes ? BroadBoxes::exact : BroadBoxes::bodies);
          }};
}

BroadCertificate certificate(const Subject& s, std::uint64_t limit, int jobs = 1,
                             std::vector<BroadLevel> levels = {BroadLevel::boxes, BroadLevel::bodies}) {
  CertifyConfig c;
  c.levels = std::move(levels);
  c.limit = limit;
  c.jobs = jobs;
  c.program = "test";
  return *certify(s, c, {}, never);
}

BroadCertificate first_fault(const Subject& s, BroadLevel level) {
  CertifyConfig c;
  c.levels = {level};
  c.limit = 12000;
  c.first_fault = true;
  c.program = "test";
  return *certify(s, c, {}, never);
}

std::vector<mutants::Mutant> broad_mutants() {
  std::vector<mutants::Mutant> all;
  for (const auto topic : {mutants::broad_list_lies, mutants::broad_box_lies, mutants::broad_script_lies})
    for (mutants::Mutant& m : topic()) all.push_back(std::move(m));
  return all;
}

// The minimum that a lie needs, where that is more than 3 bodies or 6 steps; no smaller script shows it. A
// list of 16 is too short for 17 pairs, and 6 bodies have 15. A fourth move needs two inserts, four moves and
// a query; a body inserted a third time needs three inserts, two removes, the other's insert and a query.
std::pair<std::size_t, std::size_t> least_script(std::string_view mutant) {
  if (mutant == "sixteen_pairs") return {7, 8};
  if (mutant == "stale_at_fourth_move" || mutant == "lost_on_second_reinsert") return {2, 7};
  return {3, 6};
}

// The core, given another motion than the one in the case.
class OtherMotion final : public Engine {
 public:
  using Change = void (*)(Motion&);
  explicit OtherMotion(Change change)
      : change_(change), inner_(make_broad_engine("automatic", BroadBoxes::bodies)) {}
  const EngineCard& card() const override { return inner_->card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    std::vector<Case> told(cases.begin(), cases.end());
    for (Case& c : told)
      for (Body& b : c.scene.bodies)
        if (b.motion) change_(*b.motion);
    return inner_->run(told);
  }

 private:
  Change change_;
  EnginePtr inner_;
};

BroadCertificate certificate_of_sweeps(OtherMotion::Change change) {
  const Subject s{"other motion", "", true,
                  [=](BroadLevel) { return std::make_unique<OtherMotion>(change); }};
  CertifyConfig c;
  c.levels = {BroadLevel::bodies};
  c.first_fault = true;
  c.program = "test";
  for (const EvidenceRow& e : all_evidence())
    if (!e.sweeps && e.level == BroadLevel::bodies) c.without.emplace_back(e.name);
  return *certify(s, c, {}, never);
}

}  // namespace

TEST_CASE("the ends of n intervals have as many orders as counted by hand", "[certify]") {
  // Allen's 13 relations of two intervals, 5 of a point and an interval (twice), 3 of two points.
  CHECK(axis_orders(2).size() == 13 + 5 + 5 + 3);
  // Two intervals of a triple are in one of the 26 relations; each occurs.
  std::map<std::vector<bool>, int> seen;
  for (const AxisOrder& r : axis_orders(3)) {
    std::vector<bool> relation;
    for (int i : {0, 1})
      for (int j : {2, 3}) relation.insert(relation.end(), {r[i] < r[j], r[i] == r[j]});
    relation.push_back(r[0] == r[1]);
    relation.push_back(r[2] == r[3]);
    ++seen[relation];
  }
  CHECK(seen.size() == 26);
  CHECK(axis_orders(3).size() == 818);
}

TEST_CASE("histories are complete and distinct", "[certify]") {
  // One body, one place: insert or query; once inserted, move, remove or query. Length 2, without II':
  // I{M,R,Q}, Q{I,Q}.
  CHECK(histories(1, 1, 2).size() == 5);
  auto all = histories(2, 2, 6);
  const auto n = all.size();
  std::sort(all.begin(), all.end());
  CHECK(std::unique(all.begin(), all.end()) == all.end());
  CHECK(n > 20000);
}

TEST_CASE("every broad phase of the core gets its certificate", "[certify]") {
  std::size_t certified = 0;
  for (const auto name : core_broad_phases()) {
    const BroadCertificate c = certificate(core_subject(name), 150);
    INFO(to_json(c).dump(1));
    CHECK(verdict(c, BroadLevel::boxes) == LevelVerdict::certified);
    CHECK(verdict(c, BroadLevel::bodies) == LevelVerdict::certified);
    CHECK(exit_code(c) == 0);
    CHECK(c.evidence.size() == all_evidence().size());
    for (const EvidenceCount& e : c.evidence) {
      CHECK(e.refused == 0);
      CHECK(e.answered == e.planned);
      CHECK(e.pairs_true > 0);
    }
    ++certified;
  }
  CHECK(certified == 8);
}

namespace {

BroadCertificate with_margin(const Subject& s, double margin, std::uint64_t limit, int jobs = 1) {
  CertifyConfig c;
  c.limit = limit;
  c.jobs = jobs;
  c.margin = margin;
  c.program = "test";
  return *certify(s, c, {}, never);
}

// The core, told another margin than the one in the case.
class OtherMargin final : public Engine {
 public:
  OtherMargin(BroadLevel level, double (*change)(double))
      : change_(change),
        inner_(make_broad_engine("automatic",
                                 level == BroadLevel::boxes ? BroadBoxes::exact : BroadBoxes::bodies)) {}
  const EngineCard& card() const override { return inner_->card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    std::vector<Case> told(cases.begin(), cases.end());
    for (Case& c : told) c.scene.margin = change_(c.scene.margin);
    return inner_->run(told);
  }

 private:
  double (*change_)(double);
  EnginePtr inner_;
};

Subject with_other_margin(double (*change)(double)) {
  return {"other margin", "", false,
          [change](BroadLevel level) { return std::make_unique<OtherMargin>(level, change); }};
}

}  // namespace

TEST_CASE("every broad phase of the core is certified with a margin", "[certify][margin]") {
  for (const auto name : core_broad_phases())
    for (const double margin : {0.0, 0.5}) {
      const BroadCertificate c = with_margin(core_subject(name), margin, 60);
      INFO(to_json(c).dump(1));
      CHECK(verdict(c, BroadLevel::boxes) == LevelVerdict::certified);
      CHECK(verdict(c, BroadLevel::bodies) == LevelVerdict::certified);
      CHECK(c.margin == margin);
      CHECK(!c.sweeps);
    }
  // More pairs must be reported with a margin than without one.
  const auto pairs = [](const BroadCertificate& c) {
    std::uint64_t n = 0;
    for (const EvidenceCount& e : c.evidence) n += e.pairs_true;
    return n;
  };
  CHECK(pairs(with_margin(core_subject("grid"), 0.5, 60)) > pairs(with_margin(core_subject("grid"), 0, 60)));
}

TEST_CASE("a certificate with a margin survives its JSON and has the same bytes for any number of jobs",
          "[certify][margin]") {
  const BroadCertificate one = with_margin(core_subject("grid"), 0.25, 200),
                         three = with_margin(core_subject("grid"), 0.25, 200, 3);
  CHECK(to_json(one).dump() == to_json(three).dump());
  bool holds = false;
  CHECK(broad_certificate_from_json(to_json(one), holds).margin == 0.25);
  CHECK(holds);
}

TEST_CASE("a subject that shortens the margin is refuted by a small script", "[certify][margin]") {
  for (double (*change)(double) : {+[](double) { return 0.0; }, +[](double m) { return m / 2; },
                                   +[](double m) { return std::nextafter(m, 0) - 1e-12; }}) {
    const BroadCertificate c = with_margin(with_other_margin(change), 0.5, 3000);
    CHECK(exit_code(c) == 1);
    REQUIRE(!c.refutations.empty());
    for (const Refutation& r : c.refutations) {
      if (!r.script) continue;  // it has numbers that JSON lacks
      CHECK(r.script->queries.at(0).question == Question::candidates_within);
      CHECK(r.script->scene.margin > 0);
      CHECK(r.words.find("within the margin") != std::string::npos);
      CHECK(r.bodies <= 4);
    }
  }
}

TEST_CASE("a certificate has the same bytes for any number of jobs, and survives its JSON", "[certify]") {
  const BroadCertificate one = certificate(core_subject("grid"), 700),
                         three = certificate(core_subject("grid"), 700, 3);
  CHECK(to_json(one).dump() == to_json(three).dump());
  bool holds = false;
  const BroadCertificate back = broad_certificate_from_json(to_json(one), holds);
  CHECK(holds);
  CHECK(to_json(back) == to_json(one));
  auto tampered = to_json(one);
  tampered["evidence"][3]["cases"] = 1000000;
  broad_certificate_from_json(tampered, holds);
  CHECK_FALSE(holds);
}

TEST_CASE("a certificate that ran out of time states what was run, and can be run again", "[certify]") {
  const std::atomic<bool> go{false};
  const Subject s = core_subject("grid");
  CertifyConfig c;
  c.limit = 700;
  c.program = "test";
  c.minutes = 1e-9;
  const auto cut = certify(s, c, {}, go);
  REQUIRE(cut);
  std::size_t out_of_time = 0;
  for (const EvidenceCount& e : cut->evidence) {
    CHECK(e.cases > 0);  // the first part always runs
    CHECK(e.out_of_time == (e.cases < e.planned));
    out_of_time += e.out_of_time;
  }
  CHECK(out_of_time > 5);
  CHECK(verdict(*cut, BroadLevel::boxes) == LevelVerdict::certified);
  const auto words = not_proved(*cut);
  CHECK(std::any_of(words.begin(), words.end(), [](const std::string& w) {
    return w.find("when its share of the time was used") != std::string::npos;
  }));
  CertifyConfig again = c;
  again.minutes.reset();
  again.jobs = 3;
  for (const EvidenceCount& e : cut->evidence)
    if (e.out_of_time) again.most_cases[e.name] = e.cases;
  CHECK(to_json(*certify(s, again, {}, go)).dump() == to_json(*cut).dump());
  bool holds = false;
  CHECK(to_json(broad_certificate_from_json(to_json(*cut), holds)) == to_json(*cut));
  CHECK(holds);
  // Time enough changes nothing.
  c.minutes = 1000;
  CHECK(to_json(*certify(s, c, {}, go)).dump() == to_json(certificate(s, 700)).dump());
}

TEST_CASE("every lying broad phase is refuted by a script of few bodies and steps", "[certify]") {
  std::size_t refuted = 0, small = 0;
  for (const mutants::Mutant& m : broad_mutants()) {
    const Subject s{std::string(m.name), "", true,
                    [&m](BroadLevel) { return mutants::make_lying_engine(m); }};
    BroadCertificate c = first_fault(s, BroadLevel::boxes);
    if (exit_code(c) == 0) c = first_fault(s, BroadLevel::bodies);
    INFO(m.name);
    CHECK(exit_code(c) == 1);
    refuted += !c.refutations.empty();
    bool is_small = false;
    for (const Refutation& r : c.refutations) {
      const auto [bodies, steps] = least_script(m.name);
      is_small = is_small || (r.bodies <= bodies && r.steps <= steps);
      UNSCOPED_INFO(to_string(r.level) << ' ' << r.evidence << ' ' << in_words(r.what) << ": " << r.bodies
                                       << " bodies, " << r.steps << " steps, " << r.shrink);
      // The refuting script is a case that replay and shrink judge the same way.
      if (!m.repeats || !r.script) continue;
      const EnginePtr engine = mutants::make_lying_engine(m);
      bool found = false;
      const auto findings = findings_of({&*r.script, 1}, engine);
      for (const auto& [key, f] : findings[0]) found = found || f.fault == r.what.fault;
      CHECK(found);
    }
    CHECK(is_small);
    small += is_small;
  }
  CHECK(refuted == broad_mutants().size());
  CHECK(small == refuted);
}

TEST_CASE("a subject that leaves out a part of the motion is refuted in the quick scope", "[certify]") {
  const std::pair<const char*, OtherMotion::Change> liars[] = {
      {"no motion", [](Motion& m) { m = {}; }},
      {"no travel", [](Motion& m) { m.linear.setZero(); }},
      {"no turning", [](Motion& m) { m.angular.setZero(); }},
      {"not along x", [](Motion& m) { m.linear.x() = 0; }},
      {"not along y", [](Motion& m) { m.linear.y() = 0; }},
      {"not along z", [](Motion& m) { m.linear.z() = 0; }},
      {"half of the way", [](Motion& m) { m.linear *= 0.5; }},
      {"the other way", [](Motion& m) { m.linear = -m.linear; }},
      {"no farther than 16", [](Motion& m) { m.linear *= std::min(1.0, 16 / (m.linear.norm() + 1e-300)); }}};
  for (const auto& [name, change] : liars) {
    const BroadCertificate c = certificate_of_sweeps(change);
    INFO(name);
    CHECK(exit_code(c) == 1);
    REQUIRE_FALSE(c.refutations.empty());
    CHECK(c.refutations[0].what.fault == "missed");
    CHECK(c.refutations[0].bodies == 2);
  }
  const BroadCertificate honest = certificate_of_sweeps([](Motion&) {});
  CHECK(exit_code(honest) == 0);
  // About half of the pairs meet, and pairs that only one part of the motion brings together are checked.
  for (const EvidenceCount& e : honest.evidence) {
    INFO(e.name);
    CHECK(e.pairs_true > e.answered / 8);
    CHECK(e.pairs_true < e.answered * 9 / 10);
  }
}

namespace {

// The core's brute force with injected faults: `fault` alters or removes an answer.
class Faulty final : public Engine {
 public:
  using Fault = void (*)(const Scene&, Observation&);
  explicit Faulty(Fault fault) : fault_(fault), inner_(make_broad_engine("brute_force", BroadBoxes::exact)) {}
  const EngineCard& card() const override { return inner_->card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = inner_->run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) fault_(cases[i].scene, all[i].answers[0]);
    return all;
  }

 private:
  Fault fault_;
  EnginePtr inner_;
};

Subject faulty(Faulty::Fault fault) {
  return {"faulty", "", false, [fault](BroadLevel) { return std::make_unique<Faulty>(fault); }, 1, {}};
}

void fail(Observation& o, Outcome outcome) {
  o = {};
  o.outcome = outcome;
}

std::size_t inserts(const Scene& s) {
  return static_cast<std::size_t>(std::count_if(
      s.script.begin(), s.script.end(), [](const Step& step) { return step.op == Step::Op::insert; }));
}

bool has_half_space(const Scene& s) {
  return std::any_of(s.script.begin(), s.script.end(), [&](const Step& step) {
    return step.op == Step::Op::insert && kind_of(s.shape_of(step.body)) == ShapeKind::half_space;
  });
}

bool has_nan(const Scene& s) {
  return std::any_of(s.script.begin(), s.script.end(), [&](const Step& step) {
    return step.op == Step::Op::insert &&
           !s.bodies[static_cast<std::size_t>(step.body)].pose.translation.allFinite();
  });
}

bool touches(const Scene& s, const BodyPair& p) {
  const auto a = exact_box(s.shape_of(p.first), s.bodies[static_cast<std::size_t>(p.first)].pose),
             b = exact_box(s.shape_of(p.second), s.bodies[static_cast<std::size_t>(p.second)].pose);
  return a && b && (a->hi.x() == b->lo.x() || b->hi.x() == a->lo.x());
}

std::size_t count_of(const BroadCertificate& c, std::string_view fault, FaultKind kind) {
  return static_cast<std::size_t>(
      std::count_if(c.refutations.begin(), c.refutations.end(), [&](const Refutation& r) {
        return r.what == FaultClass{std::string(fault), kind};
      }));
}

}  // namespace

TEST_CASE("a subject that takes touching for apart is refuted by boxes with volume", "[certify]") {
  const Subject open = faulty([](const Scene& scene, Observation& o) {
    for (auto& pairs : o.candidate_pairs)
      std::erase_if(pairs, [&](const BodyPair& p) { return touches(scene, p); });
  });
  const BroadCertificate c = first_fault(open, BroadLevel::boxes);
  REQUIRE_FALSE(c.refutations.empty());
  const Refutation& r = c.refutations[0];
  CHECK(r.what == FaultClass{"missed", FaultKind::touching});
  REQUIRE(r.script);
  CHECK(r.bodies == 2);
  CHECK(r.steps == 3);
  INFO(case_to_json(*r.script).dump());
  CHECK(is_solid(*r.script));
}

TEST_CASE("a subject that times out is neither refuted nor certified, and the time limit to set is named",
          "[certify]") {
  Subject s = faulty([](const Scene& scene, Observation& o) {
    if (scene.bodies.size() > 60) fail(o, Outcome::timed_out);
  });
  static std::vector<double> asked;  // factors on the time limit
  asked.clear();
  s.make_patient = [&](BroadLevel, double times) -> EnginePtr {
    asked.push_back(times);
    if (times >= 4) return make_broad_engine("brute_force", BroadBoxes::exact);
    return s.make(BroadLevel::boxes);
  };
  const BroadCertificate c = certificate(s, 40, 1, {BroadLevel::boxes});
  INFO(to_json(c).dump(1));
  CHECK(exit_code(c) == 3);
  CHECK(verdict(c, BroadLevel::boxes) == LevelVerdict::not_certified);
  CHECK(c.refutations.empty());
  CHECK(c.faults.empty());
  REQUIRE(c.too_slow.size() == 1);
  CHECK(c.too_slow[0].evidence == "moving_crowds");
  CHECK(c.too_slow[0].bodies > 60);
  CHECK(c.too_slow[0].allowed == 1);
  CHECK(c.too_slow[0].sufficient == 4);
  CHECK(asked == std::vector<double>{2, 4});
  // Nor is an engine refuted that is no longer asked because it timed out too often.
  s.make = faulty([](const Scene& scene, Observation& o) {
             if (scene.bodies.size() > 60) fail(o, Outcome::not_asked);
           }).make;
  CHECK(exit_code(certificate(s, 40, 1, {BroadLevel::boxes})) == 3);
  // A fault found elsewhere still refutes.
  s.make = faulty([](const Scene& scene, Observation& o) {
             if (scene.bodies.size() > 60) fail(o, Outcome::timed_out);
             if (inserts(scene) == 3 && !o.candidate_pairs.empty()) o.candidate_pairs.back().clear();
           }).make;
  CHECK(exit_code(certificate(s, 40, 1, {BroadLevel::boxes})) == 1);
}

TEST_CASE("every class of fault is listed, a solid pair first; faults of bad boxes are a separate class",
          "[certify]") {
  const Subject s = faulty([](const Scene& scene, Observation& o) {
    const std::size_t n = inserts(scene);
    if (scene.bodies.size() > 60) return fail(o, Outcome::crashed);
    for (auto& list : o.candidate_pairs)
      std::erase_if(list, [&](const BodyPair& p) { return touches(scene, p); });
    if (n == 3 && scene.script.back().op == Step::Op::query && !o.candidate_pairs.empty())
      std::erase_if(o.candidate_pairs.back(), [](const BodyPair& p) { return p == BodyPair{1, 2}; });
    if (has_nan(scene) || has_half_space(scene))
      for (auto& list : o.candidate_pairs) list.clear();
  });
  const BroadCertificate c = certificate(s, 400, 1, {BroadLevel::boxes});
  INFO(to_json(c).dump(1));
  CHECK(exit_code(c) == 1);
  CHECK(c.evidence.size() ==
        certificate(core_subject("brute_force"), 1, 1, {BroadLevel::boxes}).evidence.size());
  for (const auto kind : {FaultKind::solid, FaultKind::touching, FaultKind::invalid, FaultKind::unbounded})
    CHECK(count_of(c, "missed", kind) == 1);
  CHECK(count_of(c, "crashed", FaultKind::numbers) == 1);
  REQUIRE(c.refutations.size() == 5);
  CHECK(c.refutations[0].what == FaultClass{"missed", FaultKind::solid});
  CHECK(c.refutations[0].bodies == 3);
  CHECK(c.refutations[0].steps == 4);
  // After shrinking it is still solid.
  const Case& script = *c.refutations[0].script;
  const auto v =
      judge_candidates(script, s.make(BroadLevel::boxes)->run({&script, 1})[0].answers[0], BroadLevel::boxes);
  CHECK(v.shows({"missed", FaultKind::solid}));
  for (const FaultCount& f : c.faults)
    if (f.what.kind == FaultKind::solid) CHECK(f.share > 0.01);
  // A pair that touches is lost with and without a NaN beside it.
  CHECK(std::any_of(c.faults.begin(), c.faults.end(), [](const FaultCount& f) {
    return f.evidence == "no_boxes" && f.what == FaultClass{"missed", FaultKind::touching};
  }));
  CHECK(to_json(c) == to_json(certificate(s, 400, 3, {BroadLevel::boxes})));
  bool holds = false;
  CHECK(to_json(broad_certificate_from_json(to_json(c), holds)) == to_json(c));
  CHECK(holds);
  auto old = to_json(c);
  old["touchstone_broad_certificate"] = 1;
  CHECK_THROWS_AS(broad_certificate_from_json(old, holds), InputError);
}

TEST_CASE("a bad box is stored in a case file beside the scene and read back, for candidates only",
          "[certify]") {
  using Json = nlohmann::ordered_json;
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), inf, -inf, -1};
  StoredCase stored;
  Scene& s = stored.c.scene;
  for (int i = 0; i < 4; ++i) add_box(s, {Vec3::Zero(), Vec3::Ones()});
  for (int i = 0; i < 3; ++i) s.bodies[static_cast<std::size_t>(i)].pose.translation.y() = bad[i];
  std::get<Box>(s.shapes[3]).half_extents.z() = bad[3];
  insert_all(s);
  step_move(s, 3, {Vec3(bad[0], 0, 0), {}});
  step_query(s);
  stored.c.queries = {{Question::candidates, -1, -1}};
  const std::string text = to_text(stored);
  const Json j = test::parsed<Json>(text);
  CHECK(j == stored_case_to_json(stored));
  CHECK(j.at("invalid_numbers").dump() ==
        R"({"/shapes/3/half_extents/2":-1,"/bodies/0/pose/translation/1":"NaN",)"
        R"("/bodies/1/pose/translation/1":"Infinity","/bodies/2/pose/translation/1":"-Infinity",)"
        R"("/script/4/pose/translation/0":"NaN"})");
  CHECK(to_text(stored_case_from_json(j)) == text);

  const auto refused = [&](const char* place, const Json& value) {
    Json broken = j;
    broken["invalid_numbers"][place] = value;
    CHECK_THROWS_AS(stored_case_from_json(broken), InputError);
  };
  refused("/bodies/9/pose/translation/1", "NaN");
  refused("/bodies/0/pose/translation/1", 2.0);
  refused("/bodies/0/pose/translation/1", "nan");
  refused("/shapes/3/half_extents/2", 1);
  Json other = j;
  other["queries"] = test::parsed<Json>(R"([{"question": "overlap", "a": 0, "b": 1}])");
  CHECK_THROWS_AS(stored_case_from_json(other), InputError);
}
