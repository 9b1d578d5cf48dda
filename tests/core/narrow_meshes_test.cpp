// Mesh against mesh: verdicts, distances and contacts as the referee judges them, and the bounds of pairs of
// triangles that they rest on.
#include <algorithm>
#include <set>

#include "core/math/roundoff.h"
#include "core/narrow/mesh_contacts.h"
#include "core/narrow/mesh_pairs.h"
#include "core/narrow/pair_table.h"
#include "core/narrow/unit_scale.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/core/random_meshes.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;
using narrow::Triangle;

namespace {

double tau_of(const Pair& p) { return tolerance::core_tau_factor * 0x1p-53 * scale_of(p); }

Shape hull_of(const Shape& mesh, std::size_t triangle) {
  const auto& m = std::get<TriangleMesh>(mesh);
  std::vector<Vec3> v;
  for (const int k : m.triangles[triangle]) v.push_back(m.vertices[static_cast<std::size_t>(k)]);
  return make_hull(std::move(v));
}

std::size_t triangles_of(const Shape& mesh) { return std::get<TriangleMesh>(mesh).triangles.size(); }

// The least gap over all pairs of triangles, each a pair of hulls.
referee::Bracket least_gap(const Pair& p) {
  referee::Bracket least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < triangles_of(p.a); ++i) {
    const Shape x = hull_of(p.a, i);
    for (std::size_t j = 0; j < triangles_of(p.b); ++j) {
      const Shape y = hull_of(p.b, j);
      const referee::Bracket g = referee::judge_pair({&x, p.pose_a}, {&y, p.pose_b}).gap;
      least = {std::min(least.lo, g.lo), std::min(least.hi, g.hi)};
    }
  }
  return least;
}

void check_against(const PlacedShape& a, const PlacedShape& b, const Pair& p,
                   const referee::PairTruth& truth) {
  const double tau = tau_of(p);
  const bool meet = truth.verdict == referee::Verdict::overlap;
  const OverlapAnswer o = overlap(a, b);
  const DistanceAnswer d = distance(a, b);
  const ContactAnswer k = contact(a, b);
  REQUIRE(o.outcome == Outcome::answered);
  REQUIRE(d.outcome == Outcome::answered);
  REQUIRE(k.outcome == Outcome::answered);
  if (meet ? d.distance < -tau : truth.gap.lo > tau) {
    CHECK(o.overlap == meet);
    CHECK(k.overlap == meet);
  }
  CHECK(d.distance <= truth.gap.hi + tau);
  if (!meet) CHECK(d.distance >= truth.gap.lo - tau);
  CHECK(std::abs((d.witness[1] - d.witness[0]).norm() - std::abs(d.distance)) <= tau);
  CHECK(referee::distance_to({&p.a, p.pose_a}, d.witness[0], tau).lo <= tau);
  CHECK(referee::distance_to({&p.b, p.pose_b}, d.witness[1], tau).lo <= tau);
  if (!k.overlap) return;
  CHECK(std::abs(k.normal.norm() - 1) < 1e-12);
  CHECK(std::abs(k.depth - std::max(0.0, -d.distance)) <= 2 * tau);
  REQUIRE(k.manifold.size() == 1);
  CHECK(referee::distance_to({&p.a, p.pose_a}, k.manifold[0].position, tau).lo <= k.depth / 2 + tau);
  CHECK(referee::distance_to({&p.b, p.pose_b}, k.manifold[0].position, tau).lo <= k.depth / 2 + tau);
}

Triangle random_triangle(Rng& r) {
  const double size = std::ldexp(1, -static_cast<int>(r.below(8)));
  Triangle t;
  for (Vec3& v : t) v = r.unit_vector() * r.uniform(0, size);
  if (r.chance(0.1)) t[2] = (t[0] + t[1]) / 2;
  if (r.chance(0.05)) t[1] = t[0];
  return t;
}

Shape as_hull(const Triangle& t) { return make_hull({t[0], t[1], t[2]}); }

}  // namespace

