// The chart's statistics on hand-made samples, the chart of our core and of lying engines, ladders, and both
// commands as a user meets them.
#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/input_error.h"
#include "fuzz/judge/exact_map.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/pair_forms.h"
#include "oracles/abi/measure.h"
#include "oracles/core/core_engine.h"
#include "reports/chart/chart.h"
#include "reports/chart/chart_rows.h"
#include "reports/chart/sub_steps.h"
#include "reports/stability/stability.h"
#include "tests/support/catch.h"
#include "tests/support/parsed.h"
#include "tests/support/skip.h"
#include "tests/support/workspace.h"

using namespace touchstone;
using namespace touchstone::fuzz;
using touchstone::test::read_all;
using touchstone::test::Workspace;

namespace {

ChartSample sample(const std::string& engine, double error, std::vector<double> ns) {
  ChartSample s{engine, "contact", "near", "box-box", "1", 2, {}, std::move(ns)};
  s.judgement.outcome = Outcome::answered;
  s.judgement.worst_in_l = error;
  return s;
}

ChartSample wrong(ChartSample s, Fault f) {
  FaultReport r;
  r.fault = f;
  s.judgement.faults.push_back(r);
  return s;
}

const ChartRow& overall(const std::vector<ChartRow>& rows, const std::string& engine) {
  for (const ChartRow& r : rows)
    if (r.engine == engine && r.regime.empty() && r.pair.empty() && r.scale.empty()) return r;
  throw std::runtime_error("no row of " + engine);
}

std::vector<EnginePtr> the_core() {
  std::vector<EnginePtr> e;
  e.push_back(make_core_engine());
  return e;
}

// Answers "apart" to every question: fast and wrong.
class Denier final : public Engine {
 public:
  Denier() { card_.name = "denier"; }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    std::vector<CaseObservations> all;
    for (const Case& c : cases) {
      auto& r = all.emplace_back();
      r.received.bodies.resize(c.scene.bodies.size());
      r.received.shapes.resize(c.scene.shapes.size());
      for (std::size_t i = 0; i < c.queries.size(); ++i) {
        Observation& o = r.answers.emplace_back();
        o.outcome = Outcome::answered;
        o.overlap = false;
        o.elapsed_ns = 1;
      }
    }
    return all;
  }

 private:
  EngineCard card_;
};

// The core, except that where `lies` holds its distance is too large by half the size.
class Fickle final : public Engine {
 public:
  using Lies = bool (*)(const Case&, const Query&);
  Fickle(const std::string& name, Lies lies) : lies_(lies) { card_.name = name; }
  const EngineCard& card() const override { return card_; }
  std::vector<CaseObservations> run(std::span<const Case> cases) override {
    auto all = core_->run(cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t q = 0; q < cases[i].queries.size(); ++q) {
        Observation& o = all[i].answers[q];
        if (o.distance && lies_(cases[i], cases[i].queries[q]))
          *o.distance += 0.5 * std::get<Box>(cases[i].scene.shape_of(0)).half_extents.x();
      }
    return all;
  }

 private:
  Lies lies_;
  EngineCard card_;
  EnginePtr core_ = make_core_engine();
};

}  // namespace

TEST_CASE("a row's times are quantiles of each query's least time, its spread is that of the rounds",
          "[chart]") {
  ChartRows rows;
  for (int i = 1; i <= 101; ++i) rows.add(sample("a", i * 1e-3, {i + 100.0, i * 1.0, i + 50.0}));
  const auto all = rows.rows();
  CHECK(all.size() == 6);  // all, regime, scale, pair, regime × scale, pair × regime
  const ChartRow& r = overall(all, "a");
  CHECK(r.answers == 101);
  CHECK(r.ns_min == 1);
  CHECK(r.ns_median == 51);
  CHECK(r.ns_p99 == 100);
  CHECK(r.ns_spread == Approx((101.0 - 51.0) / 51.0));
  CHECK(r.error_p50 == Approx(0.051));
  CHECK(r.error_p99 == Approx(0.1));
  CHECK(r.error_max == Approx(0.101));
  CHECK(r.unsound.empty());
}

