#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <thread>

#include "core/base/input_error.h"
#include "fuzz/ask/evidence.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/store.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/truth.h"
#include "oracles/core/core_engine.h"
#include "reports/record/stored.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/family.h"
#include "tests/mutants/lying_engine.h"
#include "tests/support/catch.h"
#include "tests/support/stops_after.h"

using namespace touchstone;
using touchstone::test::StopsAfter;
namespace fs = std::filesystem;

namespace {

// The core and an engine that halves depths, so that there are findings to compare.
std::vector<EnginePtr> two_engines() {
  std::vector<EnginePtr> e;
  e.push_back(std::make_unique<CoreEngine>());
  for (const auto& m : mutants::mutants())
    if (m.name == "depth_halved") e.push_back(mutants::make_lying_engine(m));
  return e;
}

// Engines that lie about verdicts, whose certificates take exact arithmetic.
std::vector<EnginePtr> verdict_liars() {
  std::vector<EnginePtr> e;
  for (const auto& m : mutants::mutants())
    if (m.name == "overlap_always" || m.name == "overlap_deep_denied" || m.name == "impact_late")
      e.push_back(mutants::make_lying_engine(m));
  return e;
}

fuzz::CampaignConfig config_of(std::uint64_t cases) {
  fuzz::CampaignConfig c;
  c.engines = {"core", "depth_halved"};
  c.cases = cases;
  c.seed = 5;
  return c;
}

struct TemporaryDirectory {
  fs::path path = fs::temp_directory_path() / ("touchstone-test-" + std::to_string(getpid()));
  TemporaryDirectory() { fs::remove_all(path); }
  ~TemporaryDirectory() { fs::remove_all(path); }
};

const std::atomic<bool> go{false};

// The core, counting its cases and answering slowly.
class Counts final : public Engine {
 public:
  explicit Counts(int& asked, int ms_a_batch = 0) : asked_(asked), ms_(ms_a_batch) {}
  const EngineCard& card() const override { return core_.card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    asked_ += static_cast<int>(cases.size());
    std::this_thread::sleep_for(std::chrono::milliseconds(ms_));
    return core_.run(cases);
  }

 private:
  CoreEngine core_;
  int& asked_;
  int ms_;
};

// Reports unwritten memory as distances, and crashes at one of two places when queried for a contact.
class Unwritten final : public Engine {
 public:
  const EngineCard& card() const override { return core_.card(); }
  std::vector<CaseObservations> run(std::span<const Case> cases) override { return asked(cases, 7); }
  std::vector<CaseObservations> run_again(std::span<const Case> cases) override { return asked(cases, 70); }

 private:
  std::vector<CaseObservations> asked(std::span<const Case> cases, double garbage) {
    auto all = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t k = 0; k < cases[i].queries.size(); ++k) {
        Observation& o = all[i].answers[k];
        if (cases[i].queries[k].question == Question::distance && o.distance)
          o.distance = garbage + drawn_++ % 2;
        if (cases[i].queries[k].question != Question::contact) continue;
        o = Observation{};
        o.outcome = Outcome::crashed;
        o.site = kind_of(cases[i].scene.shapes[0]) == ShapeKind::box ? "a-inl.h:1" : "b-inl.h:2";
        o.detail = "SIGABRT at " + std::to_string(drawn_++);
      }
    return all;
  }
  CoreEngine core_;
  int drawn_ = 0;  // the contents of memory change from run to run
};

// The core, for spheres, boxes and cylinders only.
class Partial final : public Engine {
 public:
  Partial() {
    card_ = core_.card();
    card_.name = "partial";
    card_.shapes = kinds();
  }
  static std::vector<ShapeKind> kinds() { return {ShapeKind::sphere, ShapeKind::box, ShapeKind::cylinder}; }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (const Shape& s : cases[i].scene.shapes)
        if (!is_sent(card_, kind_of(s)))
          for (Observation& o : all[i].answers) o = no_answer(Outcome::unsupported, "");
    return all;
  }

 private:
  CoreEngine core_;
  EngineCard card_;
};