TEST_CASE("two meshes: in agreement with the referee, with and without colliders", "[narrow][mesh]") {
  long cases = 0, meeting = 0, fast = 0;
  for (int regime = 0; regime < mesh_regime_count; ++regime)
    for (std::uint64_t i = 0; i < 60; ++i) {
      INFO(mesh_regime_names[static_cast<std::size_t>(regime)] << " " << i);
      Rng r = Rng::stream(95 + static_cast<std::uint64_t>(regime), i);
      const Pair p = random_mesh_pair(r, regime);
      const auto truth = referee::judge_pair({&p.a, p.pose_a}, {&p.b, p.pose_b});
      REQUIRE(truth.verdict != referee::Verdict::undecided);
      const Collider a(p.a), b(p.b);
      check_against(a.at(p.pose_a), b.at(p.pose_b), p, truth);
      if (i % 4 == 0) check_against(p.placed_a(), p.placed_b(), p, truth);
      narrow::FastAnswer<double> f;
      narrow::separate_fast<double>(a.at(p.pose_a), b.at(p.pose_b), narrow::filtered::Asked::distance, f);
      fast += f.answer.found != narrow::filtered::Found::unsure;
      meeting += truth.verdict == referee::Verdict::overlap;
      ++cases;
    }
  CHECK(meeting * 10 > cases * 3);
  CHECK(meeting * 10 < cases * 9);
  CHECK(fast * 10 > cases * 9);
}

TEST_CASE("two meshes: extended precision alone agrees", "[narrow][mesh]") {
  for (std::uint64_t i = 0; i < 48; ++i) {
    INFO(i);
    Rng r = Rng::stream(94, i);
    const Pair p = random_mesh_pair(r, static_cast<int>(i % mesh_regime_count));
    const Separation s = separation(p.placed_a(), p.placed_b());
    REQUIRE(s.outcome == Outcome::answered);
    CHECK(std::abs(static_cast<double>(s.gap) - distance(p.placed_a(), p.placed_b()).distance) <= tau_of(p));
  }
}

TEST_CASE("two meshes: the gap is that of the nearest or deepest pair of triangles", "[narrow][mesh]") {
  int cases = 0;
  for (std::uint64_t i = 0; cases < 48; ++i) {
    INFO(i);
    Rng r = Rng::stream(93, i);
    const Pair p = random_mesh_pair(r, static_cast<int>(i % mesh_regime_count));
    if (triangles_of(p.a) * triangles_of(p.b) > 300) continue;
    ++cases;
    const double tau = tau_of(p), d = distance(p.placed_a(), p.placed_b()).distance;
    const referee::Bracket least = least_gap(p);
    CHECK(d >= least.lo - tau);
    CHECK(d <= least.hi + tau);
  }
}

TEST_CASE("all contacts of two meshes are all pairs of triangles that meet", "[narrow][mesh]") {
  long contacts = 0;
  int cases = 0;
  for (std::uint64_t i = 0; cases < 48; ++i) {
    INFO(i);
    Rng r = Rng::stream(92, i);
    const Pair p = random_mesh_pair(r, i % 2 ? 1 : 4);
    if (triangles_of(p.a) * triangles_of(p.b) > 300) continue;
    ++cases;
    const double tau = tau_of(p);
    const MeshContacts found = mesh_contacts(p.placed_a(), p.placed_b());
    REQUIRE(found.outcome == Outcome::answered);
    std::size_t next = 0;
    for (std::size_t x = 0; x < triangles_of(p.a); ++x)
      for (std::size_t y = 0; y < triangles_of(p.b); ++y) {
        const Shape one = hull_of(p.a, x), other = hull_of(p.b, y);
        const Placed a{&one, p.pose_a}, b{&other, p.pose_b};
        const auto truth = referee::judge_pair(a, b);
        const bool listed = next < found.contacts.size() && found.contacts[next].a == static_cast<int>(x) &&
                            found.contacts[next].b == static_cast<int>(y);
        if (std::abs(truth.gap.hi) > tau && std::abs(truth.gap.lo) > tau)
          CHECK(listed == (truth.verdict == referee::Verdict::overlap));
        if (!listed) continue;
        const TriangleContact& c = found.contacts[next++];
        ++contacts;
        CHECK(std::abs(c.depth + truth.gap.hi) <= tau);
        CHECK(referee::width(a, b, c.normal).lo <= c.depth + tau);
        CHECK(referee::distance_to(a, c.position).lo <= c.depth / 2 + tau);
        CHECK(referee::distance_to(b, c.position).lo <= c.depth / 2 + tau);
      }
    CHECK(next == found.contacts.size());
  }
  CHECK(contacts > 250);
  const Shape ball = Sphere{1}, mesh = box_mesh({1, 1, 1});
  CHECK(mesh_contacts({&ball, {}}, {&mesh, {}}).outcome == Outcome::unsupported);
}

