// Every built engine on pairs with obvious answers: overlap, distance, contact, in both orders of the
// arguments, and the scene as received.
#include "tests/oracles/conformance.h"
#include "core/math/through_float.h"

using namespace touchstone;
using namespace touchstone::testing;

namespace {

struct Row {
  const char* what;
  Scene scene;
  double gap;   // < 0: minus the depth
  Vec3 normal;  // A to B
};

Hull unit_cube_from_corner() {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i) v.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
  return make_hull(v);
}

TriangleMesh square_at_zero() {
  return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

Scene turned_box() {
  // A quarter turn about z, as a quaternion of length 2.83: the box's x axis lies along y.
  Scene s = pair_scene(Box{Vec3(1, 0.2, 0.2)}, Sphere{0.2}, Vec3(0, 1.1, 0));
  s.bodies[0].pose.rotation = {0, 0, 2, 2};
  return s;
}

std::vector<Row> rows() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Box box{Vec3(1, 0.5, 0.25)};
  const Ellipsoid egg{Vec3(1, 0.5, 0.25)};
  return {
      {"spheres overlap", pair_scene(Sphere{1}, Sphere{0.5}, Vec3(1.2, 0, 0)), -0.3, x},
      {"spheres apart", pair_scene(Sphere{1}, Sphere{0.5}, Vec3(0, -3, 0)), 1.5, -y},
      {"boxes overlap in y: half extents, not sides", pair_scene(box, box, Vec3(0.13, 0.9, 0.07)), -0.1, y},
      {"boxes apart in x", pair_scene(box, box, Vec3(2.5, 0, 0)), 0.5, x},
      {"boxes apart in z", pair_scene(box, box, Vec3(0, 0, -1)), 0.5, -z},
      {"a capsule lies along z", pair_scene(Capsule{0.5, 1}, Sphere{0.5}, Vec3(0, 0, 1.9)), -0.1, z},
      {"a capsule is thin along y", pair_scene(Capsule{0.5, 1}, Sphere{0.5}, Vec3(0, 1.9, 0)), 0.9, y},
      {"capsules side by side", pair_scene(Capsule{0.5, 1}, Capsule{0.5, 1}, Vec3(1.25, 0, 0.5)), 0.25, x},
      {"a cylinder ends at its half height", pair_scene(Cylinder{0.5, 1}, Sphere{0.5}, Vec3(0.1, 0, 1.4)),
       -0.1, z},
      {"a cylinder is round about z", pair_scene(Cylinder{0.5, 1}, Sphere{0.5}, Vec3(0, 1.9, 0.2)), 0.9, y},
      {"a cylinder's wall", pair_scene(Cylinder{0.5, 2}, Sphere{0.5}, Vec3(0.9, 0, 0.2)), -0.1, x},
      {"a cone's base is below", pair_scene(Cone{1, 1}, Sphere{0.25}, Vec3(0.1, 0, -1.15)), -0.1, -z},
      {"a cone's apex is above", pair_scene(Cone{1, 1}, Sphere{0.25}, Vec3(0, 0, 1.5)), 0.25, z},
      {"a cone is narrow at the top", pair_scene(Cone{1, 1}, Sphere{0.25}, Vec3(0.9, 0, 0.9)),
       1.7 / std::sqrt(5.0) - 0.25, Vec3(2, 0, 1) / std::sqrt(5.0)},
      {"a hull is where its vertices are",
       pair_scene(unit_cube_from_corner(), Sphere{0.25}, Vec3(0.5, 0.5, 1.15)), -0.1, z},
      {"a hull apart", pair_scene(unit_cube_from_corner(), Sphere{0.25}, Vec3(-1, 0.5, 0.5)), 0.75, -x},
      {"two hulls", pair_scene(unit_cube_from_corner(), unit_cube_from_corner(), Vec3(0, 1.5, 0)), 0.5, y},
      {"an ellipsoid has semi-axes", pair_scene(egg, Sphere{0.25}, Vec3(1.15, 0, 0)), -0.1, x},
      {"an ellipsoid apart", pair_scene(egg, Sphere{0.25}, Vec3(0, 0, 0.6)), 0.1, z},
      {"a half-space is solid below, its normal any length",
       pair_scene(HalfSpace{Vec3(0, 0, 2), 0.5}, Sphere{0.5}, Vec3(3, 4, 0.65)), -0.1, z},
      {"above a half-space", pair_scene(HalfSpace{Vec3(0, 0, 2), 0.5}, Sphere{0.5}, Vec3(3, 4, 1)), 0.25, z},
      {"a box in a half-space", pair_scene(HalfSpace{Vec3(0, 0, 1), 0}, box, Vec3(1, 1, 0.15)), -0.1, z},
      {"a sphere on a mesh", pair_scene(square_at_zero(), Sphere{0.5}, Vec3(0.3, 0.1, 0.4)), -0.1, z},
      {"a sphere above a mesh", pair_scene(square_at_zero(), Sphere{0.5}, Vec3(0.3, 0.1, 0.75)), 0.25, z},
      {"a box above a mesh", pair_scene(square_at_zero(), box, Vec3(0.3, 0.1, 0.5)), 0.25, z},
      {"a capsule above a mesh", pair_scene(square_at_zero(), Capsule{0.25, 0.5}, Vec3(0.3, 0.1, 1)), 0.25,
       z},
      {"a hull beside a mesh", pair_scene(square_at_zero(), unit_cube_from_corner(), Vec3(1.5, -0.5, -0.5)),
       0.5, x},
      {"a box in a mesh", pair_scene(square_at_zero(), box, Vec3(0.3, 0.1, 0.15)), -0.1, z},
      {"a turned box, not a unit quaternion", turned_box(), -0.1, y},
  };
}

