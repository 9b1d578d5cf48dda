// A convex body against a mesh: the same with and without a tree, and as the referee judges it by triangle.
#include "core/narrow/mesh_tree.h"
#include "core/narrow/pair_table.h"
#include "core/tolerance.h"
#include "oracles/referee/referee.h"
#include "tests/core/random_pair.h"
#include "tests/support/catch.h"
#include "tests/support/plain_shape.h"

using namespace touchstone;
using namespace touchstone::test;

namespace {

// A hilly field of 2·n² triangles over [−3, 3]².
TriangleMesh field(Rng& r, int n) {
  TriangleMesh m;
  const double step = 6.0 / n;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) m.vertices.push_back({x * step - 3, y * step - 3, r.uniform(-0.3, 0.3)});
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int k = y * (n + 1) + x;
      m.triangles.push_back({k, k + 1, k + n + 1});
      m.triangles.push_back({k + 1, k + n + 2, k + n + 1});
    }
  return m;
}

Shape body(Rng& r, int kind) {
  return plain_shape(r, static_cast<ShapeKind>(kind), [](Rng& q, auto&& size) {
    std::vector<Vec3> v;
    for (int i = 0; i < 12; ++i) v.push_back(q.unit_vector() * size());
    return make_hull(std::move(v));
  });
}

struct MeshCase {
  Shape a, mesh;
  Pose pose_a, pose_mesh;
};

MeshCase mesh_case(int i, int kind, int n) {
  Rng r = Rng::stream(91, static_cast<std::uint64_t>(i * 7 + kind));
  MeshCase c{body(r, kind), field(r, n), {}, {}};
  c.pose_a.rotation = r.rotation();
  c.pose_mesh.rotation = r.rotation();
  c.pose_mesh.translation = r.unit_vector() * 5;
  const Vec3 local(r.uniform(-2.5, 2.5), r.uniform(-2.5, 2.5), r.uniform(-2, 2));
  c.pose_a.translation = rotation_matrix(c.pose_mesh.rotation) * local + c.pose_mesh.translation;
  return c;
}

}  // namespace

TEST_CASE("a mesh tree contains every triangle once, inside its boxes", "[narrow][mesh]") {
  for (const int n : {0, 1, 2, 7}) {
    Rng r = Rng::stream(90, static_cast<std::uint64_t>(n));
    const TriangleMesh m = field(r, n);
    const MeshTree tree = build_mesh_tree(m);
    CHECK(tree.oriented.size() == tree.nodes.size());
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const OrientedBox& box = tree.oriented[i];
      CHECK((box.axes.transpose() * box.axes - Mat3::Identity()).norm() < 1e-14);
      CHECK((box.half.array() >= 0).all());
    }
    std::vector<int> seen(m.triangles.size(), 0);
    for (const MeshTree::Node& node : tree.nodes)
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        const auto t = static_cast<std::size_t>(tree.order[static_cast<std::size_t>(i)]);
        ++seen[t];
        for (const int k : m.triangles[t]) {
          const Vec3& v = m.vertices[static_cast<std::size_t>(k)];
          CHECK(((v.array() >= node.lo.array()) && (v.array() <= node.hi.array())).all());
          const OrientedBox& box = tree.oriented[static_cast<std::size_t>(&node - tree.nodes.data())];
          CHECK(((box.axes.transpose() * (v - box.centre)).cwiseAbs() - box.half).maxCoeff() < 1e-14);
        }
      }
    for (const int s : seen) CHECK(s == 1);
  }
}

