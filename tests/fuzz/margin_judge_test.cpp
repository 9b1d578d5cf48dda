// Hand-made answers about margins, bounds and rays against truths that can be computed mentally.
#include <cmath>
#include <limits>

#include "fuzz/judge/judge.h"
#include "fuzz/judge/truth.h"
#include "oracles/core/core_engine.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

// Two spheres of radius 1 with centres `distance` apart on the x axis.
Case spheres(double distance, double margin, Question q) {
  Case c;
  c.scene.shapes = {Sphere{1}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation.x() = distance;
  c.scene.margin = margin;
  c.queries = {{q, 0, 1}};
  return c;
}

Observation answered() {
  Observation o;
  o.outcome = Outcome::answered;
  return o;
}
Observation says_within(bool within) {
  Observation o = answered();
  o.overlap = within;
  return o;
}
Observation says_at_least(double bound) {
  Observation o = answered();
  o.lower_bound = bound;
  return o;
}

Judgement judge_one(const Case& c, const Observation& o, double tolerance = 0) {
  const EngineCard card{"test", "", "", "", 0x1p-53, 64, "a page"};
  Observation claimed = o;
  claimed.claimed_tolerance = tolerance;
  fuzz::Truth truth(c.scene);
  return fuzz::judge(c, card, {{}, {claimed}}, truth).at(0);
}

bool has(const Judgement& j, Fault f) {
  for (const auto& r : j.faults)
    if (r.fault == f) return true;
  return false;
}

// A ray from (x, 0, 0) along -x against the unit ball or another shape.
Case ray(const Shape& target, const Vec3& start, const Vec3& way) {
  Case c;
  c.scene.shapes = {target, Sphere{0}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose.translation = start;
  c.scene.bodies[1].motion = Motion{way, Vec3::Zero()};
  c.queries = {{Question::ray, 0, 1}};
  return c;
}

Observation hit(double t, const Vec3& normal) {
  Observation o = answered();
  o.toi = t;
  o.normal = normal;
  return o;
}

}  // namespace

TEST_CASE("within a margin: the boundary belongs to it, and either verdict within tolerance is right",
          "[judge][margin]") {
  for (const bool says : {true, false}) {
    CHECK(judge_one(spheres(2.5, 0.5, Question::within), says_within(says)).right());
    CHECK(judge_one(spheres(2.5, std::nextafter(0.5, 0), Question::within), says_within(says)).right());
  }
  CHECK(judge_one(spheres(2.5, 0.6, Question::within), says_within(true)).right());
  CHECK(judge_one(spheres(2.5, 0.4, Question::within), says_within(false)).right());
  CHECK(has(judge_one(spheres(2.5, 0.6, Question::within), says_within(false)), Fault::missed));
  CHECK(has(judge_one(spheres(2.5, 0.4, Question::within), says_within(true)), Fault::ghost));
  CHECK(judge_one(spheres(2.5, 0.4, Question::within), says_within(true), 0.11).right());
  CHECK(has(judge_one(spheres(2.5, 0.4, Question::within), says_within(true), 0.09), Fault::ghost));
}

TEST_CASE("within a margin: 0 is overlap, a negative one allows penetration", "[judge][margin]") {
  CHECK(has(judge_one(spheres(2.1, 0, Question::within), says_within(true)), Fault::ghost));
  CHECK(has(judge_one(spheres(1.9, 0, Question::within), says_within(false)), Fault::missed));
  CHECK(judge_one(spheres(1.9, -0.2, Question::within), says_within(false)).right());
  CHECK(has(judge_one(spheres(1.9, -0.2, Question::within), says_within(true)), Fault::ghost));
  CHECK(has(judge_one(spheres(1.5, -0.2, Question::within), says_within(false)), Fault::missed));
}

TEST_CASE("within a margin: an answer needs a verdict, and the error is the distance to the margin",
          "[judge][margin]") {
  CHECK(has(judge_one(spheres(2.5, 0.4, Question::within), answered()), Fault::no_number));
  const Judgement j = judge_one(spheres(2.5, 0.4, Question::within), says_within(true));
  REQUIRE(j.faults.size() == 1);
  CHECK(std::abs(j.faults[0].error - 0.1) < 1e-12);
}

TEST_CASE("a contact within a margin has minus the distance as its depth", "[judge][margin]") {
  const auto judged = [](double distance, double margin, double depth, const Vec3& normal, const Vec3& point,
                         double depth_of_point) {
    Observation o = says_within(true);
    o.normal = normal;
    o.depth = depth;
    o.manifold = {{point, depth_of_point}};
    return judge_one(spheres(distance, margin, Question::contact_within), o);
  };
  const Vec3 x(1, 0, 0);
  CHECK(judged(2.5, 0.75, -0.5, x, {1.25, 0, 0}, -0.5).right());
  CHECK(judged(2.5, 0.75, -0.5, x, {1, 0, 0}, -0.5).right());
  CHECK(judged(2.5, 0.75, -0.5, x, {1.5, 0, 0}, std::nan("")).right());
  CHECK(has(judged(2.5, 0.4, -0.5, x, {1.25, 0, 0}, -0.5), Fault::ghost));
  CHECK(has(judged(2.5, 0.75, 0, x, {1.25, 0, 0}, -0.5), Fault::depth_excess));
  CHECK(has(judged(2.5, 0.75, -0.6, x, {1.25, 0, 0}, -0.6), Fault::infeasible));
  CHECK(has(judged(2.5, 0.75, -0.5, -x, {1.25, 0, 0}, -0.5), Fault::not_minimal));
  CHECK(has(judged(2.5, 0.75, -0.5, {0.8, 0.6, 0}, {1.25, 0, 0}, -0.5), Fault::not_minimal));
  CHECK(has(judged(2.5, 0.75, -0.5, x, {1.25, 0, 0}, -0.4), Fault::point_depth));
  CHECK(has(judged(2.5, 0.75, -0.5, x, {2.25, 0, 0}, -0.5), Fault::point_off));
  CHECK(has(judged(2.5, 0.75, -0.5, x, {1.25, 1, 0}, -0.5), Fault::point_off));
  // Of bodies that overlap, a contact like any other; a negative margin allows some depth.
  CHECK(judged(1.5, 0.25, 0.5, x, {0.75, 0, 0}, 0.5).right());
  CHECK(judged(1.5, -0.25, 0.5, x, {0.75, 0, 0}, 0.5).right());
  CHECK(has(judged(1.5, -0.75, 0.5, x, {0.75, 0, 0}, 0.5), Fault::ghost));
  CHECK(has(judged(1.5, 0.25, -0.5, x, {0.75, 0, 0}, 0.5), Fault::infeasible));
  CHECK(judge_one(spheres(2.5, 0.25, Question::contact_within), says_within(false)).right());
  CHECK(has(judge_one(spheres(2.5, 0.75, Question::contact_within), says_within(false)), Fault::missed));
}

TEST_CASE("a surface that is apart has a depth, and a normal that is not judged", "[judge][margin]") {
  Case c = spheres(0, 0.5, Question::contact_within);
  TriangleMesh m;
  m.vertices = {{-4, -4, 0}, {4, -4, 0}, {0, 8, 0}};
  m.triangles = {{0, 1, 2}};
  c.scene.shapes.push_back(m);
  c.scene.bodies[0].shape = 1;
  c.scene.bodies[1].pose.translation = {0, 0, 1.25};
  Observation o = says_within(true);
  o.depth = -0.25;
  CHECK(judge_one(c, o).right());
  o.depth = -0.3;
  CHECK(has(judge_one(c, o), Fault::infeasible));
  o.depth = -0.25;
  o.normal = Vec3(0, 0, 1);
  CHECK(judge_one(c, o).ruling() == Ruling::not_judged);
}

TEST_CASE("a mesh has no depth to compare with a negative margin", "[judge][margin]") {
  Case c = spheres(0, -0.1, Question::within);
  TriangleMesh m;
  m.vertices = {{-4, -4, 0}, {4, -4, 0}, {0, 8, 0}};
  m.triangles = {{0, 1, 2}};
  c.scene.shapes.push_back(m);
  c.scene.bodies[0].shape = 1;
  CHECK(judge_one(c, says_within(true)).ruling() == Ruling::not_judged);
  c.scene.margin = 0.1;
  CHECK(judge_one(c, says_within(true)).right());
  CHECK(has(judge_one(c, says_within(false)), Fault::missed));
}

TEST_CASE("a bound is judged as the bound that it claims to be", "[judge][bounds]") {
  const Case c = spheres(2.5, 0, Question::distance);
  CHECK(judge_one(c, says_at_least(0.5)).right());
  CHECK(judge_one(c, says_at_least(0.1)).right());
  CHECK(has(judge_one(c, says_at_least(0.5 + 1e-9)), Fault::bound_off));
  Observation o = answered();
  o.upper_bound = 0.6;
  CHECK(judge_one(c, o).right());
  o.upper_bound = 0.4;
  CHECK(has(judge_one(c, o), Fault::bound_off));
  o.upper_bound = 0.6;
  o.lower_bound = 0.4;
  CHECK(judge_one(c, o).right());
  o.lower_bound = std::nan("");
  CHECK(has(judge_one(c, o), Fault::no_number));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(judge_one(c, says_at_least(-infinity)).right());
  CHECK(has(judge_one(c, says_at_least(infinity)), Fault::no_number));
  CHECK(has(judge_one(spheres(1.5, 0, Question::distance), says_at_least(-0.4)), Fault::bound_off));
  CHECK(judge_one(spheres(1.5, 0, Question::distance), says_at_least(-0.6)).right());
}

TEST_CASE("the slack of a lower bound is measured and no fault", "[judge][bounds]") {
  const Judgement j = judge_one(spheres(2.5, 0, Question::distance), says_at_least(0));
  CHECK(j.right());
  REQUIRE(j.bound_slack_in_l);
  CHECK(std::abs(*j.bound_slack_in_l - 0.5 / 2.5) < 1e-12);
}

TEST_CASE("a distance up to a limit: the number, or a bound that reaches the limit", "[judge][bounds]") {
  const Case c = spheres(2.5, 0.2, Question::bounded_distance);
  Observation number = answered();
  number.distance = 0.5;
  CHECK(judge_one(c, number).right());
  number.distance = 0.2;
  CHECK(has(judge_one(c, number), Fault::distance_off));
  CHECK(judge_one(c, says_at_least(0.3)).right());
  CHECK(judge_one(c, says_at_least(0.2)).right());
  CHECK(has(judge_one(c, says_at_least(0.1)), Fault::no_number));
  CHECK(has(judge_one(c, says_at_least(0.6)), Fault::bound_off));
  CHECK(has(judge_one(c, answered()), Fault::no_number));
  // Nearer than the limit, a bound that reaches the limit is none.
  CHECK(has(judge_one(spheres(2.1, 0.2, Question::bounded_distance), says_at_least(0.2)), Fault::bound_off));
}

TEST_CASE("candidates within a margin: every pair, with no tolerance", "[judge][margin]") {
  Case c = spheres(2.5, 0.5, Question::candidates_within);
  c.queries = {{Question::candidates_within, -1, -1}};
  const auto with = [](std::vector<BodyPair> pairs) {
    Observation o = answered();
    o.candidate_pairs = {std::move(pairs)};
    return o;
  };
  CHECK(judge_one(c, with({{0, 1}})).right());
  CHECK(has(judge_one(c, with({})), Fault::missed));
  c.scene.margin = std::nextafter(0.5, 0);
  CHECK(judge_one(c, with({})).right());
  CHECK(judge_one(c, with({{0, 1}})).right());
  CHECK(has(judge_one(c, with({{0, 7}})), Fault::stale));
}

TEST_CASE("a ray is judged by the gap where it is said to hit, and by the normal there", "[judge][ray]") {
  const Case c = ray(Sphere{1}, {3, 0, 0}, {-4, 0, 0});
  CHECK(judge_one(c, hit(0.5, {1, 0, 0})).right());
  CHECK(has(judge_one(c, hit(0.25, {1, 0, 0})), Fault::early));
  CHECK(has(judge_one(c, hit(0.6, {1, 0, 0})), Fault::late));
  CHECK(has(judge_one(c, answered()), Fault::missed));
  CHECK(has(judge_one(c, hit(0.5, {-1, 0, 0})), Fault::not_minimal));
  CHECK(has(judge_one(c, hit(0.5, {0.8, 0.6, 0})), Fault::not_minimal));
  CHECK(has(judge_one(c, hit(0.5, {2, 0, 0})), Fault::normal_not_unit));
  const Case past = ray(Sphere{1}, {3, 1.1, 0}, {-4, 0, 0});
  CHECK(judge_one(past, answered()).right());
  CHECK(!judge_one(past, hit(0.5, {1, 0, 0})).right());
}

TEST_CASE("at an edge every normal of the edge is right", "[judge][ray]") {
  const Case c = ray(Box{{1, 1, 1}}, {2, 2, 0}, {-2, -2, 0});
  const double h = std::sqrt(0.5);
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(h, h, 0)})
    CHECK(judge_one(c, hit(0.5, n)).right());
  CHECK(has(judge_one(c, hit(0.5, {0, 0, 1})), Fault::not_minimal));
}