// The core, which stops answering at the case with this index.
class TiresAt final : public Engine {
 public:
  TiresAt(std::uint64_t index, std::atomic<int>& asked_later) : index_(index), asked_later_(asked_later) {
    card_ = core_.card();
    card_.name = "tires";
  }
  const EngineCard& card() const override { return card_; }
  std::string set_aside() const override { return why_; }
  void resume() override { why_.clear(); }
  void suspend(const std::string& why) override { why_ = why; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = core_.run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const auto index = std::strtoull(cases[i].id.substr(cases[i].id.rfind('/') + 1).c_str(), nullptr, 10);
      asked_later_ += why_.empty() && index >= index_ + 32;
      if (why_.empty() && index >= index_) why_ = "set aside: tired";
      if (why_.empty()) continue;
      for (Observation& o : all[i].answers) {
        o = {};
        o.outcome = Outcome::not_asked;
        o.detail = why_;
      }
    }
    return all;
  }

 private:
  CoreEngine core_;
  EngineCard card_;
  std::uint64_t index_;
  std::atomic<int>& asked_later_;
  std::string why_;
};

}  // namespace

TEST_CASE("answers from unwritten memory are findings without the answer; crashes are named by their site",
          "[campaign]") {
  fuzz::CampaignResult results[2];
  for (fuzz::CampaignResult& r : results) {
    static std::vector<EnginePtr> engines = [] {
      std::vector<EnginePtr> one;
      one.push_back(std::make_unique<Unwritten>());
      return one;
    }();
    for (std::uint64_t i = 0; i < 120; ++i) {
      const Case c = fuzz::make_case(3, i, "shallow");
      fuzz::ask_and_judge(r, {&c, 1}, i, engines, 0);  // a relation between two such answers is random
    }
    fuzz::write_evidence(r);
  }
  std::set<std::string> crashes;
  int unstable = 0;
  for (const auto& [key, f] : results[0].findings) {
    if (f.fault.starts_with("crashed")) crashes.insert(key);
    if (f.question != "distance") continue;
    CHECK(f.fault == "unstable");
    CHECK(f.words == "asked again, it answers differently: distance");
    CHECK_FALSE(f.evidence->observation.distance);
    ++unstable;
  }
  CHECK(crashes == std::set<std::string>{"core.contact.crashed_a-inl-h-1.any.algorithm.any.none",
                                         "core.contact.crashed_b-inl-h-2.any.algorithm.any.none"});
  CHECK(unstable > 3);
  CHECK(fuzz::digest(results[0]) == fuzz::digest(results[1]));
}

TEST_CASE("a campaign of the subject's kinds asks what it answers; what nobody answers is not refereed",
          "[campaign]") {
  const auto partial = [] {
    std::vector<EnginePtr> e;
    e.push_back(std::make_unique<Partial>());
    return e;
  };
  fuzz::CampaignConfig c;
  c.engines = {"partial"};
  c.subject = "partial";
  c.cases = 160;
  c.family = "separate,near,shallow,deep,contained";
  const std::atomic<bool> go{false};
  const auto any = fuzz::run_campaign(c, partial, {}, go);
  c.kinds = Partial::kinds();
  const auto own = fuzz::run_campaign(c, partial, {}, go);
  c.jobs = 3;
  CHECK(fuzz::digest(fuzz::run_campaign(c, partial, {}, go)) == fuzz::digest(own));
  const auto answered = [](const fuzz::CampaignResult& r) {
    return r.tallies.at("partial").at(Question::overlap).answered();
  };
  // A case may ask for an overlap twice.
  CHECK(answered(own) >= 160);
  CHECK(own.not_refereed == 0);
  CHECK(own.pair_cases + own.undecided == 160);
  CHECK(answered(any) < 60);
  CHECK(any.pair_cases + any.undecided + any.not_refereed == 160);
  CHECK(any.pair_cases + any.undecided <= answered(any));
  CHECK(any.levels[0] + any.levels[1] + any.levels[2] == any.pair_cases);
  const fuzz::Json stored = fuzz::to_json(any, true);
  CHECK(fuzz::result_from_json(JsonReader(stored, "stored")).not_refereed == any.not_refereed);
}

