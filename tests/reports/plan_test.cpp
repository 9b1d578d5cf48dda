// A plan holds on its scene, can be read back from its JSON, and refuses what it cannot prove.
#include "reports/plan/plan.h"

#include <cmath>
#include <map>

#include "core/base/input_error.h"
#include "core/math/rng.h"
#include "reports/plan/plan_evidence.h"
#include "reports/plan/plan_measure.h"
#include "reports/text/record_text.h"
#include "tests/support/catch.h"
#include "tests/support/characters.h"
#include "tests/support/parsed.h"

using namespace touchstone;
using namespace touchstone::fuzz;

namespace {

// A random heap of boxes and of hulls with 60 corners on a ball; one body is fast.
Scene heap(int n) {
  Rng rng(3);
  Scene s;
  std::vector<Vec3> corners;
  while (corners.size() < 60) {
    const Vec3 d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    if (d.norm() > 0.1 && d.norm() < 1) corners.push_back(0.3 * d.normalized());
  }
  s.shapes = {Box{{0.2, 0.3, 0.4}}, make_hull(corners), Box{{5, 5, 0.1}}};
  for (int i = 0; i < n; ++i) {
    Body b;
    b.shape = i % 2;
    b.name = "body" + std::to_string(i);
    b.pose = {{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.2, 1)},
              Quat{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), 1}};
    b.motion = Motion{{0, 0, i == 4 ? -2.0 : -0.001}, Vec3::Zero()};
    s.bodies.push_back(b);
  }
  Body ground;
  ground.shape = 2;
  ground.is_static = true;
  s.bodies.push_back(ground);
  return s;
}

PlanOptions quick(double error) {
  PlanOptions o;
  o.error = error;
  o.rounds = 1;
  o.judged = 12;
  return o;
}

const PlanRow& plan_row(const Plan& p) {
  return *std::find_if(p.rows.begin(), p.rows.end(), [](const PlanRow& r) { return r.is_plan; });
}

}  // namespace

TEST_CASE("a plan holds on its scene and can be run from its JSON", "[plan]") {
  const Course course = course_of(heap(24));
  const Plan p = make_plan(course, quick(1e-2));
  CHECK(p.bodies == 25);
  CHECK(p.steps == 8);
  CHECK(p.judged == 12);
  CHECK(plan_row(p).outside == 0);
  CHECK(plan_row(p).error <= 1e-2);
  CHECK(p.pairs.size() >= 3);
  for (const PlanPair& x : p.pairs) CHECK(x.certified_error <= 1e-2);
  // Only the fast body.
  REQUIRE(p.swept.size() == 1);
  CHECK(p.swept[0].body == 4);
  CHECK(p.swept[0].reason == "travel");
  for (const PlanRow& r : p.rows)
    if (r.name.find("none swept") != std::string::npos) CHECK_FALSE(r.sound());

  const Json j = test::parsed<Json>(to_json(p).dump());
  PlanOptions again = quick(0);
  again.given = fidelity_from_json(j.at("run"), "run");
  CHECK(to_json(*again.given) == p.run);
  const Plan q = make_plan(course, again);
  CHECK(q.error == p.run["error"].get<double>());  // the plan's own, which may be tighter
  CHECK(plan_row(q).outside == 0);
  CHECK(q.broad_phase == p.broad_phase);

  const std::string text = reports::plan_text(p);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find('\n', from);
    INFO(text.substr(from, end - from));
    CHECK(test::characters(std::string_view(text).substr(from, end - from)) <= 80);
    from = end + 1;
  }
  CHECK(text.find("body4") != std::string::npos);
  CHECK(text.find("1 of 25 bodies (because of travel)") != std::string::npos);
}

TEST_CASE("the referee detects a wrong plan", "[plan]") {
  const Course course = course_of(heap(24));
  Fidelity lie;
  lie.error = 1e-3;
  lie.simpler = {std::nullopt, SimplerShape{Sphere{0.25}, {}, 1e-4}};
  const EndPoses poses = end_poses(course);
  const PlanSample sample(course, poses, course_candidates(course, poses), 1, 24);
  PlanRow row;
  run_course(course, lie, [&](int step, const StepReport& r) { sample.judge(step, r, 1e-3, row); });
  CHECK(row.outside > 0);
  CHECK(row.error > 1e-3);
  // A wrong plan is not accepted from a file either.
  PlanOptions o = quick(0);
  o.given = lie;
  CHECK_THROWS_AS(make_plan(course, o), InputError);
}

TEST_CASE("the candidates for a looser error include those for a tighter one", "[plan]") {
  constexpr double least = 1e-13;
  CHECK(candidate_errors(1e-6, least) == std::vector{1e-6, 1e-9, 1e-12});
  CHECK(candidate_errors(5e-4, least) == std::vector{5e-4, 1e-6, 1e-9, 1e-12});
  CHECK(candidate_errors(1e-9, 1e-9) == std::vector{1e-9});
  for (const double tight : {1e-3, 1e-6, 1e-9, 1e-12})
    for (const double loose : {1e-3, 1e-2, 0.5, 1.0})
      if (tight < loose)
        for (const double error : candidate_errors(tight, least)) {
          const auto all = candidate_errors(loose, least);
          CHECK(std::find(all.begin(), all.end(), error) != all.end());
        }
  // The plan that is chosen may be one of a tighter error, and is judged by the error asked for.
  const Plan p = make_plan(course_of(heap(12)), quick(1e-2));
  CHECK(p.error == 1e-2);
  CHECK(p.run["error"].get<double>() <= 1e-2);
}

