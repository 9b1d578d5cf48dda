// Cases that differ only by symmetry, scale and precision have one canonical form.
#include "fuzz/shrink/canonical.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/math/rng.h"
#include "fuzz/shrink/reductions.h"
#include "scenarios/codec/case_codec.h"
#include "scenarios/random/family.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

Mat3 random_axes(Rng& rng) {
  std::array<Eigen::Index, 3> axis{0, 1, 2};
  for (std::size_t k = 2; k > 0; --k) std::swap(axis[k], axis[rng.below(k + 1)]);
  Mat3 m = Mat3::Zero();
  for (unsigned k = 0; k < 3; ++k) m(k, axis[k]) = rng.chance(0.5) ? 1 : -1;
  return m;
}

// Every case with few bits in its numbers, so that translations and turns of it are exact in float.
Case with_few_bits(Case c, int bits) {
  for (double* x : fuzz::numbers(c)) {
    double& v = *x;
    v = std::abs(v) < 0x1p-8 ? 0 : fuzz::rounded_to(v, bits);
  }
  for (Body& b : c.scene.bodies)
    if (b.pose.rotation == Quat{0, 0, 0, 0}) b.pose.rotation = {};
  fuzz::renew(c);
  return c;
}

// The world and every shape in other axes; only where cones, capsules and cylinders stay as they are.
Case in_other_axes(Case c, const Mat3& m) {
  const double det = m.determinant();
  for (Shape& s : c.scene.shapes) {
    if (auto* b = std::get_if<Box>(&s)) b->half_extents = (m * b->half_extents).cwiseAbs();
    if (auto* r = std::get_if<RoundedBox>(&s)) r->half_extents = (m * r->half_extents).cwiseAbs();
    if (auto* e = std::get_if<Ellipsoid>(&s)) e->semi_axes = (m * e->semi_axes).cwiseAbs();
    if (auto* h = std::get_if<HalfSpace>(&s)) h->normal = m * h->normal;
    if (auto* h = std::get_if<Hull>(&s)) {
      for (Vec3& v : h->vertices) v = m * v;
      std::reverse(h->vertices.begin(), h->vertices.end());
    }
    if (auto* t = std::get_if<TriangleMesh>(&s)) {
      for (Vec3& v : t->vertices) v = m * v;
      if (det < 0)
        for (auto& f : t->triangles) std::swap(f[1], f[2]);
    }
  }
  for (Body& b : c.scene.bodies) {
    b.pose.translation = m * b.pose.translation;
    const Quat q = b.pose.rotation;
    const Vec3 v = det * (m * Vec3(q.x, q.y, q.z));
    b.pose.rotation = {v.x(), v.y(), v.z(), q.w};
    if (b.motion) b.motion = Motion{m * b.motion->linear, det * (m * b.motion->angular)};
  }
  fuzz::renew(c);
  return c;
}

// The world alone, by a rotation that permutes the axes.
Case turned(Case c, const Quat& q) {
  const Mat3 m = rotation_matrix(q);
  for (Body& b : c.scene.bodies) {
    b.pose.translation = m * b.pose.translation;
    b.pose.rotation = q * b.pose.rotation;
    if (b.motion) b.motion = Motion{m * b.motion->linear, m * b.motion->angular};
  }
  return c;
}

Case exchanged(Case c) {
  std::swap(c.scene.bodies[0], c.scene.bodies[1]);
  std::reverse(c.scene.shapes.begin(), c.scene.shapes.end());
  const int last = static_cast<int>(c.scene.shapes.size()) - 1;
  for (Body& b : c.scene.bodies) b.shape = last - b.shape;
  return c;
}

Case renamed(Case c) {
  c.id = "another";
  c.family = "other";
  c.scene.name = "scene";
  for (Body& b : c.scene.bodies) b.name = "body";
  for (Body& b : c.scene.bodies)
    if (b.group >= 0) b.group += 7;
  return c;
}

Case moved(Case c, const Vec3& by) {
  for (Body& b : c.scene.bodies) b.pose.translation += by;
  return c;
}

Case scaled(Case c, double factor) {
  for (double* x : fuzz::lengths(c)) *x *= factor;
  fuzz::renew(c);
  return c;
}

Case in_float(Case c) {
  for (double* x : fuzz::numbers(c)) *x = fuzz::rounded_to(*x, 24);
  fuzz::renew(c);
  return c;
}

bool keeps_axis(const Case& c, const Mat3& m) {
  return std::all_of(c.scene.shapes.begin(), c.scene.shapes.end(), [&](const Shape& s) {
    if (std::holds_alternative<Cone>(s)) return m(2, 2) > 0;
    if (std::holds_alternative<Capsule>(s) || std::holds_alternative<Cylinder>(s)) return m(2, 2) != 0;
    return true;
  });
}

std::string text(const Case& c) { return case_to_json(c).dump(); }

const char* const pair_families[] = {"separate", "shallow", "deep", "contained", "spin"};

template <class F>
void for_each_pair(std::uint64_t cases, F&& f) {
  for (const char* family : pair_families)
    for (std::uint64_t i = 0; i < cases; ++i) {
      const Case c = with_few_bits(fuzz::make_case(3, i, family), 10);
      if (c.scene.bodies.size() == 2 && c.scene.script.empty()) f(c, i);
    }
}

}  // namespace