// Where only a round edge or corner is that far away, too.
std::vector<Row> padded_rows() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), slanted(0.6, 0, 0.8),
             skew = Vec3(2, 3, 6) / 7;
  const Padded<Cylinder> can{{0.5, 1}, 0.25};
  const Padded<Hull> cube{unit_cube_from_corner(), 0.25};
  const Sphere ball{0.25};
  return {
      {"a padded cylinder's end", pair_scene(can, ball, Vec3(0.1, 0, 1.4)), -0.1, z},
      {"a padded cylinder's rim is round", pair_scene(can, ball, Vec3(0.5, 0, 1) + slanted), 0.5, slanted},
      {"a padded cylinder's rim overlaps", pair_scene(can, ball, Vec3(0.5, 0, 1) + 0.4 * slanted), -0.1,
       slanted},
      {"a padded cone's apex is round", pair_scene(Padded<Cone>{{1, 1}, 0.25}, ball, Vec3(0, 0, 1.75)), 0.25,
       z},
      {"a padded hull's edge is round", pair_scene(cube, ball, Vec3(1, 0.5, 1) + slanted), 0.5, slanted},
      {"two padded hulls overlap", pair_scene(cube, cube, Vec3(0.1, 1.4, 0.1)), -0.1, y},
      {"a rounded box's corner",
       pair_scene(RoundedBox{Vec3(1, 0.5, 0.25), 0.25}, ball, Vec3(1, 0.5, 0.25) + skew), 0.5, skew},
      {"a padded ellipsoid", pair_scene(Padded<Ellipsoid>{{Vec3(1, 0.5, 0.25)}, 0.25}, ball, Vec3(1.4, 0, 0)),
       -0.1, x},
  };
}

bool is_padded(const Scene& s) {
  return std::ranges::any_of(s.shapes, [](const Shape& x) { return kind_of(x) > last_common_shape; });
}

bool pair_has(const Scene& s, ShapeKind k) { return kind_of(s.shapes[0]) == k || kind_of(s.shapes[1]) == k; }

/// Questions that the engine does not support at all.
bool must_be_unsupported(const Subject& s, const Row& row, Question q) {
  if (s.is("fcl") && is_padded(row.scene)) return q == Question::contact;
  const bool unbounded = pair_has(row.scene, ShapeKind::half_space) || pair_has(row.scene, ShapeKind::mesh);
  if (s.is("libccd")) return q == Question::distance || unbounded;
  if (s.is("bullet"))
    return pair_has(row.scene, ShapeKind::ellipsoid) || pair_has(row.scene, ShapeKind::padded_ellipsoid) ||
           (s.has("-sim") && q == Question::distance);
  return false;
}

/// Questions on which the engine is known to be wrong, or to end the worker.
bool is_known_defect(const Subject& s, const Row& row, Question q) {
  if (!s.is("fcl")) return false;
  const bool half_space = pair_has(row.scene, ShapeKind::half_space);
  const bool mesh = pair_has(row.scene, ShapeKind::mesh), sphere = pair_has(row.scene, ShapeKind::sphere);
  // fcl::distance: null support function, or the distance to a point of the plane. The signed distance of
  // meshes is a workaround by collide, and the nearest points of a sphere and a mesh are each in their own
  // body's frame. INDEP aborts on every overlap of a pair without a closed form.
  if (q == Question::distance)
    return half_space || (mesh && (sphere || row.gap < 0)) || (s.is("fcl-indep") && row.gap < 0);
  // INDEP leaves normals in A's frame and negates depths; collide's sphere-triangle depth is negative.
  return q == Question::contact && row.gap < 0 && (s.is("fcl-indep") || (mesh && sphere));
}

/// Wide enough for MPR without a centre line, float arithmetic and documented margins, but not for a wrong
/// convention.
double tolerance(const Observation& o) { return 0.02 + 2 * o.claimed_tolerance; }