TEST_CASE("a contact on a flat part of a mesh is that of its plane", "[narrow][mesh]") {
  int sideways = 0;
  for (int i = 0; i < 60; ++i) {
    Rng r = Rng::stream(92, static_cast<std::uint64_t>(i));
    TriangleMesh floor = field(r, 24);
    for (Vec3& v : floor.vertices) v.z() = 0;
    const Shape mesh = floor, plate = Box{{0.02, 0.5, 0.5}};
    const Pose pose{r.unit_vector() * 3, r.rotation()};
    const Mat3 turn = rotation_matrix(pose.rotation);
    const double depth = r.uniform(0.15, 0.45);
    const Vec3 local(r.uniform(-1, 1), r.uniform(-1, 1), 0.5 - depth);
    const Pose upright{turn * local + pose.translation, pose.rotation};
    const Collider prepared(mesh);
    const PlacedShape body{&plate, upright};
    const ContactAnswer k = contact(prepared.at(pose), body), mirrored = contact(body, {&mesh, pose});
    REQUIRE(k.overlap);
    CHECK(k.normal.dot(turn.col(2)) > 1 - 1e-14);
    CHECK(std::abs(k.depth - depth) < 1e-14);
    CHECK(k.error_bound < 1e-13);
    CHECK(mirrored.normal.dot(turn.col(2)) < -1 + 1e-14);
    CHECK(std::abs(mirrored.depth - depth) < 1e-14);
    // The deepest triangle alone is left sideways.
    sideways += std::abs(distance(body, {&mesh, pose}).normal.dot(turn.col(2))) < 0.5;

    // Near the border the plate leaves the floor sideways.
    const Pose at_border{turn * Vec3(-2.99, local.y(), 0) + pose.translation, pose.rotation};
    CHECK(std::abs(contact(prepared.at(pose), {&plate, at_border}).normal.dot(turn.col(0))) > 1 - 1e-14);
  }
  CHECK(sideways == 60);
}

TEST_CASE("a body against a mesh: the same with a tree, and in agreement with the referee",
          "[narrow][mesh]") {
  long overlaps = 0, cases = 0, fast = 0;
  for (int i = 0; i < 8; ++i)
    for (int kind = 0; kind < 7; ++kind) {
      const MeshCase c = mesh_case(i, kind, i < 4 ? 3 : 6);
      INFO(type_name(c.a) << " round " << i);
      const auto& mesh = std::get<TriangleMesh>(c.mesh);
      const Collider prepared(c.mesh);
      const PlacedShape a{&c.a, c.pose_a}, plain{&c.mesh, c.pose_mesh}, b = prepared.at(c.pose_mesh);
      Scene scene;
      scene.shapes = {c.a, c.mesh};
      scene.bodies.resize(2);
      scene.bodies[0].shape = 0;
      scene.bodies[0].pose = c.pose_a;
      scene.bodies[1].shape = 1;
      scene.bodies[1].pose = c.pose_mesh;
      const double tau = tolerance::core_tau_factor * 0x1p-53 * scale_of_pair(scene, 0, 1);
      narrow::FastAnswer<double> f;
      narrow::separate_fast<double>(a, b, narrow::filtered::Asked::distance, f);
      fast += f.answer.found != narrow::filtered::Found::unsure;

      // Truth for the surface: the minimum over its triangles, each a hull of three vertices.
      double lo = std::numeric_limits<double>::infinity(), hi = lo;
      for (const auto& t : mesh.triangles) {
        std::vector<Vec3> v;
        for (const int k : t) v.push_back(mesh.vertices[static_cast<std::size_t>(k)]);
        const Shape triangle = make_hull(std::move(v));
        const auto truth = referee::judge_pair({&c.a, c.pose_a}, {&triangle, c.pose_mesh});
        lo = std::min(lo, truth.gap.lo);
        hi = std::min(hi, truth.gap.hi);
      }
      ++cases;
      overlaps += hi < 0;
      for (const PlacedShape& m : {plain, b}) {
        const DistanceAnswer d = distance(a, m);
        REQUIRE(d.outcome == Outcome::answered);
        CHECK(d.distance >= lo - tau);
        CHECK(d.distance <= hi + tau);
        CHECK(std::abs((d.witness[1] - d.witness[0]).norm() - std::abs(d.distance)) <= tau);
        if (lo > tau || hi < -tau) CHECK(overlap(a, m).overlap == (hi < 0));
        const ContactAnswer k = contact(m, a);
        if (lo > tau || hi < -tau) CHECK(k.overlap == (hi < 0));
        if (!k.overlap) continue;
        CHECK(k.depth >= -hi - tau);
        CHECK(k.depth <= -lo + tau);
        REQUIRE(k.manifold.size() == 1);
        CHECK(referee::distance_to({&c.a, c.pose_a}, k.manifold[0].position).lo <= k.depth + tau);
      }
    }
  WARN(cases << " cases, " << overlaps << " overlap, " << fast << " without extended precision");
  CHECK(overlaps * 10 > cases * 3);
  CHECK(overlaps * 10 < cases * 7);
  CHECK(fast * 10 > cases * 9);
}