namespace {

// The pairs that a plan reports at the end of a course's last step, with their gaps if it states them.
std::map<BodyPair, std::optional<double>> reported_last(const Course& course, const Fidelity& f) {
  std::map<BodyPair, std::optional<double>> pairs;
  run_course(course, f, [&](int, const StepReport& r) {
    pairs.clear();
    for (const PairContact& c : r.contacts) pairs[{c.a, c.b}] = -c.contact.depth;
    for (const PairNear& n : r.near) pairs[{n.a, n.b}] = n.gap;
  });
  return pairs;
}

}  // namespace

TEST_CASE("plans about a margin report the pairs within it, and those for verdicts nothing else", "[plan]") {
  const Course course = course_of(heap(24));
  PlanOptions o = quick(1e-3);
  o.margin = 0.1;
  o.verdict_only = GENERATE(false, true);
  const Plan p = make_plan(course, o);
  CHECK(plan_row(p).outside == 0);
  CHECK(p.run.at("margin") == 0.1);
  const Fidelity f = fidelity_from_json(p.run, "run");
  CHECK(f.margin == 0.1);
  CHECK(f.verdict_only == o.verdict_only);
  const auto reported = reported_last(course, f);
  const EndPoses poses = end_poses(course);
  std::size_t near = 0;
  for (int b = 0; b < 25; ++b)
    for (int a = 0; a < b; ++a) {
      const auto placed = [&](int i) {
        return PlacedShape(&course.scene.shape_of(i), poses.back()[static_cast<std::size_t>(i)]);
      };
      const double gap = distance(placed(a), placed(b)).distance;
      const auto it = reported.find({a, b});
      INFO(a << " " << b << " " << gap);
      if (it == reported.end()) {
        CHECK(gap > 0.1 - 1e-3);
        continue;
      }
      CHECK(gap <= 0.1 + 1e-3);
      CHECK(it->second.has_value() != o.verdict_only);
      if (it->second && gap > 0) CHECK(std::abs(*it->second - gap) <= 1e-3);
      near += gap > 0;
    }
  CHECK(near >= 5);
  CHECK(reports::plan_text(p).find("Asked: which pairs are within") != std::string::npos);
}

TEST_CASE("the referee detects that pairs within the margin are left out", "[plan]") {
  const Course course = course_of(heap(24));
  const EndPoses poses = end_poses(course);
  constexpr double margin = 0.1;
  const PlanSample sample(course, poses, course_candidates(course, poses, margin), 1, 24, margin);
  PlanRow left_out, full;
  Fidelity f;
  f.error = 1e-3;
  run_course(course, f, [&](int step, const StepReport& r) { sample.judge(step, r, 1e-3, left_out); });
  CHECK(left_out.outside > 0);
  f.margin = margin;
  run_course(course, f, [&](int step, const StepReport& r) { sample.judge(step, r, 1e-3, full); });
  CHECK(full.outside == 0);
}

TEST_CASE("a plan that was edited by hand is refused", "[plan]") {
  const Course course = course_of(heap(4));
  PlanOptions o = quick(0);
  Fidelity& f = o.given.emplace();
  f.error = 0.2;
  f.simpler = {std::nullopt, simpler_shape(course.scene.shapes[1], Fidelity::shape_share * f.error)};
  REQUIRE(f.simpler[1]);
  const SimplerShape found = *f.simpler[1];
  CHECK_NOTHROW(make_plan(course, o));
  f.simpler[1]->error = 0;
  CHECK_THROWS_AS(make_plan(course, o), InputError);
  f.simpler[1] = found;
  f.simpler[1]->in_body.translation.x() += 0.01;
  CHECK_THROWS_AS(make_plan(course, o), InputError);
}

TEST_CASE("a plan refuses what it cannot prove or run", "[plan]") {
  Scene s = heap(4);
  CHECK_THROWS_AS(make_plan(course_of(s), quick(1e-18)), InputError);
  CHECK(default_error(course_of(s)) >= least_error(course_of(s)));
  const auto step = [](Step::Op op, int body) {
    Step x;
    x.op = op;
    x.body = body;
    return x;
  };
  for (int i = 0; i < 5; ++i) s.script.push_back(step(Step::Op::insert, i));
  s.script.push_back(step(Step::Op::query, -1));
  CHECK(course_of(s).steps.size() == 1);
  s.script.push_back(step(Step::Op::remove, 1));
  CHECK_THROWS_AS(course_of(s), InputError);

  Fidelity one;
  one.error = 1;
  const Json good = to_json(one);
  CHECK_NOTHROW(fidelity_from_json(good, "run"));
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, Json>>{
           {"error", -1},
           {"broad_phase", "none"},
           {"methods", {{"box-cube", {{"balls_first", true}, {"arithmetic", "float"}}}}},
           {"simpler", {{"of_shape", {0}}, {"error", {0.5}}}},
           {"margin", -0.5},
           {"verdict_only", 1},
           {"sweep_share", "half"}}) {
    Json bad = good;
    bad[key] = value;
    INFO(key);
    CHECK_THROWS_AS(fidelity_from_json(bad, "run"), InputError);
  }
}
