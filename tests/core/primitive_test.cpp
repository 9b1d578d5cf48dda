// Deforming primitives: closed forms, degenerate and extreme input, the recorded queries, and random ones
// against the referee's decision. The core shares no code with the referee.
#include <cstdlib>
#include <filesystem>

#include "core/impact/primitive_impact.h"
#include "core/narrow/narrow_phase.h"
#include "oracles/referee/referee.h"
#include "scenarios/import/ccd_queries.h"
#include "scenarios/random/primitive_motions.h"
#include "tests/support/catch.h"
#include "tests/support/shared_data.h"
#include "tests/support/skip.h"

using namespace touchstone;
using namespace touchstone::primitives;
using namespace touchstone::test;

namespace {

constexpr auto vf = PrimitiveKind::vertex_face, ee = PrimitiveKind::edge_edge;

referee::PrimitiveTruth truth_of(PrimitiveKind kind, const Quad& a, const Quad& b) {
  return referee::judge_primitive_motion(
      kind == vf ? referee::PrimitivePair::vertex_face : referee::PrimitivePair::edge_edge, a, b);
}

// By the narrow phase, on hulls of one, two or three points.
double gap(PrimitiveKind kind, const Quad& q) {
  const bool face = kind == vf;
  const Shape a = face ? make_hull({q[0]}) : make_hull({q[0], q[1]}),
              b = face ? make_hull({q[1], q[2], q[3]}) : make_hull({q[2], q[3]});
  return std::max(0.0, distance(PlacedShape{&a, {}}, PlacedShape{&b, {}}).distance);
}

double size_of(const Quad& a, const Quad& b) {
  double size = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (const Quad* q : {&a, &b}) size = std::max(size, ((*q)[i] - a[0]).cwiseAbs().maxCoeff());
  return size;
}

// Bound on the rounding error of the test's own positions in double.
double rounding_of(const Quad& a, const Quad& b) {
  double most = 0;
  for (std::size_t i = 0; i < 4; ++i) most = std::max({most, a[i].norm(), b[i].norm()});
  return 8 * 0x1p-53 * most;
}

}  // namespace

