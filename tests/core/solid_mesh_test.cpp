// Solid meshes: what is accepted as one, what is inside, and the core's answers, judged by the referee.
#include <cstdlib>

#include "core/impact/impact.h"
#include "core/narrow/narrow_phase.h"
#include "core/tolerance.h"
#include "fuzz/judge/judge.h"
#include "oracles/checker/checker.h"
#include "oracles/referee/referee.h"
#include "scenarios/random/family.h"
#include "scenarios/random/random_shape.h"
#include "tests/support/catch.h"
#include "tests/support/l_shape.h"

using namespace touchstone;
using touchstone::test::l_shape;

namespace {

// A box with corners (±x, ±y, ±z) at `from`; `inward`: its triangles turned over.
void add_box(TriangleMesh& m, const Vec3& half, const Vec3& at, bool inward = false) {
  const int o = static_cast<int>(m.vertices.size());
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(at + half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  for (auto [a, b, c] : {std::array{0, 4, 6},
                         {0, 6, 2},
                         {1, 3, 7},
                         {1, 7, 5},
                         {0, 1, 5},
                         {0, 5, 4},
                         {2, 6, 7},
                         {2, 7, 3},
                         {0, 2, 3},
                         {0, 3, 1},
                         {4, 5, 7},
                         {4, 7, 6}}) {
    if (inward) std::swap(b, c);
    m.triangles.push_back({o + a, o + b, o + c});
  }
}

TriangleMesh box(const Vec3& half, const Vec3& at = Vec3::Zero()) {
  TriangleMesh m;
  add_box(m, half, at);
  return m;
}

std::string flaw(const TriangleMesh& m) {
  const auto f = flaw_of_solid(m);
  return f ? f->place + ": " + f->reason : "";
}
bool begins(const std::string& text, std::string_view with) {
  INFO(text);
  return text.starts_with(with);
}

struct Pair {
  Shape a, b;
  Pose at_a, at_b;
  PlacedShape core_a() const { return {&a, at_a}; }
  PlacedShape core_b() const { return {&b, at_b}; }
  referee::PairTruth truth() const { return referee::judge_pair({&a, at_a}, {&b, at_b}); }
};

Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat{}}; }

}  // namespace