TEST_CASE("an engine that is wrong, fails or declines is not on the front, and its row says why", "[chart]") {
  ChartRows rows;
  for (int i = 0; i < 10; ++i) {
    rows.add(sample("exact", 1e-16, {900}));
    rows.add(sample("rough", 1e-6, {100}));
    rows.add(sample("dominated", 1e-6, {500}));
    rows.add(sample("alike", 1e-6, {102}));  // neither faster nor slower than rough
    rows.add(i ? sample("misses", 0, {1}) : wrong(sample("misses", 0.5, {1}), Fault::missed));
    rows.add(i ? sample("off", 0, {1}) : wrong(sample("off", 0.5, {1}), Fault::infeasible));
    ChartSample crashes = sample("crashes", 0, {1}), partial = sample("partial", 0, {1});
    if (i == 0) {
      crashes.judgement.outcome = Outcome::crashed;
      partial.judgement.outcome = Outcome::unsupported;
    }
    rows.add(crashes);
    rows.add(partial);
    rows.add(sample("piped", 0, {}));
  }
  const auto all = rows.rows();
  CHECK(overall(all, "exact").front);
  CHECK(overall(all, "rough").front);
  CHECK(overall(all, "alike").front);
  CHECK_FALSE(overall(all, "dominated").front);
  CHECK(overall(all, "rough").tie);
  CHECK(overall(all, "alike").tie);
  CHECK_FALSE(overall(all, "exact").tie);
  CHECK(overall(all, "dominated").unsound.empty());
  for (const char* name : {"misses", "off", "crashes", "partial", "piped"})
    CHECK_FALSE(overall(all, name).front);
  CHECK(overall(all, "piped").unsound == "its times include the pipe");
  CHECK_FALSE(is_timed(overall(all, "piped")));
  CHECK(is_timed(overall(all, "exact")));
  CHECK(overall(all, "misses").unsound == "1 missed of 10");
  CHECK(overall(all, "off").unsound == "1 wrong of 10");
  CHECK(overall(all, "crashes").unsound == "1 failed of 10");
  CHECK(overall(all, "partial").unsound == "answers 9 of 10");
}

TEST_CASE("noise in the times moves no engine onto or off the front", "[chart]") {
  std::size_t clear = 0, moved = 0;
  const auto place = [](const ChartRow& r) { return r.front ? r.tie ? 1 : 2 : 0; };
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::vector<ChartRow> one(8);
    Rng rng = Rng::stream(77, seed);
    for (std::size_t i = 0; i < one.size(); ++i) {
      one[i].engine = std::to_string(i);
      one[i].ns_median = std::exp(rng.uniform(4, 9));
      one[i].error_p99 = one[i].error_max = std::pow(10, -static_cast<double>(rng.below(4)));
    }
    auto other = one;
    for (ChartRow& r : other) r.ns_median *= rng.uniform(0.7, 1.0 / 0.7);
    mark_fronts(one);
    mark_fronts(other);
    for (std::size_t i = 0; i < one.size(); ++i) {
      CHECK(std::abs(place(one[i]) - place(other[i])) < 2);
      clear += place(one[i]) == 2;
      moved += place(one[i]) != place(other[i]);
    }
  }
  CHECK(clear > 200);
  CHECK(moved > 20);  // the noise has an effect
}