TEST_CASE("a campaign runs its first chunk however little time it has", "[campaign]") {
  auto config = config_of(0);
  config.cases.reset();
  config.minutes = 0;
  CHECK(fuzz::run_campaign(config, two_engines, {}, go).cases == 32);
}

TEST_CASE("an engine that gives up is set aside from the same case on for any number of jobs",
          "[campaign][set-aside]") {
  std::atomic<int> asked_later{0};
  const auto engines = [&] {
    auto e = two_engines();
    e.push_back(std::make_unique<TiresAt>(100, asked_later));
    return e;
  };
  auto one = config_of(320), three = config_of(320);
  one.jobs = 1;
  three.jobs = 3;
  const auto a = fuzz::run_campaign(one, engines, {}, go);
  CHECK(asked_later == 0);
  REQUIRE(a.set_aside.contains("tires"));
  CHECK(a.set_aside.at("tires").first_index == 96);
  CHECK(a.set_aside.size() == 1);
  CHECK(a.failed_of("tires") == 0);
  std::uint64_t core = 0, tired = 0;
  for (const auto& [q, t] : a.tallies.at("core"))
    for (const std::uint64_t n : t.outcomes) core += n;
  for (const auto& [q, t] : a.tallies.at("tires"))
    for (const std::uint64_t n : t.outcomes) tired += n;
  CHECK(tired == core);
  CHECK(a.not_asked_of("tires") > core / 2);
  CHECK(a.not_asked_of("core") == 0);
  for (const auto& [key, f] : a.findings) CHECK(f.fault != "not_asked");
  const auto b = fuzz::run_campaign(three, engines, {}, go);
  CHECK(fuzz::to_json(a, false).dump() == fuzz::to_json(b, false).dump());
  const auto stored = fuzz::result_from_json({fuzz::to_json(a, true), "result"});
  CHECK(stored.set_aside.at("tires").why == "set aside: tired");
  CHECK(fuzz::digest(stored) == fuzz::digest(a));
}

TEST_CASE("one job and two jobs find the same, byte for byte", "[campaign]") {
  auto one = config_of(400), two = config_of(400);
  one.jobs = 1;
  two.jobs = 2;
  const auto a = fuzz::run_campaign(one, two_engines, {}, go),
             b = fuzz::run_campaign(two, two_engines, {}, go);
  CHECK(a.cases == 400);
  CHECK(a.findings.size() > 5);
  CHECK(fuzz::to_json(a, false).dump() == fuzz::to_json(b, false).dump());
}

TEST_CASE("a guided campaign is the same for one job and three, and after a stop", "[campaign][guided]") {
  auto one = config_of(1600), three = one;
  one.guided = three.guided = true;
  one.jobs = 1;
  three.jobs = 3;
  const auto a = fuzz::run_campaign(one, two_engines, {}, go),
             b = fuzz::run_campaign(three, two_engines, {}, go);
  CHECK(a.cases == 1600);
  CHECK(fuzz::digest(a) == fuzz::digest(b));
  CHECK(fuzz::digest(a) != fuzz::digest(fuzz::run_campaign(config_of(1600), two_engines, {}, go)));
  CHECK(a.wrong_of("core") == 0);
  TemporaryDirectory dir;
  auto resumed = one;
  resumed.out = dir.path;
  std::atomic<bool> stop{false};
  const auto stopping = [&] {
    auto e = two_engines();
    e[0] = std::make_unique<StopsAfter>(40, stop);
    return e;
  };
  const auto part = fuzz::run_campaign(resumed, stopping, {}, stop);
  CHECK(part.cases < 1600);
  CHECK(part.cases > 0);
  CHECK(fuzz::digest(fuzz::run_campaign(resumed, two_engines, {}, go)) == fuzz::digest(a));
}

TEST_CASE("the default mix is not trivial: 30 to 70 % of its pairs overlap", "[campaign]") {
  const auto r = fuzz::run_campaign(config_of(2000), two_engines, {}, go);
  INFO(r.pair_cases << " pair cases, hit rate " << r.hit_rate());
  CHECK(r.pair_cases > 1500);
  CHECK(r.hit_rate() > 0.3);
  CHECK(r.hit_rate() < 0.7);
}

