// glTF with KHR_implicit_shapes and KHR_physics_rigid_bodies: shapes, places, filters, and what is refused.
#include "scenarios/codec/scene_codec.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/model_check.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

const Body& at(const Scene& s, const std::string& name) {
  return s.bodies[static_cast<std::size_t>(test::body(s, name))];
}
template <class S>
const S& shape(const Scene& s, const std::string& name) {
  return std::get<S>(s.shapes[static_cast<std::size_t>(at(s, name).shape)]);
}
Vec3 y_axis(const Body& b) { return rotation_matrix(b.pose.rotation) * Vec3::UnitZ(); }

bool are_asked(const Scene& s, const std::string& a, const std::string& b) {
  return !is_filtered(s, test::body(s, a), test::body(s, b));
}

Scene yard(const std::string& file) { return scene_of(import_model(test::model_file("gltf/" + file), {})); }

// A file with one node that has a collider, and shapes.
std::string refused(const std::string& node, const std::string& shapes = "", const std::string& more = "") {
  const test::TempDir dir;
  const auto file = dir.write(
      "a.gltf", "{\"asset\":{\"version\":\"2.0\"},\n\"extensions\":{\"KHR_implicit_shapes\":{\"shapes\":[" +
                    shapes + "]}},\n\"nodes\":[{" + node + "}]" + more + "}");
  return refusal([&] { import_model(file, {}); });
}
std::string collider(const std::string& geometry) {
  return "\"extensions\":{\"KHR_physics_rigid_bodies\":{\"collider\":{\"geometry\":{" + geometry + "}}}}";
}

}  // namespace

TEST_CASE("the shapes and bodies of a glTF file are those of its physics extensions", "[import]") {
  const Scene s = yard(GENERATE("yard.gltf", "yard.glb"));
  REQUIRE(s.bodies.size() == 9);
  CHECK(shape<HalfSpace>(s, "world/ground").normal == Vec3::UnitY());
  CHECK(shape<Box>(s, "cart/cart").half_extents == Vec3(0.5, 1, 1.5));
  CHECK(at(s, "cart/cart").pose == Pose{{1, 2, 3}, {0, 0.6, 0, 0.8}});
  CHECK_FALSE(at(s, "cart/cart").is_static);
  CHECK(shape<Sphere>(s, "cart/wheel").radius == 1);
  // A turn by 2·atan(3/4) about y takes x to (7, 0, -24)/25.
  CHECK((at(s, "cart/wheel").pose.translation - Vec3(1.14, 2, 2.52)).norm() < 1e-12);
  CHECK(shape<Capsule>(s, "load") == Capsule{0.25, 1});
  CHECK((at(s, "load").pose.translation - Vec3(1, 3, 3)).norm() < 1e-12);
  CHECK((y_axis(at(s, "load")) - Vec3::UnitY()).norm() < 1e-12);
  CHECK(shape<Cylinder>(s, "world/post") == Cylinder{0.5, 2});
  CHECK(at(s, "world/post").is_static);
  CHECK(shape<Cone>(s, "world/tip") == Cone{0.5, 2});
  CHECK(at(s, "world/tip").pose.translation == Vec3(3, -2, -4));
}

TEST_CASE("meshes of a glTF file are those of a node, scaled and mirrored", "[import]") {
  const Scene s = yard(GENERATE("yard.gltf", "yard.glb"));
  const auto& rock = shape<TriangleMesh>(s, "world/rock");
  REQUIRE(rock.vertices.size() == 4);
  CHECK(rock.vertices[2] == Vec3(0, -2, 0));
  CHECK(rock.triangles[0] == std::array{0, 1, 2});  // mirrored, so reversed
  CHECK(shape<Hull>(s, "world/hull").vertices.size() == 4);
  // A strip, and that of a child one higher; twice the size by the matrix, which turns z to x.
  const auto& ramp = shape<TriangleMesh>(s, "ramp");
  REQUIRE(ramp.vertices.size() == 8);
  REQUIRE(ramp.triangles.size() == 4);
  CHECK(ramp.triangles[0] == std::array{0, 1, 2});
  CHECK(ramp.triangles[1] == std::array{1, 3, 2});
  CHECK((ramp.vertices[7] - Vec3(2, 2, 2)).norm() < 1e-12);
  const Vec3 corner =
      at(s, "ramp").pose.translation + rotation_matrix(at(s, "ramp").pose.rotation) * ramp.vertices[1];
  CHECK((corner - Vec3(-3, 0, 0)).norm() < 1e-12);
}

