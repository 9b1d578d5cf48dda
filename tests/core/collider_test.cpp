// A collider: what it has prepared, and that answers about it are those about the shape as it is.
#include "core/narrow/collider.h"

#include "core/impact/impact.h"
#include "core/narrow/narrow_phase.h"
#include "core/narrow/wide_answer.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

// One of each kind. The hull has a graph, the mesh vertices that belong to no triangle.
std::vector<Shape> one_of_each(Rng& r) {
  std::vector<Shape> all;
  for (int k = 0; k < shape_kind_count; ++k) {
    Shape s = shape_of_kind(static_cast<ShapeKind>(k));
    if (std::holds_alternative<RoundedBox>(s))
      s = RoundedBox{{0.5, 0.75, 0.25}, 0.125};
    else if (k >= static_cast<int>(ShapeKind::padded_cylinder))
      s = *padded(std::array<Shape, 4>{Cylinder{0.5, 0.75}, Cone{0.75, 0.5}, Ellipsoid{Vec3(0.25, 0.5, 1)},
                                       make_hull({{1, 0, 0}, {-1, 0, 0.5}, {0, 1, 0}, {0, 0, 1}})}
                      [static_cast<std::size_t>(k) - static_cast<std::size_t>(ShapeKind::padded_cylinder)],
                  0.125);
    else if (is_convex(kind_of(s)))
      s = random_shape(r, static_cast<ShapeKind>(k), false);
    if (std::holds_alternative<Hull>(s)) {
      std::vector<Vec3> v;
      for (int i = 0; i < 300; ++i) v.push_back(r.unit_vector());
      s = make_hull(std::move(v));
    }
    if (auto* h = std::get_if<HalfSpace>(&s)) *h = {Vec3(1, 2, -2), 0.75};
    if (std::holds_alternative<SolidMesh>(s))
      s = SolidMesh(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
    if (auto* m = std::get_if<TriangleMesh>(&s)) {
      m->vertices = {{9, 9, 9}, {-1, -1, 0}, {1, -1, 0.25}, {0, 1, 0.5}, {0, 0, 1}, {-7, 0, 0}};
      m->triangles = {{1, 2, 3}, {1, 2, 4}, {2, 3, 4}};
    }
    all.push_back(std::move(s));
  }
  return all;
}

// Leaves the byte all over the part of the stack that the next calls use.
[[gnu::noinline]] void fill_stack(unsigned char byte) {
  volatile unsigned char room[1 << 16];
  for (volatile unsigned char& x : room) x = byte;
}

bool same(const OverlapAnswer& x, const OverlapAnswer& y) {
  return x.outcome == y.outcome && x.overlap == y.overlap && x.error_bound == y.error_bound;
}

bool same(const DistanceAnswer& x, const DistanceAnswer& y) {
  return x.outcome == y.outcome && x.distance == y.distance && x.normal == y.normal &&
         x.witness == y.witness && x.error_bound == y.error_bound;
}

bool same(const ContactAnswer& x, const ContactAnswer& y) {
  if (!(x.outcome == y.outcome && x.overlap == y.overlap && x.normal == y.normal && x.depth == y.depth &&
        x.error_bound == y.error_bound && x.regret_bound == y.regret_bound &&
        x.manifold.size() == y.manifold.size()))
    return false;
  for (std::size_t i = 0; i < x.manifold.size(); ++i)
    if (x.manifold[i].position != y.manifold[i].position || x.manifold[i].depth != y.manifold[i].depth)
      return false;
  return true;
}

bool same(const ImpactAnswer& x, const ImpactAnswer& y) {
  return x.outcome == y.outcome && x.toi == y.toi && x.separation == y.separation &&
         x.clear_until == y.clear_until && x.normal_ab == y.normal_ab && x.witness_w == y.witness_w &&
         x.steps == y.steps;
}

}  // namespace