TEST_CASE("images of a pair have one canonical form", "[shrink][canonical]") {
  std::size_t pairs = 0, mirrored = 0;
  Rng rng(5);
  for_each_pair(40, [&](const Case& c, std::uint64_t i) {
    ++pairs;
    INFO(text(c));
    const Case form = fuzz::canonical(c);
    CHECK(fuzz::canonical(renamed(c)) == form);
    CHECK(fuzz::canonical(exchanged(c)) == form);
    CHECK(fuzz::canonical(moved(c, {3, -0.5, 1024})) == form);
    CHECK(fuzz::canonical(scaled(c, i % 2 == 0 ? 0x1p20 : 0x1p-7)) == form);
    CHECK(fuzz::canonical(turned(c, {1, 0, 0, 1})) == form);
    CHECK(fuzz::canonical(turned(c, {0.5, 0.5, -0.5, 0.5})) == form);
    const Mat3 axes = random_axes(rng);
    if (!keeps_axis(c, axes)) return;
    mirrored += axes.determinant() < 0;
    CHECK(fuzz::canonical(in_other_axes(c, axes)) == form);
    CHECK(fuzz::canonical(scaled(moved(exchanged(renamed(in_other_axes(c, axes))), {1, 2, 3}), 0.25)) ==
          form);
  });
  CHECK(pairs >= 150);
  CHECK(mirrored >= 20);
}

TEST_CASE("numbers rounded to float have the same canonical form", "[shrink][canonical]") {
  std::size_t pairs = 0;
  for (const char* family : pair_families)
    for (std::uint64_t i = 0; i < 40; ++i) {
      Case c = fuzz::make_case(4, i, family);
      if (c.scene.bodies.size() != 2 || !c.scene.script.empty()) continue;
      c = moved(c, -c.scene.bodies[0].pose.translation);
      ++pairs;
      INFO(text(c));
      CHECK(fuzz::canonical(in_float(c)) == fuzz::canonical(c));
    }
  CHECK(pairs >= 150);
}

TEST_CASE("different cases have different canonical forms", "[shrink][canonical]") {
  std::size_t different = 0;
  for_each_pair(20, [&](const Case& c, std::uint64_t) {
    const Case form = fuzz::canonical(c);
    INFO(text(c));
    const auto differs = [&](auto&& change) {
      Case other = c;
      change(other);
      CHECK_FALSE(fuzz::canonical(other) == form);
      ++different;
    };
    differs([](Case& x) { x.scene.bodies[0].is_static ^= true; });
    differs([](Case& x) { x.queries[0].question = Question::scene_contacts; });
    differs([](Case& x) { x.scene.ignored = {{0, 1}}; });
    differs([](Case& x) { x.scene.bodies[1].pose.translation += Vec3(0.375, 0.0625, 0.03125) * 1e3; });
    differs([](Case& x) {
      Body& b = x.scene.bodies[0];
      b.motion = Motion{Vec3(1, 2, 4) + (b.motion ? b.motion->linear : Vec3(Vec3::Zero())), Vec3(3, 5, 6)};
    });
    differs([](Case& x) {
      for (double* v : fuzz::numbers(x.scene.shapes[0])) *v = *v * 1.5 + 0.0625;
      fuzz::renew(x);
    });
  });
  CHECK(different >= 300);
}

TEST_CASE("a tilt of 1e-9 and a gap of one ulp of float are kept", "[shrink][canonical]") {
  Case c;
  c.scene.shapes = {Box{Vec3::Ones()}};
  c.scene.bodies.resize(2);
  c.scene.bodies[1].pose.translation.x() = 2;
  c.queries = {{Question::overlap, 0, 1}};
  const Case form = fuzz::canonical(c);
  CHECK(form.scene.bodies[0].pose == Pose{});
  CHECK(form.scene.bodies[1].pose == Pose{Vec3(1, 0, 0), {}});
  Case tilted = c;
  tilted.scene.bodies[1].pose.rotation.x = 1e-9;
  CHECK_FALSE(fuzz::canonical(tilted) == form);
  Case apart = c;
  apart.scene.bodies[1].pose.translation.x() = 2 + 0x1p-22;
  CHECK_FALSE(fuzz::canonical(apart) == form);
  apart.scene.bodies[1].pose.translation.x() = 2 + 0x1p-50;
  CHECK(fuzz::canonical(apart) == form);
}

TEST_CASE("scenes of many bodies, scripts and odd numbers only lose their names", "[shrink][canonical]") {
  Case c;
  c.scene.shapes = {Sphere{0.1}};
  c.scene.bodies.resize(6);
  c.queries = {{Question::candidates}};
  CHECK(fuzz::canonical(renamed(c)) == fuzz::canonical(c));
  CHECK(fuzz::canonical(c) == fuzz::canonical(in_float(c)));
  CHECK(fuzz::canonical(c).scene.bodies.size() == 6);
  Case script = fuzz::make_case(1, 0, "script");
  REQUIRE_FALSE(script.scene.script.empty());
  CHECK(fuzz::canonical(script).scene.script.size() == script.scene.script.size());
  c.scene.bodies.resize(2);
  c.scene.bodies[0].pose.translation.x() = std::numeric_limits<double>::infinity();
  CHECK(fuzz::canonical(renamed(c)) == fuzz::canonical(c));
  CHECK(fuzz::canonical(Case{}) == Case{});
}