TEST_CASE("repeated queries give the least mean of a batch", "[chart]") {
  int asked = 0;
  const auto ns = least_mean_ns(1'000'000, 2'000'000, [&] { ++asked; });
  CHECK(asked > 100);
  CHECK(ns < 1'000'000);
  CHECK(least_mean_ns(5'000, 1'000, [&] { FAIL("the budget was spent before"); }) == 5'000);
}

TEST_CASE("the core is sound on the chart's cases, and an engine that denies contacts is not", "[chart]") {
  auto engines = the_core();
  engines.push_back(std::make_unique<Denier>());
  const auto broad = the_core();
  const ChartScope scope{"test", 1, 4, 2, false, {24}};
  const Chart chart = measure_chart(scope, 5, engines, broad, {});
  CHECK(chart.engines.size() == 3);
  std::size_t core = 0;
  std::uint64_t denied = 0;
  for (const ChartRow& r : chart.rows) {
    INFO(r.question << " " << r.regime << " " << r.pair << " " << r.scale);
    if (r.engine == "core") {
      ++core;
      CHECK(r.unsound == "");
      CHECK(r.wrong == 0);
      CHECK(r.ns_min > 0);
    } else if (r.question == "overlap" && r.regime.empty() && r.pair.empty() && r.scale.empty()) {
      denied = r.missed;
      CHECK_FALSE(r.front);
    }
  }
  CHECK(core > 400);
  CHECK(denied > 200);  // of 420, in which two regimes and half of another overlap
  const Json j = test::parsed<Json>(fuzz::to_json(chart).dump());
  const std::string csv = to_csv(chart);
  CHECK(j["rows"].size() == chart.rows.size());
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == chart.rows.size() + 1);
  for (const auto& row : j["rows"]) CHECK(row.size() == j["columns"].size());
}

TEST_CASE("sub-stepping reports the first overlapping sample, and misses passes between samples", "[chart]") {
  // A ball of radius 1 moves by 16 along x through another: they overlap from t = 6/16 to 10/16.
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.scene.bodies[0].pose.translation = Vec3(-8, 0, 0);
  c.scene.bodies[0].motion = Motion{Vec3(16, 0, 0), Vec3::Zero()};
  c.queries = {{Question::time_of_impact, 0, 1}, {Question::overlap, 0, 1}};
  const std::shared_ptr<Engine> core = make_core_engine();
  const std::pair<int, std::optional<double>> expected[] = {
      {1, std::nullopt}, {2, 0.5}, {3, std::nullopt}, {4, 0.5}, {5, 0.4}, {16, 0.375}, {256, 0.375}};
  for (const auto& [steps, t] : expected) {
    INFO(steps);
    const EnginePtr e = sub_stepped(core, steps);
    CHECK(e->card().name == "core-steps@" + std::to_string(steps));
    const auto answers = e->run({&c, 1});
    REQUIRE(answers.size() == 1);
    REQUIRE(answers[0].answers.size() == 2);
    CHECK(answers[0].answers[0].outcome == Outcome::answered);
    CHECK(answers[0].answers[0].toi == t);
    CHECK(answers[0].answers[1].outcome == Outcome::unsupported);
    Truth truth(c.scene);
    const auto judged = judge(c, e->card(), answers[0], truth);
    CHECK(judged[0].right() == (steps == 16 || steps == 256));
  }
}

TEST_CASE("sub-steps of a batch of motions are those of each, and refusals stay refusals", "[chart]") {
  const auto some = impact_chart_cases(9, 6);
  std::vector<Case> cases;
  for (const ChartCase& c : some) cases.push_back(c.c);
  const std::shared_ptr<Engine> core = make_core_engine();
  const EnginePtr many = sub_stepped(core, 40);
  const auto together = many->run(cases);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto alone = many->run({&cases[i], 1});
    CHECK(alone[0].answers[0] == together[i].answers[0]);
    hits += together[i].answers[0].toi.has_value();
  }
  CHECK(hits > 6);
  CHECK(hits < cases.size());
  const EnginePtr floats = sub_stepped(std::make_shared<CoreEngine>(Arithmetic::float32), 4);
  Case mesh = cases[0];
  mesh.scene.shapes[0] = TriangleMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
  mesh.scene.bodies[0].shape = 0;
  CHECK(floats->run({&mesh, 1})[0].answers[0].outcome == Outcome::unsupported);
}