TEST_CASE("primitives: a vertex that crosses a face does so at the time of its plane", "[primitive]") {
  const Quad start{Vec3(0.25, 0.25, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  Quad end = start;
  end[0].z() = -3;
  const PrimitiveImpact r = primitive_impact(vf, start, end);
  REQUIRE(r.toi);
  CHECK(*r.toi <= 0.25);
  CHECK(*r.toi == Approx(0.25).epsilon(1e-13));
  CHECK(r.exit == PrimitiveExit::crossing);
  // One ulp short of the plane, and exactly at it when the step ends.
  end[0].z() = 0x1p-1074;
  CHECK_FALSE(primitive_impact(vf, start, end).toi);
  end[0].z() = 0;
  CHECK(primitive_impact(vf, start, end).toi.value() == Approx(1).epsilon(1e-14));
  // Through a corner, and past it by one ulp.
  Quad above = start;
  above[0] = {0, 0, 1};
  end[0] = {0, 0, -1};
  CHECK(primitive_impact(vf, above, end).toi.value() == Approx(0.5).epsilon(1e-14));
  above[0].x() = end[0].x() = -0x1p-1074;
  CHECK_FALSE(primitive_impact(vf, above, end).toi);
}

TEST_CASE("primitives: motions within one plane and degenerate primitives are decided", "[primitive]") {
  const Quad start{Vec3(-1, 0.25, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  Quad end = start;
  end[0].x() = 3;
  CHECK(primitive_impact(vf, start, end).toi.value() == Approx(0.25).epsilon(1e-13));
  const Quad line{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(3, 3, 3), Vec3(5, 5, 5)};
  Quad closer = line;
  closer[2] = {-1, -1, -1};
  closer[3] = {1, 1, 1};
  CHECK(primitive_impact(ee, line, closer).toi.value() == Approx(0.5).epsilon(1e-14));
  const Quad spot{Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  Quad through = spot;
  through[0].z() = -3;
  CHECK(primitive_impact(vf, spot, through).toi.value() == Approx(0.25).epsilon(1e-13));
  through[0].x() = 0x1p-60;
  CHECK_FALSE(primitive_impact(vf, spot, through).toi);
  // At rest: touching, and apart.
  CHECK(primitive_impact(vf, spot, spot).toi.has_value() == false);
  const Quad touching{Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  CHECK(primitive_impact(vf, touching, touching).toi.value() == 0);
}

TEST_CASE("primitives: a graze at the top of a curve is contact exactly when it touches", "[primitive]") {
  // The vertex moves along x and the face's plane rotates about y. The height above the plane is -2 (t -
  // 1/2)^2, which has a double root.
  Quad a{Vec3(-1, 0, 1), Vec3(-4, -4, 3), Vec3(4, -4, -1), Vec3(0, 8, 1)}, b = a;
  b[0].x() = 1;
  b[1].z() = -1;
  b[2].z() = 3;
  const auto truth = truth_of(vf, a, b);
  CHECK(truth.collides);
  CHECK(truth.t_lo <= 0.5);
  CHECK(truth.t_hi >= 0.5);
  CHECK(primitive_impact(vf, a, b).toi.has_value());
  // Above the graze the vertex crosses the plane twice, below it never.
  int hits = 0;
  for (int i = -40; i <= 40; ++i) {
    Quad c = a, d = b;
    c[0].z() += std::ldexp(i, -52);
    d[0].z() += std::ldexp(i, -52);
    const auto t = truth_of(vf, c, d);
    hits += t.collides;
    CAPTURE(i);
    REQUIRE(t.collides == (i >= 0));
    REQUIRE(primitive_impact(vf, c, d).toi.has_value() == t.collides);
  }
  CHECK(hits == 41);
}

TEST_CASE("primitives: the recorded queries have no false verdict and no late time", "[primitive][data]") {
  const auto root = shared_data() / "ccd";
  if (!std::filesystem::exists(root / "truth.csv")) return skip(root.string() + " is absent");
  long false_negatives = 0, false_positives = 0, late = 0, hits = 0, total = 0, by_tolerance = 0;
  double earliest = 0;
  for (const CcdQuery& q : load_ccd_set(root)) {
    const PrimitiveKind kind = q.is_vertex_face ? vf : ee;
    const PrimitiveImpact r = primitive_impact(kind, q.start, q.end);
    REQUIRE(r.outcome == Outcome::answered);
    ++total;
    hits += q.truth->collides;
    false_negatives += q.truth->collides && !r.toi;
    false_positives += !q.truth->collides && r.toi;
    const PrimitiveImpact loose = primitive_impact(kind, q.start, q.end, {.tolerance = 1e-6});
    false_negatives += q.truth->collides && !loose.toi;
    by_tolerance += !q.truth->collides && loose.toi;
    if (!q.truth->collides || !r.toi) continue;
    late += *r.toi > q.truth->toi_hi || loose.toi.value() > q.truth->toi_hi;
    earliest = std::max(earliest, (gap(kind, at(q.start, q.end, *r.toi)) - rounding_of(q.start, q.end)) /
                                      size_of(q.start, q.end));
    REQUIRE(gap(kind, at(q.start, q.end, *loose.toi)) <= 1e-6 + 1e-12 * size_of(q.start, q.end));
  }
  CAPTURE(total, hits, by_tolerance, earliest);
  CHECK(false_negatives == 0);
  CHECK(false_positives == 0);
  CHECK(late == 0);
  CHECK(earliest <= 1e-12);
  CHECK(static_cast<double>(by_tolerance) < 0.035 * static_cast<double>(total));
  REQUIRE(total > 7000);
  REQUIRE(hits > 1000);
}

TEST_CASE("primitives: random queries are decided as the referee decides them", "[primitive][random]") {
  const char* asked = std::getenv("TOUCHSTONE_CASES");
  const std::uint64_t n = asked ? std::strtoull(asked, nullptr, 10) : 1050;
  long hits = 0, cases = 0;
  std::array<long, 6> exits{};
  for (std::uint64_t i = 0; i < n; ++i) {
    Rng r = Rng::stream(901, i);
    const PrimitiveMotion m = random_motion(r, i);
    for (const PrimitiveKind kind : {vf, ee}) {
      const auto truth = truth_of(kind, m.a, m.b);
      const PrimitiveImpact x = primitive_impact(kind, m.a, m.b);
      CAPTURE(i, kind == vf, static_cast<int>(x.exit));
      ++cases;
      hits += truth.collides;
      ++exits[static_cast<std::size_t>(x.exit)];
      REQUIRE(x.outcome == Outcome::answered);
      REQUIRE(x.toi.has_value() == truth.collides);
      if (!x.toi) continue;
      REQUIRE(*x.toi <= truth.t_hi);
      if (i % 7 != 5)
        REQUIRE(gap(kind, at(m.a, m.b, *x.toi)) <= 1e-12 * size_of(m.a, m.b) + rounding_of(m.a, m.b));
    }
  }
  CAPTURE(cases, hits);
  CHECK(hits > cases / 10);
  CHECK(hits < cases * 9 / 10);
  CHECK(exits[static_cast<std::size_t>(PrimitiveExit::box)] > 0);
  CHECK(exits[static_cast<std::size_t>(PrimitiveExit::direction)] > 0);
  CHECK(exits[static_cast<std::size_t>(PrimitiveExit::crossing)] > 0);
  CHECK(exits[static_cast<std::size_t>(PrimitiveExit::exact)] > 0);
}

TEST_CASE("primitives: the verdict depends neither on order nor on the direction of time", "[primitive]") {
  Rng r(17);
  const auto turned = [](const Quad& q, std::array<std::size_t, 4> p) {
    return Quad{q[p[0]], q[p[1]], q[p[2]], q[p[3]]};
  };
  int hits = 0;
  constexpr int n = 2000;
  for (int i = 0; i < n; ++i) {
    const Quad a = lattice_quad(r, 4), b = lattice_quad(r, 4);
    const bool f = primitive_impact(vf, a, b).toi.has_value(), e = primitive_impact(ee, a, b).toi.has_value();
    hits += f + e;
    for (const auto& p : {std::array<std::size_t, 4>{0, 2, 3, 1}, {0, 3, 2, 1}})
      REQUIRE(primitive_impact(vf, turned(a, p), turned(b, p)).toi.has_value() == f);
    for (const auto& p : {std::array<std::size_t, 4>{1, 0, 2, 3}, {2, 3, 0, 1}})
      REQUIRE(primitive_impact(ee, turned(a, p), turned(b, p)).toi.has_value() == e);
    REQUIRE(primitive_impact(vf, b, a).toi.has_value() == f);
    REQUIRE(primitive_impact(ee, b, a).toi.has_value() == e);
  }
  CHECK(hits > n / 5);
  CHECK(hits < 2 * n * 4 / 5);
}

TEST_CASE("primitives: a minimum separation is kept until the time of impact", "[primitive][random]") {
  long hits = 0, cases = 0;
  for (std::uint64_t i = 0; i < 1400; ++i) {
    Rng r = Rng::stream(902, i);
    const PrimitiveMotion m = random_motion(r, i % 7 == 5 ? 0 : i);
    const double size = size_of(m.a, m.b), least = size * std::ldexp(1.0, -static_cast<int>(r.below(20)));
    const double tolerance = r.chance(0.5) ? 0 : least / 1024;
    for (const PrimitiveKind kind : {vf, ee}) {
      const PrimitiveImpact x = primitive_impact(kind, m.a, m.b, {least, tolerance});
      CAPTURE(i, kind == vf, least, static_cast<int>(x.exit), x.separation);
      REQUIRE(x.outcome == Outcome::answered);
      ++cases;
      hits += x.toi.has_value();
      const double end = x.toi.value_or(1), slack = 1e-12 * size + rounding_of(m.a, m.b);
      for (int k = 0; k < 25 && end > 0; ++k)
        REQUIRE(gap(kind, at(m.a, m.b, end * (k + r.uniform()) / 25)) >= least - slack);
      if (x.toi) REQUIRE(gap(kind, at(m.a, m.b, *x.toi)) <= least + tolerance + slack);
    }
  }
  CAPTURE(cases, hits);
  CHECK(hits > cases / 5);
  CHECK(hits < cases * 19 / 20);
}

TEST_CASE("primitives: infinite, NaN and negative input is refused", "[primitive]") {
  Quad a = Quad{Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, b = a;
  b[2].y() = std::nan("");
  CHECK(primitive_impact(vf, a, b).outcome == Outcome::invalid_input);
  b[2].y() = -HUGE_VAL;
  CHECK(primitive_impact(ee, a, b).outcome == Outcome::invalid_input);
  CHECK(primitive_impact(ee, a, a, {.min_separation = -1}).outcome == Outcome::invalid_input);
  CHECK(primitive_impact(ee, a, a, {.tolerance = std::nan("")}).outcome == Outcome::invalid_input);
}