TEST_CASE("a ray that starts inside: the start or the flag is judged, what else it meets is not",
          "[judge][ray]") {
  const Case c = ray(Sphere{1}, {0.5, 0, 0}, {4, 0, 0});
  CHECK(judge_one(c, hit(0, {1, 0, 0})).right());
  CHECK(judge_one(c, answered()).ruling() == Ruling::not_judged);
  CHECK(judge_one(c, hit(0.125, {1, 0, 0})).ruling() == Ruling::not_judged);
  CHECK(judge_one(c, says_within(true)).right());
  CHECK(has(judge_one(c, says_within(false)), Fault::missed));
  CHECK(has(judge_one(ray(Sphere{1}, {3, 0, 0}, {-4, 0, 0}), says_within(true)), Fault::ghost));
}

TEST_CASE("what is no longer a ray is not asked", "[judge][ray]") {
  Case c = ray(Sphere{1}, {3, 0, 0}, {-4, 0, 0});
  c.scene.shapes[1] = Sphere{0.5};
  CHECK(judge_one(c, hit(0.5, {1, 0, 0})).ruling() == Ruling::unsupported);
}

TEST_CASE("the core is right about margins, bounds and rays", "[judge][margin][ray]") {
  const auto engine = make_core_engine();
  const auto kept = make_kept_engine();
  std::size_t answers = 0;
  for (const char* family : {"margins", "loose", "rays"})
    for (std::uint64_t i = 0; i < 600; ++i) {
      const Case c = fuzz::make_case(5, i, family);
      fuzz::Truth truth(c.scene);
      for (Engine* e : {engine.get(), static_cast<Engine*>(kept.get())}) {
        const auto judged = fuzz::judge(c, e->card(), e->run({&c, 1}).at(0), truth);
        for (std::size_t q = 0; q < judged.size(); ++q) {
          INFO(c.id << " " << e->card().name << " " << to_string(c.queries[q].question)
                    << (judged[q].faults.empty() ? "" : ": " + judged[q].faults[0].words));
          CHECK(judged[q].faults.empty());
          answers += judged[q].ruling() == Ruling::right;
        }
      }
    }
  CHECK(answers > 4000);
}