TEST_CASE("names of sub-stepped engines", "[chart]") {
  const auto n = sub_steps_name("bullet-f64-query-steps@16");
  REQUIRE(n);
  CHECK(n->engine == "bullet-f64-query");
  CHECK(n->steps == 16);
  for (const char* bad : {"core", "core-steps@", "core-steps@0", "core-steps@-1", "core-steps@4x", "-steps@4",
                          "core-steps@9999999"})
    CHECK_FALSE(sub_steps_name(bad));
}

TEST_CASE("ladders name where a lying engine begins to fail, and the core fails nowhere", "[stability]") {
  auto engines = the_core();
  engines.push_back(std::make_unique<Denier>());
  const Stability s = climb("gap", 3, 6, engines, {});
  REQUIRE(s.results.size() == 6);
  for (const LadderResult& r : s.results) {
    INFO(r.engine << " " << r.question);
    CHECK(r.rungs.size() == 9);
    if (r.engine == "core") CHECK_FALSE(r.fails_at());
    if (r.engine == "denier" && r.question == "overlap") CHECK(r.fails_at() == 0x1p-4);
    for (const Rung& rung : r.rungs) CHECK(rung.asked == 6);
    for (std::size_t form = 0; form < form_count; ++form) CHECK_FALSE(r.breaks_at(form));
  }
  CHECK_THROWS_AS(climb("no-such", 1, 1, engines, {}), InputError);
}

TEST_CASE("an engine that depends on the frame, the order or the unit fails only in that", "[stability]") {
  std::vector<EnginePtr> engines;
  engines.push_back(std::make_unique<Fickle>("order", [](const Case&, const Query& q) { return q.a > q.b; }));
  engines.push_back(std::make_unique<Fickle>("frame", [](const Case& c, const Query&) {
    const Body& a = c.scene.bodies[0];  // it lies at the origin, and its axes are permuted or rotated
    return a.pose.rotation.w == 0 && a.pose.rotation.x == 1;
  }));
  engines.push_back(std::make_unique<Fickle>("unit", [](const Case& c, const Query&) {
    const auto& box = std::get<Box>(c.scene.shape_of(0));
    return box.half_extents.x() > 100;
  }));
  const Stability s = climb("angle", 3, 4, engines, {});
  REQUIRE(s.results.size() == 9);
  for (const LadderResult& r : s.results) {
    INFO(r.engine << " " << r.question);
    CHECK_FALSE(r.fails_at());  // as asked they are right
    for (std::size_t k = 0; k < form_count; ++k) {
      const bool fails = r.engine == form_columns[k] && r.question == "distance";
      CHECK(r.breaks_at(k) == (fails ? std::optional(0x1p-2) : std::nullopt));
      if (fails) CHECK(r.rungs.back().spread[k] > 0.1);
      if (fails) CHECK(r.rungs.back().broken[k] == 4);
    }
  }
}

TEST_CASE("other forms of a pair are the same to the last bit", "[stability]") {
  std::size_t frames = 0, moved = 0, with_axis = 0;
  for (const LadderRow& l : ladders()) {
    if (l.questions[0] != Question::overlap) continue;
    for (int i = 0; i < 12; ++i) {
      Rng rng = Rng::stream(11, static_cast<std::uint64_t>(i));
      Case c;
      c.scene = l.make(rng, l.values[0]);
      c.queries = {{Question::distance, 0, 1}};
      Truth truth(c.scene);
      const auto gap = truth.pair(0, 0, 1).gap;
      for (const PairForm& f : other_forms(c, rng)) {
        if (f.kind == FormKind::nudged) continue;
        INFO(l.name << " " << i << " " << form_columns[static_cast<std::size_t>(f.kind)]);
        Truth there(f.c.scene);
        const Query& q = f.c.queries[0];
        const auto same = there.pair(0, q.a, q.b).gap;
        CHECK(same.lo <= f.scale * gap.hi);
        CHECK(same.hi >= f.scale * gap.lo);
        frames += f.kind == FormKind::frame;
        moved += f.kind == FormKind::frame && f.c.scene.bodies[0].pose.translation.isZero() &&
                 !c.scene.bodies[0].pose.translation.isZero();
      }
      with_axis += std::any_of(c.scene.shapes.begin(), c.scene.shapes.end(), has_own_axis);
    }
  }
  CHECK(frames > 200);
  CHECK(with_axis > 10);
  CHECK(moved > 2);
}

