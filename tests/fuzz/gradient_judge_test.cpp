// Hand-made gradients against those that can be computed mentally, and the core's in random cases.
#include <cmath>
#include <limits>

#include "core/math/rng.h"
#include "fuzz/judge/judge.h"
#include "fuzz/judge/truth.h"
#include "oracles/core/core_engine.h"
#include "oracles/referee/region/gradient_set.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Case pair_of(const Shape& a, const Shape& b, const Vec3& at, const Quat& turned = {}) {
  Case c;
  c.scene.shapes = {a, b};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].shape = 1;
  c.scene.bodies[1].pose = {at, turned};
  c.queries = {{Question::distance, 0, 1}};
  return c;
}

Observation states(double distance, const Vec3& normal, const Vec3& moment) {
  Observation o;
  o.outcome = Outcome::answered;
  o.distance = distance;
  o.normal = normal;
  o.moment = moment;
  return o;
}

Judgement judge_one(const Case& c, const Observation& o) {
  const EngineCard card{"test", "", "", "", 0x1p-53, 64, "a page"};
  fuzz::Truth truth(c.scene);
  return fuzz::judge(c, card, {{}, {o}}, truth).at(0);
}

bool has(const Judgement& j, Fault f) {
  for (const auto& r : j.faults)
    if (r.fault == f) return true;
  return false;
}

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("the gradient at a face is that of any point that the faces share, and of no other",
          "[judge][gradient]") {
  for (const double height : {1.75, 1.4}) {
    const double d = height - 1.5;
    const Case c = pair_of(Box{{5, 5, 1}}, Box{{1, 2, 0.5}}, {0.5, 0, height});
    const auto at = [&](double x, double y) {  // the moment of a point relative to B's centre
      return judge_one(c, states(d, {0, 0, 1}, Vec3(x, y, 0).cross(Vec3(0, 0, 1))));
    };
    CHECK(at(0, 0).right());
    CHECK(at(1, 2).right());
    CHECK(at(-1, 1.25).right());
    CHECK(has(at(1.001, 0), Fault::gradient_off));
    CHECK(has(at(0, -2.001), Fault::gradient_off));
    const auto gives = [&](const Vec3& n, const Vec3& m) { return judge_one(c, states(d, n, m)); };
    CHECK(has(gives({0, 0, -1}, {0, 0, 0}), Fault::gradient_off));
    CHECK(has(gives({0, 0, 1}, {0, 0, 0.1}), Fault::gradient_off));
    CHECK(has(gives({0, 0, 0.5}, {0, 0, 0}), Fault::gradient_off));
    CHECK(has(gives({0, 1e-6, 1}, {0, 0, 0}), Fault::gradient_off));
    CHECK(has(gives({0, 0, 1}, {0, nan_value, 0}), Fault::no_number));
  }
}

TEST_CASE("a moment is about the origin of B's frame, along world axes", "[judge][gradient]") {
  const double s = std::sqrt(0.5);
  // A capsule along x, above a ball: nearest at 0.75 from its centre.
  const Case c = pair_of(Sphere{1}, Capsule{0.25, 1}, {0.75, 0, 2}, {0, s, 0, s});
  const auto gives = [&](const Vec3& m) { return judge_one(c, states(0.75, {0, 0, 1}, m)); };
  CHECK(gives(Vec3(-0.75, 0, 0).cross(Vec3(0, 0, 1))).right());
  CHECK(has(gives(-Vec3(-0.75, 0, 0).cross(Vec3(0, 0, 1))), Fault::gradient_off));  // opposite
  CHECK(has(gives(Vec3::Zero()), Fault::gradient_off));   // about the world's origin
  CHECK(has(gives({-0.75, 0, 0}), Fault::gradient_off));  // in another frame
}