TEST_CASE("collision filters of glTF hold if either side has them", "[import]") {
  const Scene s = yard("yard.gltf");
  CHECK(are_asked(s, "cart/cart", "world/post"));        // a ghost and a wall
  CHECK(are_asked(s, "cart/cart", "ramp"));              // the ramp is of no system
  CHECK_FALSE(are_asked(s, "cart/cart", "cart/wheel"));  // of one body
  CHECK_FALSE(are_asked(s, "load", "world/post"));       // shy of walls
  CHECK_FALSE(are_asked(s, "load", "cart/cart"));        // by the filter, and by their joint
  CHECK(are_asked(s, "load", "ramp"));
}

TEST_CASE("a glTF file without physics is a mesh", "[import]") {
  const test::TempDir dir;
  std::string text = read_file(test::model_file("gltf/yard.gltf"));
  for (std::size_t i; (i = text.find("KHR_physics_rigid_bodies")) != std::string::npos;)
    text.replace(i, 3, "XXX");
  const Scene s = scene_of(import_model(dir.write("a.gltf", text), {}));
  REQUIRE(s.bodies.size() == 1);
  CHECK(std::holds_alternative<TriangleMesh>(s.shape_of(0)));
}

TEST_CASE("what glTF cannot mean is refused with its place", "[import]") {
  CHECK(contains(refused(collider("\"shape\":0")), "a.gltf: nodes[0].extensions"));
  CHECK(contains(refused(collider("\"shape\":0")), "names number 0 of 0 shapes"));
  CHECK(contains(refused(collider("\"node\":7")), "names number 7 of nodes, which has 1"));
  CHECK(contains(refused(collider("\"node\":0")), "names a node without triangles"));
  CHECK(contains(refused(collider("")), "names neither a shape nor a node"));
  CHECK(contains(refused(collider("\"shape\":0"), R"({"type":"sphere","sphere":{"radius":0}})"),
                 "shapes[0].sphere.radius: is not positive"));
  CHECK(
      contains(refused(collider("\"shape\":0"), R"({"type":"torus"})"), "type torus cannot be represented"));
  CHECK(contains(
      refused(collider("\"shape\":0") + ",\"scale\":[1,2,1]", R"({"type":"sphere","sphere":{"radius":1}})"),
      "unequal scales"));
  CHECK(contains(refused(collider("\"shape\":0"),
                         R"({"type":"capsule","capsule":{"height":1,"radiusTop":1,"radiusBottom":2}})"),
                 "unequal radii"));
  CHECK(contains(refused(collider("\"shape\":0") + ",\"children\":[0]",
                         R"({"type":"sphere","sphere":{"radius":1}})", ",\"scenes\":[{\"nodes\":[0]}]"),
                 "nodes[0]: is a child of two nodes, or of itself"));
  CHECK(contains(refused(collider("\"shape\":0") + ",\"matrix\":[1,0,0,0,1,1,0,0,0,0,1,0,0,0,0,1]"),
                 "has shear"));
  const std::string mesh = collider("\"node\":0") + ",\"mesh\":0";
  const auto with_buffer = [&](const std::string& uri) {
    return refused(
        mesh, "",
        R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
        R"("componentType":5126,"count":4,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":48}],)"
        R"("buffers":[{"byteLength":48,"uri":")" +
            uri + "\"}]");
  };
  CHECK(contains(with_buffer("../secret.bin"), "must not contain \"..\""));
  CHECK(contains(with_buffer("/etc/passwd"), "absolute path"));
  CHECK(contains(with_buffer("data:;base64,AAAA"), "bufferViews[0]: reaches beyond its buffer of 3 bytes"));
  CHECK(contains(with_buffer("data:;base64,*"), "is not data in base64"));
}
