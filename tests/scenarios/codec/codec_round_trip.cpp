// A scene written and read again is the same scene, bit by bit.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/exact_text.h"
#include "core/base/input_error.h"
#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "tests/scenarios/import/sample_scenes.h"
#include "tests/scenarios/import/temp_dir.h"
#include "tests/support/catch.h"

using namespace touchstone;

namespace {

double through_text(double v) { return parse_json(to_line(nlohmann::ordered_json(v))).get<double>(); }

}  // namespace

TEST_CASE("every double that JSON can represent is read back with the same bits", "[scene][codec]") {
  Rng rng(1);
  int count = 0;
  const auto check = [&](double v) {
    if (std::bit_cast<std::uint64_t>(through_text(v)) != std::bit_cast<std::uint64_t>(v)) FAIL(to_text(v));
    ++count;
  };
  for (double v :
       {0.0, -0.0, 5e-324, -5e-324, 0x1p-1022, 1e308, -1e308, 1.7976931348623157e308, 0.1, 1e22, 1e23,
        9007199254740993.0, 18446744073709551616.0, -9223372036854775808.0, 1e-7, 123456789012345680.0})
    check(v);
  while (count < 100000) {
    const double v = std::bit_cast<double>(rng.next());
    if (std::isfinite(v)) check(v);
  }
  CHECK(count == 100000);
}

TEST_CASE("a random scene over all shapes survives text and JSON unchanged", "[scene][codec]") {
  Rng rng(2);
  int scenes = 0, bodies = 0;
  for (; scenes < 300; ++scenes) {
    const Scene scene = test::nasty_scene(rng);
    validate(scene);
    bodies += static_cast<int>(scene.bodies.size());
    const Scene by_text = scene_from_text(to_text(scene)), by_json = scene_from_json(to_json(scene));
    const Scene by_dump = scene_from_text(to_json(scene).dump());
    for (const Scene* read : {&by_text, &by_json, &by_dump}) {
      REQUIRE(*read == scene);
      REQUIRE(hash(*read) == hash(scene));  // == treats -0 as 0, the hash does not
    }
    REQUIRE(to_text(by_text) == to_text(scene));
  }
  INFO(scenes << " scenes, " << bodies << " bodies");
  CHECK(bodies > 1000);
}

TEST_CASE("a margin of a scene is kept, and left out when it is 0", "[scene][codec]") {
  Scene scene;
  CHECK(to_text(scene).find("margin") == std::string::npos);
  const auto plain = hash(scene);
  scene.margin = -0.1;
  CHECK(hash(scene) != plain);
  CHECK(scene_from_text(to_text(scene)) == scene);
  CHECK(scene_from_json(to_json(scene)) == scene);
}

TEST_CASE("a scene survives a file", "[scene][codec]") {
  Rng rng(3);
  const test::TempDir dir;
  const Scene scene = test::nasty_scene(rng);
  save_scene(scene, dir.path() / "s.json");
  CHECK(hash(load_scene(dir.path() / "s.json")) == hash(scene));
  CHECK_THROWS_AS(save_scene(scene, dir.path() / "no" / "such" / "s.json"), InputError);
}

TEST_CASE("defaults are left out when writing and filled in when reading", "[scene][codec]") {
  Scene s;
  s.shapes = {Sphere{1}};
  s.bodies.resize(1);
  CHECK(to_line(to_json(s)) ==
        R"({"touchstone_scene": 1, "shapes": [{"type": "sphere", "radius": 1}], "bodies": [{"shape": 0}]})");
  CHECK(scene_from_json(to_json(s)) == s);
  s.bodies[0].pose.translation.x() = -0.0;
  CHECK(to_line(to_json(s)).find("-0.0") != std::string::npos);
}

TEST_CASE("the token -0 keeps its sign and whole numbers serve as doubles", "[scene][codec]") {
  const Scene s = scene_from_text(
      R"({"touchstone_scene":1,"shapes":[{"type":"box","half_extents":[1,2,3]}],
          "bodies":[{"shape":0,"pose":{"translation":[-0,0,-0.0],"rotation":[0,0,0,2]}}]})");
  const Pose& p = s.bodies[0].pose;
  CHECK(std::signbit(p.translation.x()));
  CHECK(!std::signbit(p.translation.y()));
  CHECK(std::signbit(p.translation.z()));
  CHECK(p.rotation == Quat{0, 0, 0, 2});
  CHECK(std::get<Box>(s.shapes[0]).half_extents == Vec3(1, 2, 3));
}

TEST_CASE("text has one body or step per line", "[scene][codec]") {
  Rng rng(4);
  Scene s = test::nasty_scene(rng);
  while (s.script.empty() || s.ignored.empty()) s = test::nasty_scene(rng);
  const std::string text = to_text(s);
  std::size_t lines = 0;
  for (char c : text) lines += c == '\n';
  const std::size_t items = s.shapes.size() + s.bodies.size() + s.ignored.size() + s.script.size();
  const std::size_t lists = 4, head = s.name.empty() ? 1 : 2, tail = 1;
  CHECK(lines == items + 2 * lists + head + tail);
}

TEST_CASE("degenerate hulls are valid in a file", "[scene][codec]") {
  const auto dimension = [](const std::string& vertices) {
    const Scene s = scene_from_text(R"({"touchstone_scene":1,"shapes":[{"type":"hull","vertices":)" +
                                    vertices + R"(}],"bodies":[{"shape":0}]})");
    return std::get<Hull>(s.shapes[0]).dimension;
  };
  CHECK(dimension("[[1,2,3]]") == 0);
  CHECK(dimension("[[1,2,3],[1,2,3],[1,2,3],[1,2,3]]") == 0);
  CHECK(dimension("[[0,0,0],[1,0,0],[2,0,0]]") == 1);
  CHECK(dimension("[[0,0,0],[1,0,0],[0,1,0],[1,1,0],[1,1,0]]") == 2);
  CHECK(dimension("[[0,0,0],[1,0,0],[0,1,0],[0,0,1],[0,0,1]]") == 3);
}