TEST_CASE("a claim that the gradient is unique is judged where the truth is clear", "[judge][gradient]") {
  const auto claims = [](const Case& c, double d, bool unique) {
    Observation o = states(d, {0, 0, 1}, Vec3::Zero());
    o.unique_gradient = unique;
    return judge_one(c, o);
  };
  const Case face = pair_of(Box{{5, 5, 1}}, Box{{1, 2, 0.5}}, {0.5, 0, 2});
  CHECK(claims(face, 0.5, false).right());
  CHECK(has(claims(face, 0.5, true), Fault::gradient_off));
  const Case ball = pair_of(Box{{5, 5, 1}}, Sphere{0.5}, {0.5, 0, 2});
  CHECK(claims(ball, 0.5, true).right());
  CHECK(has(claims(ball, 0.5, false), Fault::gradient_off));
  const Case capsules = pair_of(HalfSpace{{0, 0, 1}, 0}, Capsule{0.5, 1}, {0, 0, 1}, {1, 0, 0, 1});
  CHECK(claims(capsules, 0.5, false).right());
  CHECK(has(claims(capsules, 0.5, true), Fault::gradient_off));
  // Of what has a rim, be it a segment, neither is wrong: only nearest points of polytopes are known to be
  // many.
  const Case needle = pair_of(Box{{5, 5, 1}}, Padded<Cylinder>{{0, 1}, 0.5}, {0, 0, 2}, {1, 0, 0, 1});
  for (const bool unique : {true, false}) CHECK(claims(needle, 0.5, unique).right());
}

TEST_CASE("the gradient at a surface is judged by the nearest points", "[judge][gradient]") {
  TriangleMesh m;
  m.vertices = {{-2, -2, 0}, {2, -2, 0}, {0, 3, 0}};
  m.triangles = {{0, 1, 2}};
  const Case c = pair_of(m, Sphere{0.5}, {0, 0, 1});
  Observation o = states(0.5, {0, 0, 1}, Vec3::Zero());
  CHECK(judge_one(c, o).ruling() == Ruling::not_judged);
  o.witness = {Vec3(0, 0, 0), Vec3(0, 0, 0.5)};
  CHECK(judge_one(c, o).right());
  o.moment = Vec3(0.1, 0, 0);
  CHECK(has(judge_one(c, o), Fault::gradient_off));
  o.moment = Vec3::Zero();
  o.normal = Vec3(0, 0, -1);
  CHECK(has(judge_one(c, o), Fault::gradient_off));
  // A surface that overlaps has no depth.
  Observation inside = states(0, {0, 0, 1}, Vec3::Zero());
  const Judgement j = judge_one(pair_of(m, Sphere{0.5}, {0, 0, 0.25}), inside);
  CHECK(j.ruling() == Ruling::not_judged);
  CHECK(j.unjudged_by_definition());
}

TEST_CASE("the referee's gradients are those of each normal and each corner", "[referee][gradient]") {
  const Case c = pair_of(Box{{1, 1, 1}}, Box{{1, 1, 1}}, {0, 0, 0});
  const auto placed = [&](std::size_t i) { return Placed{&c.scene.shapes[i], c.scene.bodies[i].pose}; };
  const auto normals = referee::near_minimal_normals(placed(0), placed(1));
  REQUIRE(normals.normals.size() == 6);
  const auto all = referee::gradient_set(placed(0), placed(1), normals.normals, true, 2);
  CHECK(all.corners.size() == 24);
  CHECK_FALSE(all.unique);
  for (const auto& g : all.corners) CHECK(std::abs(g.moment.dot(g.normal)) < 1e-12);
  const Case ball = pair_of(Box{{1, 1, 1}}, Sphere{1}, {0, 0.5, 3});
  const Placed a{&ball.scene.shapes[0], ball.scene.bodies[0].pose},
      b{&ball.scene.shapes[1], ball.scene.bodies[1].pose};
  const std::array up{Vec3(0, 0, 1)};
  const auto one = referee::gradient_set(a, b, up, true, 3);
  REQUIRE(one.corners.size() == 1);
  CHECK(one.unique);
  CHECK(one.corners[0].moment.norm() < 1e-12);
}