TEST_CASE("collider: every answer is that about the shape as it is", "[narrow][collider]") {
  Rng r(20);
  long overlaps = 0, impacts = 0, unsupported = 0, pairs = 0;
  for (int round = 0; round < 3; ++round) {
    const std::vector<Shape> shapes = one_of_each(r);
    std::vector<Collider> colliders;
    for (const Shape& s : shapes) colliders.emplace_back(s);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t k = 0; k < shapes.size(); ++k) {
        INFO(type_name(shapes[i]) << " and " << type_name(shapes[k]) << ", round " << round);
        ++pairs;
        const Pose pa{r.unit_vector(), r.rotation()}, pb{r.unit_vector() * r.uniform(0, 3), r.rotation()};
        const PlacedShape a{&shapes[i], pa}, b{&shapes[k], pb}, ca = colliders[i].at(pa),
                                                                cb = colliders[k].at(pb);
        for (const Arithmetic f : {Arithmetic::float64, Arithmetic::float64_alone, Arithmetic::float32}) {
          CHECK(same(overlap(a, b, f), overlap(ca, cb, f)));
          CHECK(same(distance(a, b, f), distance(ca, cb, f)));
          CHECK(same(contact(a, b, f), contact(ca, cb, f)));
        }
        CHECK(same(narrow::wide_distance(a, b), narrow::wide_distance(ca, cb)));
        CHECK(same(narrow::wide_contact(a, b), narrow::wide_contact(ca, cb)));
        overlaps += overlap(ca, cb).overlap;
        const auto motion = [&](std::size_t of) {
          return is_convex(kind_of(shapes[of])) ? Motion{r.unit_vector() * 3, r.unit_vector()} : Motion{};
        };
        const Motion ma = motion(i), mb = motion(k);
        const ImpactAnswer x = time_of_impact({&shapes[i], pa, ma}, {&shapes[k], pb, mb});
        CHECK(same(x, time_of_impact(colliders[i].at(pa, ma), colliders[k].at(pb, mb))));
        impacts += x.toi && *x.toi > 0;
        unsupported += x.outcome == Outcome::unsupported;
      }
  }
  CHECK((overlaps > 40 && overlaps < pairs - 40));
  CHECK(impacts > 20);
  // Two half-spaces.
  CHECK(unsupported == 3);
}

TEST_CASE("collider: every pair of which one body moves has a time of impact", "[impact][collider]") {
  Rng r(21);
  const std::vector<Shape> shapes = one_of_each(r);
  const Motion slide{Vec3(0.25, 0, 0), Vec3::Zero()};
  for (const Shape& x : shapes)
    for (const Shape& y : shapes) {
      INFO(type_name(x) << " and " << type_name(y));
      const Outcome moving_x = time_of_impact({&x, {Vec3(-20, 0, 0), {}}, slide}, {&y, {}, {}}).outcome;
      const Outcome moving_y = time_of_impact({&x, {Vec3(-20, 0, 0), {}}, {}}, {&y, {}, slide}).outcome;
      const auto expected = [](const Shape& moved) {
        return kind_of(moved) == ShapeKind::half_space ? Outcome::unsupported : Outcome::answered;
      };
      CHECK(moving_x == expected(x));
      CHECK(moving_y == expected(y));
    }
}

TEST_CASE("collider: a time of impact depends on nothing that the stack held before", "[impact][collider]") {
  Rng r(23);
  const std::vector<Shape> shapes = one_of_each(r);
  for (const Shape& a : shapes)
    for (const Shape& b : shapes) {
      if (!is_convex(kind_of(a))) continue;
      INFO(type_name(a) << " and " << type_name(b));
      const Motion m{r.unit_vector() * 3, r.unit_vector()};
      const Pose at{r.unit_vector() * 4, r.rotation()};
      std::vector<ImpactAnswer> answers;
      for (const unsigned char byte : {0x00, 0xff, 0x7f}) {  // 0xff: NaNs, 0x7f: large numbers
        fill_stack(byte);
        answers.push_back(time_of_impact({&a, at, m}, {&b, {}, {}}));
      }
      CHECK(same(answers[0], answers[1]));
      CHECK(same(answers[0], answers[2]));
    }
}

TEST_CASE("collider: it survives a move, with what it has prepared", "[narrow][collider]") {
  Rng r(22);
  const std::vector<Shape> shapes = one_of_each(r);
  const Pose pose{Vec3(0.5, 0.25, 1), r.rotation()};
  const Shape ball = Sphere{0.5};
  for (const Shape& s : shapes) {
    INFO(type_name(s));
    Collider first(s);
    const DistanceAnswer before = distance(first.at(pose), {&ball, {}});
    const Collider second(std::move(first));
    CHECK(same(before, distance(second.at(pose), {&ball, {}})));
    CHECK(&second.shape() == &s);
    CHECK(second.bounding_radius() == bounding_radius(s));
  }
  const auto of = [&](ShapeKind k) -> const Shape& { return shapes[static_cast<std::size_t>(k)]; };
  const Collider mesh(of(ShapeKind::mesh)), hull(of(ShapeKind::hull));
  REQUIRE(mesh.tree());
  CHECK(mesh.used_vertices().size() == 4);
  CHECK(mesh.largest_length() == 1);
  CHECK(hull.tree() == nullptr);
  const auto graph_of = [](const Collider& c) {
    return std::get<convex::VerticesCore<double>>(c.body<double>().core).graph;
  };
  CHECK(graph_of(hull) != nullptr);
  CHECK(graph_of(Collider(hull.shape(), Collider::no_graph)) == nullptr);
}