TEST_CASE("a translation that rounds is not another form of the scene", "[stability]") {
  Scene s;
  s.shapes = {Sphere{1}};
  s.bodies.resize(2);
  s.bodies[1].pose.translation = Vec3(0x1p-60, 0, 0);
  CHECK_FALSE(translate_by(s, Vec3(1, 0, 0)));
  s.bodies[1].pose.translation = Vec3(0x1p-50, 0, 0);
  CHECK(translate_by(s, Vec3(1, 0, 0)));
}

TEST_CASE("every ladder makes scenes of its questions at every rung", "[stability]") {
  std::size_t made = 0;
  for (const LadderRow& l : ladders())
    for (double v : l.values) {
      INFO(l.name << " " << v);
      Rng rng(made);
      const Scene s = l.make(rng, v);
      CHECK_NOTHROW(validate(s));
      const bool moves =
          std::any_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.motion.has_value(); });
      CHECK(moves == (l.questions[0] == Question::time_of_impact));
      CHECK(s.script.empty() == (l.questions[0] != Question::candidates));
      ++made;
    }
  CHECK(made > 70);
}

namespace {

Json corpus_answer(const std::string& file, const std::string& engine, const std::string& question) {
  const Workspace w("swept");
  const auto r =
      w.touchstone("replay " TS_SOURCE_DIR "/scenarios/corpus/" + file + " --json --engines " + engine);
  INFO(r.err);
  REQUIRE(r.code <= 1);
  const Json cases = test::parsed<Json>(r.out);
  for (const Json& q : cases[0]["queries"])
    if (q["question"] == question) return q["engines"][engine]["answer"];
  return Json();
}

bool has_plugin(const char* name) {
  return std::filesystem::exists(TS_BINARY_DIR "/lib/libtouchstone_" + std::string(name) + ".so");
}

// A ball of radius 0.05 goes through a plate of thickness 0.01 at t = 0.4725.
const std::string tunnel_case = "fcl-naive-thin-plate-tunnel.json", when = "time_of_impact";

}  // namespace

TEST_CASE("a swept setting reaches the core", "[cli][chart]") {
  CHECK(corpus_answer(tunnel_case, "core-speculative@1", when)["toi"].get<double>() == Approx(0.4725));
  CHECK(corpus_answer(tunnel_case, "core-steps@64", when)["toi"] == 31.0 / 64);
  CHECK(corpus_answer(tunnel_case, "core-extended", "distance")["distance"].get<double>() == Approx(0.945));
}

TEST_CASE("a swept setting reaches FCL", "[cli][chart][optional]") {
  if (!has_plugin("fcl_sweep")) return test::skip("FCL is not built in");
  CHECK_FALSE(corpus_answer(tunnel_case, "fcl-naive@16", when).contains("toi"));
  CHECK(corpus_answer(tunnel_case, "fcl-naive@256", when)["toi"] == 121.0 / 255);
  // Only CCDC_NAIVE reads toc_err.
  CHECK(corpus_answer(tunnel_case, "fcl-advance@1e-2", when)["toi"] ==
        corpus_answer(tunnel_case, "fcl-advance@1e-8", when)["toi"]);
  CHECK(corpus_answer(tunnel_case, "fcl-naive@16", "overlap")["outcome"] == "unsupported");
}

TEST_CASE("a swept setting reaches Bullet", "[cli][chart][optional]") {
  if (!has_plugin("bullet_sweep_f64")) return test::skip("Bullet is not built in");
  CHECK_FALSE(corpus_answer(tunnel_case, "bullet-f64-cast@0.1", when).contains("toi"));
  CHECK(corpus_answer(tunnel_case, "bullet-f64-cast@0.001", when)["toi"].get<double>() == Approx(0.473));
  const auto gap = [](const std::string& engine) {
    return corpus_answer(tunnel_case, engine, "distance")["distance"].get<double>();
  };
  CHECK(gap("bullet-f64-minkowski@0") == Approx(0.945));
  CHECK(gap("bullet-f64-minkowski@0.04") < 0.93);
}