TEST_CASE("to each side, the signed distance changes by the largest over normals of the least over corners",
          "[referee][gradient]") {
  // A cube in a cube has six normals of four corners each; a tilted one has one corner of one normal.
  for (const Quat& turned : {Quat{}, Quat{0.1, 0.2, 0.05, 1}}) {
    const Case c = pair_of(Box{{1, 1, 1}}, Box{{0.5, 0.75, 1}}, {0, 0, 0}, turned);
    const Placed a{&c.scene.shapes[0], c.scene.bodies[0].pose}, b{&c.scene.shapes[1], c.scene.bodies[1].pose};
    const auto found = referee::near_minimal_normals(a, b);
    std::vector<Vec3> best;
    for (std::size_t i = 0; i < found.normals.size(); ++i)
      if (found.widths[i] < found.depth + 1e-12) best.push_back(found.normals[i]);
    const auto set = referee::gradient_set(a, b, best, true, 2);
    Rng rng(9);
    for (int i = 0; i < 30; ++i) {
      const Vec3 v = rng.unit_vector(), w = rng.unit_vector();
      double most = -HUGE_VAL;
      for (const Vec3& n : best) {
        double least = HUGE_VAL;
        for (const auto& g : set.corners)
          if (g.normal == n) least = std::min(least, g.normal.dot(v) + g.moment.dot(w));
        most = std::max(most, least);
      }
      constexpr double h = 1e-7;
      const Vec3 half = w * std::sin(h / 2);
      const Pose moved{h * v, Quat{half.x(), half.y(), half.z(), std::cos(h / 2)} * turned};
      const double before = referee::judge_pair(a, b).gap.lo,
                   after = referee::judge_pair(a, {&c.scene.shapes[1], moved}).gap.lo;
      INFO("direction " << i << ", turned by " << turned.x);
      CHECK(std::abs((after - before) / h - most) < 1e-5);
    }
  }
}

namespace {

struct Count {
  int stated = 0, claims = 0;
};
void judge_core(Engine& engine, const Case& c, Count& n) {
  const auto observed = engine.run({&c, 1});
  fuzz::Truth truth(c.scene);
  const auto judged = fuzz::judge(c, engine.card(), observed[0], truth);
  for (std::size_t k = 0; k < judged.size(); ++k) {
    INFO(engine.card().name << " " << c.id << " query " << k);
    for (const FaultReport& f : judged[k].faults) UNSCOPED_INFO(f.words);
    CHECK_FALSE(has(judged[k], Fault::gradient_off));
    n.stated += observed[0].answers[k].moment.has_value();
    n.claims += observed[0].answers[k].unique_gradient.has_value();
  }
}

}  // namespace

TEST_CASE("the core's gradients are right in random cases", "[judge][gradient][random]") {
  constexpr const char* families[] = {"separate", "near",     "shallow",  "deep",  "contained",
                                      "lattice",  "far",      "parallel", "zero",  "unequal",
                                      "mesh",     "surfaces", "later",    "padded"};
  // Several normals of one depth, of which normal and points show different ones; features of 1e-9 of the
  // size.
  constexpr std::uint64_t found_in_long_runs[] = {2734,   3753,   7429,   8078,  8601,
                                                  15'001, 15'525, 15'887, 18'748};
  constexpr const char* mix =
      "separate,near,shallow,deep,contained,lattice,far,parallel,tiny,zero,unequal,later,mesh,surfaces";
  Count n;
  for (const EnginePtr& engine : {make_core_engine(), EnginePtr(make_kept_engine())}) {
    for (const char* family : families)
      for (std::uint64_t i = 0; i < 40; ++i) judge_core(*engine, fuzz::make_case(23, i, family), n);
    for (const std::uint64_t i : found_in_long_runs) judge_core(*engine, fuzz::make_case(77, i, mix), n);
  }
  CHECK(n.stated > 500);
  CHECK(n.claims > 100);
}