/// The whole row rotated and translated: GJK and EPA are known to fail on aligned shapes at the origin, and a
/// vector left in a body's own frame shows only here.
Row placed(const Row& row) {
  const Pose frame{Vec3(0.4, -0.3, 0.2), normalized({0.11, 0.23, -0.31, 0.9})};
  Row r = row;
  for (Body& b : r.scene.bodies) {
    b.pose.translation = to_transform(frame) * b.pose.translation;
    b.pose.rotation = frame.rotation * b.pose.rotation;
  }
  r.normal = rotation_matrix(frame.rotation) * row.normal;
  return r;
}

Row swapped(const Row& row) {
  Row r = row;
  std::swap(r.scene.bodies[0], r.scene.bodies[1]);
  r.normal = -row.normal;
  return r;
}

void check_distance(const Observation& o, const Row& row) {
  if (!o.distance) {  // an overlap without a depth
    CHECK(o.overlap == (row.gap < 0));
    return;
  }
  CHECK(std::abs(*o.distance - row.gap) <= tolerance(o));
  REQUIRE(o.witness);
  if (row.gap < 0) return;
  const Vec3 across = (*o.witness)[1] - (*o.witness)[0];
  CHECK((across - row.gap * row.normal).norm() <= tolerance(o) + 0.02);
}

void check_contact(const Observation& o, const Row& row) {
  REQUIRE(o.overlap.has_value());
  CHECK(*o.overlap == (row.gap < 0));
  if (row.gap >= 0 || !*o.overlap) return;
  REQUIRE((o.normal && o.depth));
  CHECK(std::abs(o.normal->norm() - 1) < 1e-5);
  CHECK(o.normal->dot(row.normal) > 0.98);
  CHECK(std::abs(*o.depth + row.gap) <= tolerance(o));
  CHECK_FALSE(o.manifold.empty());
}

struct Count {
  int checked = 0, unsupported = 0, defects = 0;
};

void check_row(Subject& s, const Row& row, Count& count) {
  for (const Question q : {Question::overlap, Question::distance, Question::contact}) {
    INFO("engine " << s.name << ", " << to_string(q) << ": " << row.what);
    if (is_known_defect(s, row, q)) {
      ++count.defects;
      continue;
    }
    const Observation o = ask(s, case_of(row.scene, {{q, 0, 1}})).answers[0];
    INFO("outcome " << to_string(o.outcome) << " " << o.detail);
    INFO("overlap " << o.overlap.value_or(false) << " distance " << o.distance.value_or(99) << " depth "
                    << o.depth.value_or(99) << " normal " << o.normal.value_or(Vec3::Zero()).transpose());
    if (must_be_unsupported(s, row, q)) {
      CHECK(o.outcome == Outcome::unsupported);
      ++count.unsupported;
      continue;
    }
    ++count.checked;
    CHECK(o.outcome == Outcome::answered);
    if (o.outcome != Outcome::answered) continue;
    CHECK(o.claimed_tolerance >= 0);
    CHECK(o.claimed_tolerance <= 0.2);
    if (q == Question::overlap) CHECK(o.overlap == (row.gap < 0));
    if (q == Question::distance) check_distance(o, row);
    if (q == Question::contact) check_contact(o, row);
  }
}

}  // namespace

TEST_CASE("simple pairs have the obvious answers in both orders", "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  Count count;
  const int engines = for_each_engine([&](Subject s) {
    for (const Row& row : rows()) {
      check_row(s, placed(row), count);
      check_row(s, swapped(placed(row)), count);
    }
  });
  INFO("checked " << count.checked << ", unsupported " << count.unsupported << ", known defects "
                  << count.defects);
  CHECK(engines == static_cast<int>(built_plugins().size()) * 4);
  // Of 150 questions per engine, the most limited one (libccd) answers 80.
  CHECK(count.checked >= 80 * engines);
}

TEST_CASE("padded shapes have round edges, as far away as they should be",
          "[oracles][conformance][optional]") {
  Count count;
  int engines = 0;
  for_each_engine([&](Subject s) {
    if (s.engine.card().more_shapes.empty()) return;
    ++engines;
    for (const Row& row : padded_rows()) {
      check_row(s, placed(row), count);
      check_row(s, swapped(placed(row)), count);
    }
    const Scene scene = padded_rows()[0].scene;
    const auto received = ask(s, case_of(scene, {{Question::overlap, 0, 1}})).received;
    REQUIRE(received.shapes[0]);
    const auto* held = std::get_if<Padded<Cylinder>>(&*received.shapes[0]);
    REQUIRE(held);
    CHECK(held->inner.radius == Approx(0.5));
    CHECK(held->inner.half_height == Approx(1));
    CHECK(held->padding == Approx(0.25));
  });
  if (engines == 0) return test::skip("no engine that takes padded shapes is built in");
  CHECK(count.checked >= 16 * engines);
}