TEST_CASE("two meshes: the unit of length does not matter", "[narrow][mesh]") {
  for (std::uint64_t i = 0; i < 12; ++i)
    for (const int e : {-600, -300, 300, 600, 1000}) {
      INFO(i << " times 2^" << e);
      Rng r = Rng::stream(96, i);
      const Pair p = random_mesh_pair(r, static_cast<int>(i % 5));
      const narrow::ScaledPair<PlacedShape> q(p.placed_a(), p.placed_b(), e);
      const double tau = tau_of(p);
      CHECK(overlap(q.a, q.b).overlap == overlap(p.placed_a(), p.placed_b()).overlap);
      const DistanceAnswer d = distance(q.a, q.b);
      REQUIRE(d.outcome == Outcome::answered);
      CHECK(std::abs(std::ldexp(d.distance, -e) - distance(p.placed_a(), p.placed_b()).distance) <= 2 * tau);
      CHECK(mesh_contacts(q.a, q.b).contacts.size() ==
            mesh_contacts(p.placed_a(), p.placed_b()).contacts.size());
    }
}

TEST_CASE("bounds of two triangles contain the gap, and a certain crossing is one", "[narrow][mesh]") {
  const Pose origin;
  long crossings = 0, meeting = 0, narrow_bounds = 0, apart = 0;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    INFO(i);
    Rng r = Rng::stream(97, i);
    Triangle a = random_triangle(r), b = random_triangle(r);
    if (r.chance(0.2)) b[0] = a[r.below(3)];                                     // touch at a corner
    if (r.chance(0.2)) b[0] = a[0] + r.uniform() * (a[1] - a[0]);                // at an edge, nearly
    if (r.chance(0.1)) b[2] = a[0] + 0.3 * (a[1] - a[0]) + 0.3 * (a[2] - a[0]);  // in the face, nearly
    if (r.chance(0.1)) b = {a[1], a[0], b[2]};                                   // a common edge
    const Vec3 far = r.chance(0.2) ? Vec3(r.unit_vector() * std::ldexp(1, static_cast<int>(r.below(12))))
                                   : Vec3(Vec3::Zero());
    for (Triangle* t : {&a, &b})
      for (Vec3& v : *t) v += far;
    const Shape x = as_hull(a), y = as_hull(b);
    const auto truth = referee::judge_pair({&x, origin}, {&y, origin});
    const narrow::TriangleGap g = narrow::triangle_gap(a, b, infinity);
    const double rounding = narrow::triangle_rounding * 0x1p-53 * narrow::local_size(a, b);
    CHECK(g.lo <= truth.gap.hi);
    CHECK(g.hi >= truth.gap.lo);
    CHECK(narrow::gap_by_axes(a, b, infinity).lo <= truth.gap.hi);
    CHECK(narrow::gap_by_faces(a, b) <= truth.gap.hi);
    const bool crosses = narrow::cross_certainly(a, b, 0);
    if (crosses) CHECK(truth.verdict == referee::Verdict::overlap);
    const double displacement = 1e-3;
    if (narrow::cross_certainly(a, b, displacement)) CHECK(truth.gap.lo < -displacement / 2);
    if (truth.gap.hi < -1e-9) {
      ++meeting;
      crossings += crosses;
    }
    if (truth.gap.lo > 1e-9) {
      ++apart;
      narrow_bounds += g.hi - g.lo <= 4 * rounding;
      CHECK(referee::distance_to({&x, origin}, g.a).lo <= rounding + 4e-16 * far.norm());
      CHECK(referee::distance_to({&y, origin}, g.b).lo <= rounding + 4e-16 * far.norm());
      CHECK(narrow::triangle_gap(a, b, truth.gap.lo / 2).hi == infinity);
    }
  }
  CHECK(meeting > 300);
  CHECK(crossings * 100 > meeting * 95);
  CHECK(apart > 300);
  CHECK(narrow_bounds * 100 > apart * 95);
}