TEST_CASE("the share of undecided answers is bounded by question and kind of pair", "[campaign][open]") {
  using touchstone::Question;
  fuzz::CampaignResult r;
  auto& of_contact = r.open["core"][Question::contact];
  of_contact["box-box"] = {100, 0};
  of_contact["box-cylinder"] = {20, 5};
  CHECK(r.too_open("core").empty());
  of_contact["cone-cylinder"] = {11, 11};  // too few to tell
  CHECK(r.too_open("core").empty());
  of_contact["cylinder-cylinder"] = {12, 12};  // a referee that decides no cylinder
  REQUIRE(r.too_open("core").size() == 1);
  CHECK(r.too_open("core")[0] ==
        "core: 12 of 12 answers to contact of cylinder-cylinder are undecided or not judged, more than 25 %: "
        "this run proves nothing about them");
  of_contact["capsule-cylinder"] = {400, 400};
  CHECK(r.too_open("core").size() == 3);  // including the question as a whole
  CHECK(r.too_open("fcl-libccd").empty());

  const auto back = fuzz::result_from_json({fuzz::to_json(r, true), "result"});
  CHECK(back.too_open("core") == r.too_open("core"));
  CHECK(fuzz::digest(back) == fuzz::digest(r));
  fuzz::CampaignResult twice = r;
  twice.merge(r);
  CHECK(twice.open["core"][Question::contact]["cone-cylinder"].answers == 22);
  CHECK(twice.too_open("core").size() == 4);
}

TEST_CASE("every answer is right, wrong, undecided or not judged; a surface's depth is not undecided",
          "[campaign][open]") {
  fuzz::CampaignResult r;
  std::vector<EnginePtr> engines;
  engines.push_back(std::make_unique<CoreEngine>());
  std::vector<Case> cases;
  for (std::uint64_t i = 0; i < 300; ++i) cases.push_back(fuzz::make_case(5, i, "shallow"));
  fuzz::ask_and_judge(r, cases, 0, engines, 0);
  std::uint64_t not_judged = 0;
  for (const auto& [q, t] : r.tallies.at("core")) {
    CHECK(t.right + t.wrong + t.undecided + t.not_judged == t.answered());
    CHECK(t.not_judged == t.by_definition);
    not_judged += t.not_judged;
  }
  CHECK(not_judged > 0);
  CHECK(r.by_definition_of("core") == not_judged);
  CHECK(r.too_open("core").empty());
}

TEST_CASE("our core is right on random cases", "[campaign][core]") {
  auto config = config_of(3000);
  config.engines = {"core"};
  config.jobs = 2;
  const auto make = [] {
    std::vector<EnginePtr> e;
    e.push_back(std::make_unique<CoreEngine>());
    return e;
  };
  const auto r = fuzz::run_campaign(config, make, {}, go);
  CHECK(r.wrong_of("core") == 0);
  CHECK(r.failed_of("core") == 0);
  for (const auto& [key, f] : r.findings) UNSCOPED_INFO(key << " case " << f.first_index << ": " << f.words);
  CHECK(r.findings.empty());
}

TEST_CASE("our core is right on fast spins, at the end of the step and in scenes that move",
          "[campaign][core]") {
  for (const char* family : {"whirl", "last", "swarm"}) {
    std::uint64_t impacts = 0;
    for (std::uint64_t i = 0; i < 150; ++i) {
      const Case c = fuzz::make_case(9, i, family);
      CoreEngine core;
      const auto answers = core.run({&c, 1});
      fuzz::Truth truth(c.scene);
      for (const Judgement& j : fuzz::judge(c, core.card(), answers[0], truth)) {
        INFO(c.id << (j.faults.empty() ? "" : ": " + j.faults[0].words));
        REQUIRE((j.undecided || j.right()));
      }
      for (const Query& q : c.queries)
        if (q.question == Question::time_of_impact)
          impacts += truth.motion(0, q.a, q.b).verdict == referee::TimeTruth::Verdict::hit;
    }
    INFO(family << ": " << impacts << " impacts");
    CHECK(impacts >= 30);
  }
}