TEST_CASE("a closed surface that faces outward is the surface of a solid", "[solid]") {
  CHECK(flaw(box({1, 2, 3})).empty());
  CHECK(flaw(l_shape()).empty());
  TriangleMesh hollow = box({2, 2, 2});
  add_box(hollow, {1, 1, 1}, Vec3::Zero(), true);
  CHECK(flaw(hollow).empty());
  add_box(hollow, {0.5, 0.5, 0.5}, Vec3::Zero());
  CHECK(flaw(hollow).empty());
  // Vertices with equal coordinates count as one.
  TriangleMesh soup;
  for (const auto& t : box({1, 1, 1}).triangles) {
    const TriangleMesh b = box({1, 1, 1});
    for (int k : t) soup.vertices.push_back(b.vertices[static_cast<std::size_t>(k)]);
    const int n = static_cast<int>(soup.vertices.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  CHECK(flaw(soup).empty());
  Rng rng(5);
  for (int i = 0; i < 300; ++i) CHECK(flaw(fuzz::random_solid(rng, 1)).empty());
}

TEST_CASE("what is no surface of a solid is refused, and where", "[solid]") {
  const TriangleMesh good = box({1, 1, 1});
  TriangleMesh open = good;
  open.triangles.erase(open.triangles.begin() + 3);
  CHECK(begins(flaw(open), "triangles[2]: has no triangle on the other side of the edge from vertex 7 to 1"));
  TriangleMesh turned = good;
  std::swap(turned.triangles[5][0], turned.triangles[5][1]);
  CHECK(begins(flaw(turned), "triangles[5]: runs along the edge"));
  TriangleMesh inside_out = good;
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  CHECK(begins(flaw(inside_out), "triangles[0]: is clockwise seen from outside"));
  TriangleMesh flat = good;
  flat.vertices[7] = flat.vertices[3];
  CHECK(begins(flaw(flat), "triangles[2]: has no area"));
  TriangleMesh spare = good;
  spare.vertices.push_back({0, 0, 0});
  CHECK(flaw(spare) == "vertices[8]: belongs to no triangle of the solid");
  for (const double x : {0.9e-95, 1.1e95}) {
    TriangleMesh out_of_range = good;
    out_of_range.vertices[2].y() = x;
    CHECK(begins(flaw(out_of_range), "vertices[2]: has a coordinate that is not within"));
  }
  TriangleMesh crossing = good;
  add_box(crossing, {1, 1, 1}, {1.5, 0.5, 0.25});
  CHECK(begins(flaw(crossing), "triangles["));
  CHECK(flaw(crossing).find("the surface meets itself") != std::string::npos);
  TriangleMesh double_box = good;
  add_box(double_box, {0.5, 0.5, 0.5}, Vec3::Zero());
  CHECK(
      begins(flaw(double_box), "triangles[12]: belongs to a part inside another part, which faces outward"));
  TriangleMesh touching = good;
  add_box(touching, {1, 1, 1}, {2, 2, 2});
  CHECK_FALSE(flaw(touching).empty());
  TriangleMesh dented = good;  // one corner through the opposite face
  dented.vertices[7] = {-3, -0.5, -0.25};
  CHECK(flaw(dented).find("the surface meets itself") != std::string::npos);
}

TEST_CASE("a crossing of one ulp is found, and a gap of one ulp is none", "[solid]") {
  TriangleMesh two = box({1, 1, 1});
  add_box(two, {1, 0.5, 0.5}, {2, 0, 0});
  for (std::size_t i = 8; i < 16; ++i)
    if (two.vertices[i].x() == 1) two.vertices[i].x() = std::nextafter(1.0, 2.0);
  CHECK(flaw(two).empty());
  for (std::size_t i = 8; i < 16; ++i)
    if (two.vertices[i].x() == std::nextafter(1.0, 2.0)) two.vertices[i].x() = 1;
  CHECK_FALSE(flaw(two).empty());
}

TEST_CASE("the winding number is exact above vertices, edges and vertical faces", "[solid]") {
  const TriangleMesh l = l_shape();
  for (const double x : {-1.0, 0.0, 0.5, 1.0, 2.0, 3.0, 3.5})
    for (const double y : {-1.0, 0.0, 0.5, 1.0, 2.0, 3.0, 3.5})
      for (const double z : {-2.0, 0.0, 2.0}) {
        const bool inside =
            z == 0 && ((x > 0 && x < 3 && y > 0 && y < 1) || (x > 0 && x < 1 && y > 0 && y < 3));
        const bool border = z == 0 && !inside && x >= 0 && x <= 3 && y >= 0 && y <= 3 && (x <= 1 || y <= 1);
        INFO(x << " " << y << " " << z);
        if (!border) CHECK(winding_number(l, {x, y, z}) == (inside ? 1 : 0));
      }
  CHECK(is_convex_solid(box({1, 2, 3})));
  CHECK_FALSE(is_convex_solid(l));
}

TEST_CASE("bodies inside, in the notch and in a cavity of a solid", "[solid]") {
  const Shape l = SolidMesh(l_shape()), small = Sphere{0.25};
  const auto pair = [&](double x, double y) { return Pair{l, small, at(0, 0, 0), at(x, y, 0)}; };
  const Pair in = pair(0.5, 0.5), notch = pair(2, 2);
  CHECK(overlap(in.core_a(), in.core_b()).overlap);
  CHECK(in.truth().verdict == referee::Verdict::overlap);
  CHECK_FALSE(overlap(notch.core_a(), notch.core_b()).overlap);
  CHECK(distance(notch.core_a(), notch.core_b()).distance == 0.75);
  const referee::PairTruth apart = notch.truth();
  CHECK(apart.verdict == referee::Verdict::disjoint);
  CHECK((apart.gap.lo <= 0.75 && 0.75 <= apart.gap.hi && apart.gap.hi - apart.gap.lo < 1e-14));
  // A sphere in the middle of the foot leaves through the nearer face, by 0.5 + 0.25.
  const ContactAnswer c = contact(in.core_a(), in.core_b());
  CHECK((c.outcome == Outcome::answered && c.overlap));
  CHECK(std::abs(c.depth - 0.75) < 1e-14);
  const referee::PairTruth deep = in.truth();
  CHECK((-deep.gap.hi <= 0.75 && -deep.gap.lo >= 0.75 && deep.gap.hi - deep.gap.lo < 1e-13));
  TriangleMesh hollow = box({2, 2, 2});
  add_box(hollow, {1, 1, 1}, Vec3::Zero(), true);
  const Pair cavity{SolidMesh(hollow), Sphere{0.5}, at(0, 0, 0), at(0.25, 0, 0)};
  CHECK_FALSE(overlap(cavity.core_a(), cavity.core_b()).overlap);
  CHECK(distance(cavity.core_b(), cavity.core_a()).distance == 0.25);
  CHECK(cavity.truth().verdict == referee::Verdict::disjoint);
}

TEST_CASE("a hull whose first vertex touches a face from inside overlaps the solid, however both are turned",
          "[solid]") {
  const Shape l = SolidMesh(l_shape()),
              hull = make_hull({{3, 0.5, 0}, {2.5, 0.25, 0}, {2.5, 0.75, 0.25}, {2.5, 0.5, -0.25}});
  Rng rng(7);
  for (int i = 0; i < 500; ++i) {
    Pose turned;
    turned.rotation = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    Pose other = turned;  // nearly: the vertex is some roundings inside or outside
    other.translation = {rng.uniform(-1, 1) * 0x1p-52, 0, 0};
    CHECK(overlap({&l, turned}, {&hull, other}).overlap);
    CHECK(distance({&hull, other}, {&l, turned}).distance < 0);
  }
}

TEST_CASE("a solid that touches another from inside overlaps it, however both are turned", "[solid]") {
  TriangleMesh small = l_shape();
  for (Vec3& v : small.vertices) v = Vec3(3, 0.875, 0) + Vec3(-v.x(), -v.y(), v.z()) / 4;
  const Shape l = SolidMesh(l_shape()), inner = SolidMesh(small);
  Rng rng(8);
  for (int i = 0; i < 200; ++i) {
    Pose turned;
    turned.rotation = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    Pose other = turned;
    other.translation = {rng.uniform(-1, 1) * 0x1p-52, 0, 0};
    CHECK(overlap({&l, turned}, {&inner, other}).overlap);
    CHECK(distance({&inner, other}, {&l, turned}).distance < 0);
  }
}

TEST_CASE("each connected part of a solid's surface has a point inside the solid", "[solid]") {
  TriangleMesh hollow = box({2, 2, 2});
  add_box(hollow, {1, 1, 1}, Vec3::Zero(), true);
  add_box(hollow, {0.5, 0.5, 0.5}, Vec3::Zero());
  const std::vector<Vec3> points = inner_points(hollow);
  REQUIRE(points.size() == 3);
  const auto reach = [](const Vec3& p) { return p.cwiseAbs().maxCoeff(); };
  CHECK((reach(points[0]) > 1 && reach(points[0]) < 2));
  CHECK((reach(points[1]) > 1 && reach(points[1]) < 2));
  CHECK(reach(points[2]) < 0.5);
}

// Planes that are parallel but for rounding meet 1e15 away: a motion to there proves nothing.
TEST_CASE("a ball whose centre lies on the face of a solid is its radius deep", "[solid]") {
  TriangleMesh l;
  for (const Vec3& v : l_shape().vertices)
    l.vertices.push_back({v.x() / 2 - 0.5, v.y() / 2 - 0.5, v.z() / 5});
  l.triangles = l_shape().triangles;
  const Shape solid = SolidMesh(l), ball = Sphere{0.85};
  Rng rng(9);
  for (int i = 0; i < 300; ++i) {
    Pose turned, centre;
    turned.rotation = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    centre.translation = to_transform(turned) * Vec3(-0.25, -0.25, -0.2);
    const ContactAnswer c = contact({&ball, centre}, {&solid, turned});
    CHECK((c.outcome == Outcome::answered && std::abs(c.depth - 0.85) < 1e-14));
    centre.translation = to_transform(turned) * Vec3(0.25, -0.25, -0.2);
    const DistanceAnswer d = distance({&solid, turned}, {&ball, centre});
    CHECK((d.outcome == Outcome::answered && std::abs(d.distance + 0.85) < 1e-14));
  }
}

TEST_CASE("a convex solid answers as the hull of its vertices", "[solid]") {
  const Pair p{SolidMesh(box({1, 2, 3})),
               Box{Vec3(0.5, 0.5, 0.5)},
               at(0, 0, 0),
               {Vec3(0.9, 0.5, 0.2), {0.1, 0.2, 0.3, 1}}};
  const Shape hull = make_hull(box({1, 2, 3}).vertices);
  const ContactAnswer x = contact(p.core_a(), p.core_b()), y = contact({&hull, p.at_a}, p.core_b());
  CHECK((x.overlap && x.depth == y.depth && x.normal == y.normal && x.manifold.size() == y.manifold.size()));
  const referee::PairTruth t = p.truth();
  CHECK(t.gap.hi - t.gap.lo < 1e-14);
  // Beside a half-space every solid is as good as its hull.
  const Pair q{HalfSpace{Vec3(0, 0, 1), 0}, SolidMesh(l_shape()), {}, at(0, 0, 0.75)};
  CHECK(std::abs(distance(q.core_a(), q.core_b()).distance + 0.25) < 1e-15);
  CHECK(std::abs(q.truth().gap.lo + 0.25) < 1e-15);
}

TEST_CASE("a body that begins inside a solid meets it at once", "[solid]") {
  const Shape l = SolidMesh(l_shape()), ball = Sphere{0.125};
  const Motion out{Vec3(9, 9, 0), Vec3::Zero()};
  const auto time = [&](double x, double y, const Motion& m) {
    return time_of_impact({&l, {}, {}}, {&ball, at(x, y, 0), m});
  };
  CHECK(time(0.5, 0.5, out).toi == 0.0);
  CHECK_FALSE(time(2, 2, out).toi);
  const ImpactAnswer hit = time(2, 2, {Vec3(-4, 0, 0), Vec3::Zero()});
  REQUIRE(hit.toi);
  CHECK(std::abs(*hit.toi - (1 - 0.125) / 4) < 1e-15);
  const Placed a{&l, Pose{}}, b{&ball, at(0.5, 0.5, 0)};
  CHECK(referee::judge_motion(a, {}, b, out).t_hi == 0);
  CHECK(referee::gap_at(a, {}, b, {}, 0).hi <= 0);
}

TEST_CASE("verdicts about solids have certificates that the checker accepts", "[solid]") {
  Rng rng(9);
  int accepted = 0, all = 0;
  for (int i = 0; i < 40; ++i) {
    const Shape a = fuzz::random_solid(rng, 1),
                b = rng.chance(0.5) ? Shape(Box{Vec3(0.2, 0.3, 0.1)}) : Shape(Sphere{0.2});
    const Placed x{&a, Pose{Vec3::Zero(), rng.rotation()}}, y{&b, Pose{rng.vector(0, 1.5), rng.rotation()}};
    const referee::PairTruth t = referee::judge_pair(x, y);
    const Certificate c = referee::checkable_certificate(t, x, y);
    ++all;
    if (c.kind == Certificate::Kind::none) continue;
    CHECK(checker::check(c, x, y));
    CHECK((c.kind == Certificate::Kind::common_point) == (t.verdict == referee::Verdict::overlap));
    ++accepted;
  }
  CHECK(accepted == all);
}

TEST_CASE("planes around a body inside a solid prove nothing", "[solid]") {
  const Shape cube = SolidMesh(box({1, 1, 1})), ball = Sphere{0.25};
  Certificate c;
  c.kind = Certificate::Kind::separating_plane;
  for (int k = 0; k < 3; ++k)
    for (const int side : {1, -1}) {
      // A on n·x <= o: the face across n at 1 has -n·x <= -1.
      for (int i = 0; i < 3; ++i) c.rationals.push_back(i == k ? std::to_string(-side) : "0");
      c.rationals.push_back("-1/2");
    }
  const Placed a{&cube, Pose{}}, b{&ball, Pose{}};
  CHECK_FALSE(checker::check(c, a, b));
  const Shape surface = box({1, 1, 1});
  CHECK(checker::check(c, {&surface, Pose{}}, b));
}

namespace {

struct Tally {
  int answers = 0, wrong = 0, not_judged = 0, undecided = 0, unanswered = 0;
};

EngineCard core_card() {
  EngineCard card;
  card.name = "core";
  card.unit_roundoff = 0x1p-53;
  card.tau_factor = tolerance::core_tau_factor;
  card.source = "core/tolerance.h";
  card.complete_manifolds = true;
  return card;
}

MovingShape moving(const Case& c, int i) {
  const Body& b = c.scene.bodies[static_cast<std::size_t>(i)];
  return {&c.scene.shape_of(i), b.pose, b.motion.value_or(Motion{})};
}

Observation answer_of(const Case& c, const Query& q) {
  Observation o;
  if (!is_pair_question(q.question)) return o;
  const MovingShape a = moving(c, q.a), b = moving(c, q.b);
  if (q.question == Question::time_of_impact) {
    const ImpactAnswer r = time_of_impact(a, b, ImpactDetail::time);
    o.outcome = r.outcome;
    o.toi = r.toi;
  } else if (q.question == Question::overlap) {
    const OverlapAnswer r = overlap(a, b);
    o.outcome = r.outcome;
    o.overlap = r.overlap;
  } else if (q.question == Question::distance) {
    const DistanceAnswer r = distance(a, b);
    o.outcome = r.outcome;
    o.distance = r.distance;
    o.witness = r.witness;
    o.normal = r.normal;
  } else {
    const ContactAnswer r = contact(a, b);
    o.outcome = r.outcome;
    o.overlap = r.overlap;
    if (!r.overlap) return o;
    o.normal = r.normal;
    o.depth = r.depth;
    for (const ContactPoint& p : r.manifold) o.manifold.push_back({p.position, p.depth});
  }
  return o;
}

std::string text_of(const Case& c) {
  std::string r = c.id;
  for (const Shape& s : c.scene.shapes) r += " " + std::string(type_name(s));
  return r;
}

// Of the core's answers to the first n cases of the family.
Tally judge_core(std::uint64_t seed, std::uint64_t n) {
  Tally r;
  for (std::uint64_t i = 0; i < n; ++i) {
    const Case c = fuzz::make_case(seed, i, "solids");
    CaseObservations observed;
    for (const Query& q : c.queries) observed.answers.push_back(answer_of(c, q));
    fuzz::Truth truth(c.scene);
    const auto judged = fuzz::judge(c, core_card(), observed, truth);
    for (std::size_t k = 0; k < judged.size(); ++k) {
      if (!is_pair_question(c.queries[k].question)) continue;
      ++r.answers;
      r.unanswered += observed.answers[k].outcome != Outcome::answered;
      r.undecided += judged[k].undecided;
      r.not_judged += !judged[k].unjudged.empty();
      for (const FaultReport& f : judged[k].faults) {
        ++r.wrong;
        UNSCOPED_INFO(text_of(c) << " " << static_cast<int>(c.queries[k].question) << ": " << f.words);
      }
    }
  }
  return r;
}

}  // namespace

TEST_CASE("the core is right about random solids", "[solid]") {
  const Tally t = judge_core(1, 150);
  CHECK(t.wrong == 0);
  CHECK(t.answers > 300);
  CHECK(t.undecided <= t.answers / 50);
  INFO(t.answers << " answers, " << t.not_judged << " not judged, " << t.undecided << " undecided, "
                 << t.unanswered << " unanswered");
  CHECK(t.unanswered <= t.answers / 20);
}

TEST_CASE("a shorter way out is found where no face of the parts that meet points to it", "[solid]") {
  // A polygon that dips into a solid: all ways that pass whole triangles are 0.0126 long or longer.
  const Case c = fuzz::make_case(20261127, 45472, "surfaces,solids,mesh");
  REQUIRE(c.scene.bodies.size() == 2);
  const PlacedShape a(&c.scene.shape_of(0), c.scene.bodies[0].pose);
  const PlacedShape b(&c.scene.shape_of(1), c.scene.bodies[1].pose);
  const ContactAnswer found = contact(a, b);
  REQUIRE(found.outcome == Outcome::answered);
  REQUIRE(found.overlap);
  CHECK(found.depth < 0.009);
  CHECK(found.depth > 0.007);
}

TEST_CASE("the core is right about many random solids", "[.many]") {
  const char* const count = std::getenv("TOUCHSTONE_SOLID_CASES");
  const auto cases = static_cast<std::uint64_t>(count ? std::atoi(count) : 5000);
  const Tally t = judge_core(2, cases);
  CHECK(t.wrong == 0);
  WARN(t.answers << " answers, " << t.not_judged << " not judged, " << t.undecided << " undecided, "
                 << t.unanswered << " unanswered");
}
