// The corpus: closed forms of gaps, right times of impact, and certificates.
#include <cmath>

#include "core/base/input_error.h"
#include "fuzz/corpus/corpus_case.h"
#include "fuzz/corpus/corpus_json.h"
#include "fuzz/corpus/truth.h"
#include "tests/support/catch.h"

using namespace touchstone;
namespace corpus = touchstone::fuzz::corpus;

namespace {

struct Bodies {
  Shape a, b;
  Pose pose_a, pose_b;
  Placed first() const { return {&a, pose_a}; }
  Placed second() const { return {&b, pose_b}; }
};

// With any bracket that holds it.
std::optional<corpus::ExactGap> exact(const Bodies& p) {
  return corpus::exact_gap(p.first(), p.second(), referee::judge_pair(p.first(), p.second()).gap);
}

Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat{}}; }

Scene in_motion(const Shape& a, const Shape& b, const Pose& pose_b, const Motion& m) {
  Scene s;
  s.shapes = {a, b};
  s.bodies.resize(2);
  s.bodies[1].shape = 1;
  s.bodies[1].pose = pose_b;
  s.bodies[1].motion = m;
  return s;
}

}  // namespace

TEST_CASE("closed forms of gaps", "[corpus]") {
  const Box cube{Vec3(1, 1, 1)};
  const auto apart = exact({cube, cube, {}, at(2.5, 0.25, 0)});
  REQUIRE(apart);
  CHECK(apart->value == "1/2");
  const auto deep = exact({cube, cube, {}, at(1.75, 0.25, 0)});
  REQUIRE(deep);
  CHECK(deep->value == "-1/4");
  const auto touching = exact({cube, cube, {}, at(2, 2, 2)});
  REQUIRE(touching);
  CHECK(touching->value == "0");
  const auto diagonal = exact({cube, cube, {}, at(3, 3, 0)});
  REQUIRE(diagonal);
  CHECK(diagonal->value.empty());
  CHECK(diagonal->sign == 1);
  CHECK(diagonal->square == "2");
  CHECK(diagonal->less == "0");
  const auto spheres = exact({Sphere{1}, Sphere{0.5}, {}, at(1, 1, 0)});
  REQUIRE(spheres);
  CHECK(spheres->square == "2");
  CHECK(spheres->less == "3/2");
  const auto centred = exact({Sphere{1}, Sphere{0.5}, {}, {}});
  REQUIRE(centred);
  CHECK(centred->value == "-3/2");
  const auto crossed = exact({Capsule{0.5, 1}, Capsule{0.25, 1}, {}, {Vec3::Zero(), Quat{1, 0, 0, 1}}});
  REQUIRE(crossed);
  CHECK(crossed->value == "-3/4");
  // Two octahedra, tip in tip: the way out is perpendicular to their common faces.
  const Hull tip = make_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  const auto tips = exact({tip, tip, {}, at(0, 0, 1.75)});
  REQUIRE(tips);
  CHECK(tips->sign == -1);
  CHECK(tips->square == "1/48");
  CHECK_FALSE(exact({Cylinder{1, 1}, cube, {}, at(3, 0, 0)}));
}

TEST_CASE("a closed form outside the referee's bracket is an error", "[corpus]") {
  const Bodies p{Box{Vec3(1, 1, 1)}, Box{Vec3(1, 1, 1)}, {}, at(2.5, 0, 0)};
  CHECK_THROWS_AS(corpus::exact_gap(p.first(), p.second(), {0.25, 0.375}), std::logic_error);
}

TEST_CASE("right times of a sphere that falls on a box", "[corpus]") {
  const Scene s = in_motion(Box{Vec3(1, 1, 1)}, Sphere{0.5}, at(0.25, 0, 2), {Vec3(0, 0, -1), Vec3::Zero()});
  const auto f = corpus::motion_facts(s);
  REQUIRE(f);
  CHECK(f->answer.truth.verdict == referee::TimeTruth::Verdict::hit);
  CHECK(std::abs(f->deepest - 0.5) < 1e-6);
  CHECK(f->right_times.size() == corpus::listed_exponents.size());
  for (const corpus::RightTimes& r : f->right_times) {
    INFO(r.exponent);
    REQUIRE(r.window);
    // It falls by tau in a time of tau.
    const double tau = std::ldexp(scale_of_pair(s, 0, 1), -r.exponent), off = tau * 1e-3 + 1e-15;
    CHECK(std::abs((*r.window)[0] - (0.5 - tau)) < off);
    CHECK(std::abs((*r.window)[1] - (0.5 + tau)) < off);
  }
}

TEST_CASE("a sphere that passes has right times only for wide tolerances", "[corpus]") {
  constexpr double gap = 0x1p-20;
  const Scene s = in_motion(Sphere{1}, Sphere{0.5}, at(-3, 1.5 + gap, 0), {Vec3(6, 0, 0), Vec3::Zero()});
  const auto f = corpus::motion_facts(s);
  REQUIRE(f);
  CHECK(f->answer.truth.verdict == referee::TimeTruth::Verdict::none);
  CHECK(f->deepest == 0);
  std::size_t windows = 0;
  for (const corpus::RightTimes& r : f->right_times) {
    INFO(r.exponent);
    CHECK(r.window.has_value() == (std::ldexp(scale_of_pair(s, 0, 1), -r.exponent) >= gap));
    windows += r.window.has_value();
    if (r.window) CHECK((*r.window)[0] < 0.5);
    if (r.window) CHECK((*r.window)[1] > 0.5);
  }
  CHECK(windows > 2);
  CHECK(windows < f->right_times.size());
}

TEST_CASE("certificates of a corpus are checked", "[corpus]") {
  corpus::Seed seed{"test/one", "", "lattice", "test", {}};
  seed.scene = in_motion(Box{Vec3(1, 1, 1)}, Sphere{0.5}, at(0.25, 0, 2), {});
  seed.scene.bodies[1].motion.reset();
  const auto made = corpus::with_truth(seed);
  REQUIRE(std::holds_alternative<corpus::CorpusCase>(made));
  const nlohmann::ordered_json j = corpus::to_json(std::get<corpus::CorpusCase>(made));
  corpus::StoredCorpusCase c{"test", "test/one", "lattice",     "unit", "test",
                             {},     seed.scene, j.at("truth"), {}};
  const auto checked = corpus::check_certificates(c);
  CHECK(checked.refused.empty());
  CHECK(checked.certificates == 3);
  CHECK(checked.complete);
  // A gap that is larger by more than rounding is not what the certificates prove.
  const double lo = c.truth["gap"][0];
  c.truth["gap"][0] = lo + 1e-9;
  CHECK(corpus::check_certificates(c).refused == "at_least: does not prove what the case says");
}

TEST_CASE("seeds come from a directory", "[corpus]") {
  CHECK_THROWS_AS(corpus::all_parts("/nonexistent"), InputError);
}