TEST_CASE("shards together are the whole campaign", "[campaign]") {
  const auto whole = fuzz::run_campaign(config_of(320), two_engines, {}, go);
  fuzz::CampaignResult merged;
  for (std::uint64_t i : {2, 0, 1}) {
    auto c = config_of(320);
    c.shard = i;
    c.shards = 3;
    merged.merge(fuzz::run_campaign(c, two_engines, {}, go));
  }
  CHECK(fuzz::digest(merged) == fuzz::digest(whole));
}

TEST_CASE("a campaign stopped half way resumes to the same findings", "[campaign]") {
  TemporaryDirectory dir;
  const auto whole = fuzz::run_campaign(config_of(320), two_engines, {}, go);
  auto c = config_of(320);
  c.out = dir.path;
  std::atomic<bool> stop{false};
  int reports = 0;
  const auto stop_early = [&](const fuzz::Progress& p) { stop = ++reports >= 1 && p.result.cases > 0; };
  // A chunk at a time, so that the stop comes in the middle whatever the machine's speed.
  fuzz::CampaignResult part;
  {
    fuzz::StoredState half;
    auto first = config_of(128);
    half.result = fuzz::run_campaign(first, two_engines, {}, go);
    half.next_chunk = 4;
    fs::create_directories(c.out);
    fuzz::save_state(c, half);
  }
  part = fuzz::run_campaign(c, two_engines, stop_early, go);
  CHECK(part.cases == 320);
  CHECK(fuzz::digest(part) == fuzz::digest(whole));
  SECTION("a finished one is not restarted") {
    CHECK_THROWS_AS(fuzz::run_campaign(c, two_engines, {}, go), InputError);
  }
  SECTION("one with other settings is refused") {
    c.seed = 6;
    CHECK_THROWS_AS(fuzz::run_campaign(c, two_engines, {}, go), InputError);
  }
  SECTION("every finding has its case on disk") {
    std::size_t n = 0;
    for (const auto& [key, f] : part.findings) n += fs::exists(dir.path / "findings" / key / "case.json");
    CHECK(n == part.findings.size());
  }
}

TEST_CASE("an engine that hangs on a query of a case is not asked in the case's other forms", "[campaign]") {
  const Case c = fuzz::make_case(1, 0, "near");
  REQUIRE(c.queries.size() > 1);
  int asked = 0;
  const EnginePtr engine = std::make_unique<Counts>(asked);
  auto base = engine->run(std::span(&c, 1)).front();
  fuzz::CampaignResult r;
  fuzz::relate_into(r, c, 0, engine, base);
  CHECK(asked > 5);
  asked = 0;
  base.answers.back().outcome = Outcome::timed_out;
  fuzz::relate_into(r, c, 0, engine, base);
  CHECK(asked == 0);
}

TEST_CASE("a finding's certificate is created by the job that found it, not when the state is saved",
          "[campaign]") {
  TemporaryDirectory dir;
  auto c = config_of(320);
  c.out = dir.path;
  int asked = 0;
  const auto slow_ones = [&] {  // progress is reported twice a second
    auto engines = two_engines();
    engines.push_back(std::make_unique<Counts>(asked, 200));
    return engines;
  };
  std::size_t seen = 0, made = 0;
  fuzz::run_campaign(
      c, slow_ones,
      [&](const fuzz::Progress& p) {
        if (p.last) return;
        for (const auto& [key, f] : p.result.findings) {
          ++seen;
          made += !f.evidence_json.is_null();
        }
      },
      go);
  REQUIRE(seen > 0);
  CHECK(made == seen);
}

