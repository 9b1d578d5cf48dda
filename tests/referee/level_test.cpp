// Every level of the filter against the exact one, and the quick bracket against the slow one, on pairs that
// target the worst rounding: nearly parallel boxes, gaps down to zero, coordinates far from the origin, flat
// and tiny bodies, numbers at the limits of doubles whose squares are finite.
#include <array>
#include <cmath>

#include "core/math/roundoff.h"
#include "oracles/checker/checker.h"
#include "oracles/referee/counters.h"
#include "oracles/referee/exact/exact_point.h"
#include "oracles/referee/filter/convex.h"
#include "oracles/referee/work.h"
#include "tests/referee/support.h"
#include "tests/support/catch.h"

namespace touchstone::referee_test {
namespace {

struct Pair {
  Shape a, b;
  Pose pose_a, pose_b;
};

using Draw = Pair (*)(Rng&);

Shape exact_shape(Rng& r, double size = 1) {
  return random_convex(r, tested_kinds[r.below(exact_kind_count)], size);
}

// A number in [0, 1).
double r_of(int i) { return std::fmod(0.618033988749895 * i * (1 + i % 5), 1.0); }

Pair anywhere(Rng& r) {
  Pair p{exact_shape(r), exact_shape(r), {}, {}};
  p.pose_a = {r.vector(0, 0.5), r.rotation()};
  p.pose_b = {r.vector(0, 1), r.rotation()};
  return p;
}

// B's support point at A's, then offset by a power of two from an ulp to a tenth, either way, or not at all.
void bring_together(Rng& r, Pair& p, double size) {
  const Vec3 n = r.chance(0.5) ? Vec3(rotation_matrix(p.pose_a.rotation).col(static_cast<int>(r.below(3))))
                               : r.unit_vector();
  const double gap = r.chance(0.2) ? 0 : (r.chance(0.5) ? -1 : 1) * size * r.binary_scale(-60, -3);
  p.pose_b.translation = p.pose_a.translation + r.vector(0, 0.1) * size;
  const Vec3 reach = world_support(p.a, p.pose_a, n) - world_support(p.b, p.pose_b, -n);
  p.pose_b.translation += reach + n * gap;
}

Pair close(Rng& r) {
  Pair p = anywhere(r);
  bring_together(r, p, 1);
  return p;
}

Pair far_away(Rng& r) {
  Pair p = anywhere(r);
  p.pose_a.translation += r.unit_vector() * r.binary_scale(4, 30);
  bring_together(r, p, 1);
  return p;
}

Pair nearly_parallel_boxes(Rng& r) {
  const auto s = [&] { return r.uniform(0.1, 1); };
  Pair p{Box{{s(), s(), s()}}, Box{{s(), s(), s()}}, {}, {}};
  p.pose_a = {r.vector(0, 1), r.rotation()};
  const double tilt = r.chance(0.2) ? 0 : r.binary_scale(-60, -2);
  const Vec3 w = r.unit_vector() * tilt;
  Quat q = p.pose_a.rotation;
  q.x += w.x();
  q.y += w.y();
  q.z += w.z();
  p.pose_b.rotation = q;
  if (r.chance(0.5))
    bring_together(r, p, 1);
  else
    p.pose_b.translation = p.pose_a.translation + r.vector(0, 0.5);
  return p;
}

Pair flat(Rng& r) {
  const auto s = [&] { return r.chance(0.4) ? r.binary_scale(-60, -10) : r.uniform(0.1, 1); };
  Pair p{Box{{s(), s(), s()}}, Box{{s(), s(), s()}}, {}, {}};
  if (r.chance(0.3)) p.b = Capsule{s(), s()};
  p.pose_a.rotation = r.rotation();
  p.pose_b.rotation = r.rotation();
  p.pose_b.translation = r.vector(0, 1);
  if (r.chance(0.5)) bring_together(r, p, 0.1);
  return p;
}

Pair any_scale(Rng& r) {
  const double size = r.binary_scale(-120, 120);
  Pair p{exact_shape(r, size), exact_shape(r, size), {}, {}};
  p.pose_a = {r.vector(0, size), r.rotation()};
  p.pose_b = {r.vector(0, 1.5 * size), r.rotation()};
  return p;
}

Pair on_a_lattice(Rng& r) {
  const auto c = [&] { return (static_cast<double>(r.below(9)) - 4) / 8; };
  const auto s = [&] { return static_cast<double>(1 + r.below(4)) / 8; };
  static constexpr std::array<std::array<double, 4>, 5> turns{
      {{0, 0, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {1, 0, 0, 3}, {1, 2, 0, 2}}};
  const auto shape = [&]() -> Shape {
    switch (r.below(4)) {
      case 0:
        return Sphere{s()};
      case 1:
        return Box{{s(), s(), s()}};
      case 2:
        return Capsule{s(), s()};
      default:
        break;
    }
    Hull h;
    for (std::size_t i = 0; i < 1 + r.below(7); ++i) h.vertices.emplace_back(c(), c(), c());
    return h;
  };
  Pair p{shape(), shape(), {}, {}};
  for (Pose* pose : {&p.pose_a, &p.pose_b}) {
    const auto& q = turns[r.below(turns.size())];
    *pose = {Vec3(c(), c(), c()), {q[0], q[1], q[2], q[3]}};
  }
  return p;
}

struct Family {
  const char* name;
  Draw draw;
  double level0;  // least share that doubles decide
};

constexpr Family families[] = {{"anywhere", anywhere, 0.99},
                               {"close", close, 0.6},
                               {"far away", far_away, 0.3},
                               {"nearly parallel boxes", nearly_parallel_boxes, 0.6},
                               {"flat", flat, 0.6},
                               {"any scale", any_scale, 0.5},
                               {"on a lattice", on_a_lattice, 0.5}};

struct Tally {
  int level[3] = {0, 0, 0}, overlaps = 0, wide = 0;
};

void compare(const Pair& p, Tally& tally) {
  const Placed a{&p.a, p.pose_a}, b{&p.b, p.pose_b};
  const Vec3 origin = p.pose_a.translation;
  const Operand x = make_operand(a, origin), y = make_operand(b, origin);
  const ConvexTruth quick = judge_convex(x, y), slow = judge_convex(x, y, {}, Effort::certificate);
  const ExactVerdict exact = decide(make_exact(x.exact_body(), y.exact_body()), {});
  const double l = scale_of(p.a, p.pose_a.translation - origin, p.b, p.pose_b.translation - origin);
  CAPTURE(type_name(p.a), type_name(p.b), quick.level, static_cast<double>(quick.lo),
          static_cast<double>(quick.hi), static_cast<double>(slow.lo), static_cast<double>(slow.hi));
  REQUIRE(quick.verdict == (exact.overlap ? Verdict::overlap : Verdict::disjoint));
  REQUIRE(slow.verdict == quick.verdict);
  REQUIRE(quick.lo <= quick.hi);
  REQUIRE(quick.lo <= slow.hi);
  REQUIRE(slow.lo <= quick.hi);
  const double width = static_cast<double>(quick.hi - quick.lo) / l;
  CAPTURE(width);
  REQUIRE((width <= 4e-15 || quick.lo <= 0));
  tally.wide += width > 4e-15;
  if (const auto brief = decide_short(x.exact_body(), y.exact_body(), {})) {
    REQUIRE(brief->overlap == exact.overlap);
    REQUIRE(brief->direction.x == exact.direction.x);
    REQUIRE(brief->direction.y == exact.direction.y);
    REQUIRE(brief->direction.z == exact.direction.z);
  }
  ++tally.level[quick.level];
  tally.overlaps += exact.overlap;
}

}  // namespace

TEST_CASE("no level of the filter contradicts the exact one, and quick brackets meet slow ones",
          "[referee][levels]") {
  for (const Family& f : families) {
    constexpr int cases = 4000;
    Tally t;
    for (int i = 0; i < cases; ++i) {
      Rng r = Rng::stream(77, static_cast<std::uint64_t>(i));
      INFO(f.name << " " << i);
      compare(f.draw(r), t);
    }
    WARN(f.name << ": doubles settle " << t.level[0] << ", extended precision or short integers "
                << t.level[1] << ", long integers " << t.level[2] << " of " << cases << "; " << t.overlaps
                << " overlap, " << t.wide << " brackets of a depth are wider than 4e-15 L");
    CHECK(t.level[0] >= f.level0 * cases);
    CHECK(t.wide <= cases / 100);
    CHECK(t.overlaps > cases / 10);
    CHECK(t.overlaps < cases * 9 / 10);
  }
}

TEST_CASE("a verdict needs no inner polytope, and a gap beyond what is asked for no extended precision",
          "[referee][levels]") {
  Rng r(79);
  int overlaps = 0, apart = 0;
  for (int i = 0; i < 500; ++i) {
    Pair p = anywhere(r);
    if (r.chance(0.5)) p.a = random_convex(r, ShapeKind::ellipsoid);
    if (r.chance(0.5)) p.b = random_convex(r, ShapeKind::cylinder);
    const Operand x = make_operand({&p.a, p.pose_a}, Vec3::Zero()),
                  y = make_operand({&p.b, p.pose_b}, Vec3::Zero());
    const ConvexTruth whole = judge_convex(x, y);
    // Doubles tell no difference below this.
    const Real clear = 1e-13L * (x.body.extent + y.body.extent);
    if (std::fabs(whole.hi) < clear) continue;
    const std::uint64_t expansions = counters().expansions;
    const ConvexTruth verdict = judge_convex(x, y, {}, Effort::verdict_only);
    REQUIRE(counters().expansions == expansions);
    REQUIRE(verdict.verdict == whole.verdict);
    REQUIRE(verdict.lo <= whole.hi);
    REQUIRE(verdict.hi >= whole.lo);
    ++(whole.verdict == Verdict::overlap ? overlaps : apart);
    if (whole.verdict == Verdict::overlap) continue;
    const ConvexTruth beyond = judge_convex(x, y, {}, Effort::gap, whole.lo / 2),
                      within = judge_convex(x, y, {}, Effort::gap, whole.hi * 2);
    REQUIRE(within.lo == whole.lo);
    REQUIRE(within.hi == whole.hi);
    REQUIRE(beyond.lo == verdict.lo);
    REQUIRE(beyond.hi == verdict.hi);
  }
  CHECK(overlaps > 50);
  CHECK(apart > 50);
}

TEST_CASE("integers of 512 bits and rationals agree on half-spaces", "[referee][levels]") {
  Rng r(78);
  int decided = 0, overlaps = 0, touching = 0;
  constexpr int cases = 4000;
  for (int i = 0; i < cases; ++i) {
    const Pair p = on_a_lattice(r);
    const auto c = [&] { return (static_cast<double>(r.below(9)) - 4) / 4; };
    HalfSpace h{Vec3(c(), c(), c()), c() * c() / 2};
    if (h.normal.isZero(0)) h.normal = Vec3(0, 0, 1);
    const Shape shape = h;
    const Placed plane{&shape, p.pose_b}, body{&p.a, p.pose_a};
    const Operand x = make_operand(body, Vec3::Zero());
    const auto brief = overlaps_half_space_short(h.normal, h.offset, p.pose_b, x.exact_body());
    REQUIRE(brief.has_value());
    // The same half-space given as a placement takes the path of rationals.
    const Placed same{&shape, Placement{Mat3::Identity(), Vec3::Zero()}};
    const bool unturned = p.pose_b.rotation == Quat{0, 0, 0, 1} && p.pose_b.translation.isZero(0);
    const PairTruth t = judge_pair(plane, body);
    REQUIRE(t.verdict == (*brief ? Verdict::overlap : Verdict::disjoint));
    if (unturned) REQUIRE(judge_pair(same, body).verdict == t.verdict);
    const bool near = t.gap.lo <= 0 && t.gap.hi >= 0;
    touching += near;
    if (near) {
      // Offset by about an ulp either way it is no longer in doubt.
      const Shape up = HalfSpace{h.normal, h.offset + 0x1p-40},
                  down = HalfSpace{h.normal, h.offset - 0x1p-40};
      REQUIRE(judge_pair({&up, p.pose_b}, body).verdict == Verdict::overlap);
      REQUIRE(judge_pair({&down, p.pose_b}, body).verdict == Verdict::disjoint);
    }
    ++decided;
    overlaps += *brief;
  }
  WARN(decided << " cases, " << overlaps << " overlap, " << touching << " touch");
  REQUIRE(decided == cases);
  REQUIRE(touching > 10);
}

TEST_CASE("a point of a curved body: integers of 512 bits and the checker's rationals agree",
          "[referee][levels]") {
  Rng r(79);
  int inside = 0, on_border = 0, decided = 0;
  constexpr int cases = 6000;
  for (int i = 0; i < cases; ++i) {
    const Pair placed = on_a_lattice(r);
    const auto s = [&] { return static_cast<double>(1 + r.below(4)) / 8; };
    Shape shape = Ellipsoid{{s(), s(), s()}};
    if (i % 3 == 0) shape = Cylinder{s(), s()};
    if (i % 3 == 1) shape = Cone{s(), s()};
    if (i % 7 == 0) shape = placed.a;
    const Placed body{&shape, placed.pose_a};
    const auto c = [&] { return (static_cast<double>(r.below(9)) - 4) / 16; };
    Vec3 point = placed.pose_a.translation + Vec3(c(), c(), c());
    if (r.chance(0.2)) point = world_support(shape, placed.pose_a, Vec3(c(), c(), 1));
    const auto brief = contains_short(body, point);
    if (!brief) continue;
    Certificate at;
    at.kind = Certificate::Kind::common_point;
    at.point = point;
    REQUIRE(checker::check(at, body, body) == *brief);
    ++decided;
    inside += *brief;
    // Exactly on the border: inside as it is, outside slightly farther from the centre.
    const Vec3 out = point + 0x1p-30 * (point - placed.pose_a.translation);
    if (const auto beyond = contains_short(body, out); *brief && beyond && !*beyond) ++on_border;
  }
  WARN(decided << " points, " << inside << " inside, " << on_border << " of them on the border");
  REQUIRE(decided > cases * 8 / 10);
  REQUIRE(inside > decided * 2 / 10);
  REQUIRE(inside < decided * 8 / 10);
  REQUIRE(on_border > 50);
}

TEST_CASE("a question that takes too much work is left undecided with a note, never guessed",
          "[referee][work]") {
  Rng r(71);
  std::size_t open = 0;
  for (const std::int64_t limit : {0, 300, 3000, 30000, 300000})
    for (int i = 0; i < 60; ++i) {
      const Pair p = anywhere(r);
      const Placed a{&p.a, p.pose_a}, b{&p.b, p.pose_b};
      const Motion turning{r.vector(0, 2), r.vector(0, 3)}, still;
      const PairTruth whole = judge_pair(a, b);
      const TimeTruth in_time = judge_motion(a, turning, b, still);
      const WorkLimit less(limit);
      const PairTruth t = judge_pair(a, b);
      const bool unknown = t.verdict_certificate.note == too_expensive;
      CHECK(t.verdict == (unknown ? Verdict::undecided : whole.verdict));
      CHECK(t.gap.lo == (unknown ? -infinity : whole.gap.lo));
      CHECK(t.gap.hi == (unknown ? infinity : whole.gap.hi));
      CHECK(t.normal.allFinite());
      open += unknown;
      const TimeTruth m = judge_motion(a, turning, b, still);
      if (m.note == too_expensive)
        CHECK(m.verdict == TimeTruth::Verdict::undecided);
      else
        CHECK((m.verdict == in_time.verdict && m.t_lo == in_time.t_lo && m.t_hi == in_time.t_hi));
      const Bracket d = distance_to(a, p.pose_b.translation);
      CHECK(d.lo <= d.hi);
      const double depth = deepest_before(a, turning, b, still, 1).depth;
      CHECK((depth >= 0 || depth == -infinity));
      CHECK(gap_at(a, turning, b, still, 0.5).lo <= gap_at(a, turning, b, still, 0.5).hi);
    }
  CHECK(open > 60);
  CHECK(open < 300);
}

TEST_CASE("two meshes with too many pairs of triangles are left undecided at once", "[referee][work]") {
  TriangleMesh m;
  for (int i = 0; i < 60000; ++i) m.vertices.emplace_back(r_of(i), r_of(i + 7), r_of(i + 13));
  for (int i = 0; i + 2 < 60000; ++i) m.triangles.push_back({i, i + 1, i + 2});
  const Shape mesh = m;
  const PairTruth t = judge_pair({&mesh, Pose{}}, {&mesh, Pose{Vec3(0, 0, 0.25), Quat{}}});
  CHECK(t.verdict == Verdict::undecided);
  CHECK(t.verdict_certificate.note == too_expensive);
  // The next question has its own limit.
  const Shape box = Box{{1, 1, 1}};
  CHECK(judge_pair({&box, Pose{}}, {&box, Pose{}}).verdict == Verdict::overlap);
}

}  // namespace touchstone::referee_test