TEST_CASE("engines report the scene that they hold", "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  int bodies = 0, shapes = 0;
  for_each_engine([&](Subject s) {
    INFO("engine " << s.name);
    const double u = s.is_float() ? 0x1p-24 : 0x1p-53;
    for (Row row : rows()) {
      row.scene.bodies[0].pose = {Vec3(1.0 / 3, -2.0 / 7, 1e3 / 9), Quat{0.3, -0.2, 0.7, 1.9}};
      const auto received = ask(s, case_of(row.scene, {{Question::overlap, 0, 1}})).received;
      INFO(row.what);
      for (std::size_t i = 0; i < 2; ++i) {
        const Pose& asked = row.scene.bodies[i].pose;
        REQUIRE(received.bodies[i]);
        CHECK((received.bodies[i]->matrix - rotation_matrix(asked.rotation)).cwiseAbs().maxCoeff() <= 8 * u);
        CHECK((received.bodies[i]->translation - asked.translation).cwiseAbs().maxCoeff() <= 1e3 / 9 * u);
        ++bodies;
        if (s.is("bullet") && kind_of(row.scene.shapes[i]) == ShapeKind::ellipsoid) continue;
        REQUIRE(received.shapes[i]);
        REQUIRE(received.shapes[i]->index() == row.scene.shapes[i].index());
        ++shapes;
      }
    }
  });
  CHECK(bodies >= 50 * 4);
  CHECK(shapes >= 46 * 4);
}

TEST_CASE("received shapes equal the given ones up to the engine's rounding",
          "[oracles][conformance][optional]") {
  if (built_plugins().empty()) return test::skip("no engine is built in");
  const double third = 1.0 / 3;
  Hull hull = unit_cube_from_corner();
  for (Vec3& v : hull.vertices) v *= third;
  TriangleMesh mesh = square_at_zero();
  for (Vec3& v : mesh.vertices) v *= third;
  const std::vector<Shape> shapes{Sphere{third},
                                  Box{Vec3(third, 2 * third, 0.7)},
                                  Capsule{third, 0.7},
                                  Cylinder{third, 0.7},
                                  Cone{third, 0.7},
                                  Ellipsoid{Vec3(third, 0.7, 0.1)},
                                  make_hull(hull.vertices),
                                  HalfSpace{Vec3(0.6, 0.8, 0), third},
                                  mesh};
  int compared = 0;
  for_each_engine([&](Subject s) {
    INFO("engine " << s.name);
    const double u = s.is_float() ? 0x1p-24 : 0x1p-53;
    Scene scene;
    scene.shapes = shapes;
    for (int i = 0; i < static_cast<int>(shapes.size()); ++i)
      scene.bodies.push_back(at(i, Vec3(3 * i, 0, 0)));
    const auto received = ask(s, case_of(scene, {{Question::overlap, 0, 1}})).received;
    const auto near = [&](double a, double b) {
      CHECK(std::abs(a - b) <= 4 * u);
      ++compared;
    };
    const auto near3 = [&](const Vec3& a, const Vec3& b) {
      for (int k = 0; k < 3; ++k) near(a[k], b[k]);
    };
    const auto got = [&]<class T>(const T&, std::size_t i) -> const T& {
      return std::get<T>(*received.shapes[i]);
    };
    near(got(Sphere{}, 0).radius, third);
    near3(got(Box{}, 1).half_extents, Vec3(third, 2 * third, 0.7));
    near(got(Capsule{}, 2).radius, third);
    near(got(Capsule{}, 2).half_height, 0.7);
    near(got(Cylinder{}, 3).radius, third);
    near(got(Cylinder{}, 3).half_height, 0.7);
    near(got(Cone{}, 4).radius, third);
    near(got(Cone{}, 4).half_height, 0.7);
    if (!s.is("bullet")) near3(got(Ellipsoid{}, 5).semi_axes, Vec3(third, 0.7, 0.1));
    for (std::size_t v = 0; v < 8; ++v) near3(got(Hull{}, 6).vertices[v], hull.vertices[v]);
    near3(got(HalfSpace{}, 7).normal, Vec3(0.6, 0.8, 0));
    near(got(HalfSpace{}, 7).offset, third);
    for (std::size_t v = 0; v < 4; ++v) near3(got(TriangleMesh{}, 8).vertices[v], mesh.vertices[v]);
    CHECK(got(TriangleMesh{}, 8).triangles == mesh.triangles);
    if (s.is_float()) CHECK(got(Sphere{}, 0).radius == through_float(third));
  });
  CHECK(compared >= 20 * 4);
}