TEST_CASE("a deferred certificate is the one that would have been made at once", "[campaign]") {
  auto later = config_of(320);
  later.engines = {"overlap_always", "overlap_deep_denied", "impact_late"};
  auto now = later;
  now.certificates = true;
  const auto a = fuzz::run_campaign(later, verdict_liars, {}, go),
             b = fuzz::run_campaign(now, verdict_liars, {}, go);
  REQUIRE(a.findings.size() == b.findings.size());
  std::map<std::string, int> deferred;
  for (const auto& [key, f] : a.findings) {
    CAPTURE(key);
    const fuzz::Json &evidence = f.evidence_json, &made = b.findings.at(key).evidence_json.at("certificate"),
                     &left = evidence.at("certificate");
    CHECK_FALSE(fuzz::is_deferred(made));
    if (!fuzz::is_deferred(left)) {
      CHECK(left == made);
      continue;
    }
    ++deferred[f.question];
    const Case c = case_from_json(evidence.at("case"), key);
    CHECK(fuzz::deferred_certificate(c, evidence.at("observation"), left, "f.json") == made);
  }
  CHECK(deferred["overlap"] > 0);
  CHECK(deferred["time_of_impact"] > 0);
}

TEST_CASE("a damaged deferred certificate is refused with the place", "[campaign]") {
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  const fuzz::Json observation = {{"outcome", "answered"}, {"toi", 0.5}};
  const fuzz::Json good = {{"kind", "deferred"},
                           {"question", "overlap"},
                           {"found", {{"kind", "common_point"}, {"point", {0, 0, 0}}}},
                           {"bodies", {0, 1}}};
  CHECK(fuzz::deferred_certificate(c, observation, good, "f.json").at("kind") == "common_point");
  const auto refuses = [&](const char* part, const fuzz::Json& value, const char* place) {
    CAPTURE(part);
    fuzz::Json bad = good;
    bad[part] = value;
    try {
      fuzz::deferred_certificate(c, observation, bad, "f.json");
      FAIL("was accepted");
    } catch (const InputError& e) {
      CHECK(std::string(e.what()).find(place) != std::string::npos);
    }
  };
  refuses("question", "rumour", "f.json: certificate.question");
  refuses("bodies", {0}, "f.json: certificate.bodies");
  refuses("found", {{"kind", "rumour"}}, "certificate");
  fuzz::Json absent = good;
  absent["bodies"] = {0, 7};
  // Nothing is made: what the file has is left as it is.
  CHECK(fuzz::deferred_certificate(c, observation, absent, "f.json") == good.at("found"));
}

TEST_CASE("a point visible from every facet of the referee's polytope does not loop forever", "[campaign]") {
  const Case c = load_case(TS_SOURCE_DIR "/tests/referee/cases/mesh_cone_no_horizon.json");
  fuzz::Truth truth(c.scene);
  const referee::TimeTruth& t = truth.motion(0, 0, 1);
  CHECK(t.verdict == referee::TimeTruth::Verdict::hit);
  // Our own core, which shares no code with the referee, finds the same time.
  CHECK(t.t_lo <= 0.14125937686);
  CHECK(t.t_hi >= 0.14125937684);
}

TEST_CASE("a case that shows several findings is stored once and read back completely", "[campaign]") {
  fuzz::CampaignResult r;
  fuzz::Evidence evidence;
  evidence.c.scene.shapes = {Sphere{1}};
  evidence.c.scene.bodies.resize(2);
  evidence.c.queries = {{Question::overlap, 0, 1}};
  const auto shared = std::make_shared<const fuzz::Evidence>(evidence);
  for (const std::string fault : {"missed", "ghost", "crashed"}) {
    fuzz::Finding f;
    f.engine = "e";
    f.question = "overlap";
    f.fault = fault;
    f.count = 1;
    f.shapes = "sphere-sphere";
    f.blame = "algorithm";
    f.degeneracy = "solid";
    f.magnitude = "gross";
    f.evidence = shared;
    r.findings[f.key()] = f;
  }
  fuzz::write_evidence(r);
  const auto j = fuzz::to_json(r, true);
  const std::string text = j.dump();
  CHECK(text.find("\"radius\"") != std::string::npos);
  CHECK(text.find("\"radius\"") == text.rfind("\"radius\""));
  const fuzz::CampaignResult back = fuzz::result_from_json({j, "result"});
  for (const auto& [key, f] : back.findings) CHECK(f.evidence_json == r.findings.at(key).evidence_json);
  CHECK(fuzz::to_json(back, true).dump() == text);
}