TEST_CASE("a swept setting reaches libccd", "[cli][chart][optional]") {
  if (!has_plugin("libccd_sweep")) return test::skip("libccd is not built in");
  const std::string deep = "parry-70-capsule-cuboid-sweep-y0.25.json";
  CHECK(corpus_answer(deep, "libccd-gjk-iterations@8", "contact")["outcome"] == "not_converged");
  CHECK(corpus_answer(deep, "libccd-gjk-iterations@128", "contact")["outcome"] == "answered");
}

TEST_CASE("stability follows motions, and the motion of a scenario", "[cli][stability]") {
  const Workspace w("motions");
  const auto all = w.touchstone("stability --motions --count 1 --frames 4 --engines core --out m");
  INFO(all.out << all.err);
  CHECK(all.code == 0);
  std::istringstream lines(all.out);
  for (std::string line; std::getline(lines, line);)
    CHECK((line.size() <= 80 || line.starts_with("exit code")));
  const Json motions = test::parsed<Json>(read_all(w.dir / "m/motions.json"));
  CHECK(motions["results"].size() == motions["rows"].size());
  for (const Json& r : motions["results"]) {
    CHECK(r["frames"] == 4);
    CHECK(r["state_asked"] > 0);  // the worker of the core can be replaced
    CHECK(r["state_differs"] == 0);
  }
  CHECK(read_all(w.dir / "m/motions.csv").starts_with("motion,engine,motions,frames,answers"));
  const auto one = w.touchstone("stability --motion slides_off_a_table --engines core --json --out o");
  CHECK(one.code == 0);
  CHECK(test::parsed<Json>(one.out)["results"][0]["switches"] == 1);
  const auto none = w.touchstone("stability --motion drake-1668-cubes-corner-overlap --engines core --out n");
  CHECK(none.code == 2);
  CHECK(none.err.find("is no motion") != std::string::npos);
  CHECK(w.touchstone("stability --motion nothing --engines core --out n").code == 2);
}

TEST_CASE("every question of a ladder has a table", "[cli][stability]") {
  const Workspace w("stability");
  for (const LadderRow& l : ladders()) {
    INFO(l.name);
    const auto s =
        w.touchstone("stability --quick --ladder " + std::string(l.name) + " --engines core --out s");
    CHECK(s.code == 0);
    for (const Question q : l.questions)
      CHECK(s.out.find("\n" + std::string(to_string(q)) + " ") != std::string::npos);
  }
}

TEST_CASE("chart and stability write text, CSV and JSON, with or without a page", "[cli][chart]") {
  const Workspace w("chart");
  const auto s = w.touchstone("stability --quick --ladder angle --engines core --out s");
  INFO(s.err);
  CHECK(s.code == 0);
  CHECK(s.out.find("angle: faces out of parallel") != std::string::npos);
  CHECK(test::parsed<Json>(read_all(w.dir / "s/stability.json"))["results"].size() == 3);
  CHECK(read_all(w.dir / "s/stability.csv").starts_with("ladder,engine,question,value"));
  const auto c = w.touchstone("chart --quick --engines core --broad grid --measure 0 --out c");
  INFO(c.out << c.err);
  CHECK(c.code == 0);
  std::istringstream lines(c.out);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
  const Json chart = test::parsed<Json>(read_all(w.dir / "c/chart.json"));
  CHECK(chart["rows"].size() > 100);
  CHECK(chart["machine"]["cores"].get<int>() > 0);
  CHECK(w.touchstone("stability --ladder nothing --engines core").code == 2);
  CHECK(w.touchstone("chart --engines core --broad nothing").code == 2);
}
