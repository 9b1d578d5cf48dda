// Every fault of a file is reported in one line, with place and reason.
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

#include "scenarios/codec/json_file.h"
#include "scenarios/codec/scene_codec.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

std::string body_scene(const std::string& body, const std::string& shape = R"({"type":"sphere","radius":1})",
                       const std::string& more = "") {
  return R"({"touchstone_scene":1,"shapes":[)" + shape + R"(],"bodies":[)" + body + "]" + more + "}";
}

struct Bad {
  std::string text, place, reason;
};

void check_all(const std::vector<Bad>& list) {
  for (const Bad& bad : list) {
    const std::string what = refusal([&] { scene_from_text(bad.text, "f.json"); });
    INFO(bad.text << "\n  message: " << what);
    CHECK(what.starts_with("f.json"));
    CHECK(contains(what, bad.place + ": "));
    CHECK(contains(what, bad.reason));
  }
}

}  // namespace

TEST_CASE("text that is not JSON is refused with line and column", "[scene][codec][bad-input]") {
  // The column is that of the last character read, where the text becomes invalid.
  const auto bad_at = [](const std::string& text, const std::string& where, std::size_t extra,
                         const std::string& reason) {
    return Bad{text, "f.json:1:" + std::to_string(text.find(where) + 1 + extra), reason};
  };
  const auto with_x = [](const std::string& x) {
    return body_scene(R"({"shape":0,"pose":{"translation":[)" + x + ",0,0]}}");
  };
  check_all({
      {"", "f.json", "is empty"},
      {" \n\t ", "f.json", "is empty"},
      {"{\n \"touchstone_scene\": 1,\n \"shapes\": [", "f.json:3:12", "unexpected end of input"},
      bad_at(with_x("NaN"), "NaN", 0, "NaN is not a JSON number"),
      bad_at(with_x("Infinity"), "Infinity", 0, "Infinity is not a JSON number"),
      bad_at(with_x("-Infinity"), "-Infinity", 1, "Infinity is not a JSON number"),
      bad_at(with_x("1e999"), "1e999", 4, "number overflow"),
      bad_at(with_x("-1e309"), "-1e309", 5, "number overflow"),
      bad_at(with_x("0x10"), "x10", 0, "invalid literal"),
      bad_at(body_scene(R"({"shape":0})") + "x", "}x", 1, "expected end of input"),
      bad_at(body_scene("{\"shape\":0,\"name\":\"\xff\"}"), "\xff", 0, "UTF-8"),
      {"\x01\x02\n\x03", "f.json:1:1", "invalid literal"},
      {body_scene(R"({"shape":0,"shape":0})"), "f.json", "\"shape\" is given twice"},
  });
}

TEST_CASE("values of the wrong form are refused with their JSON path", "[scene][codec][bad-input]") {
  check_all({
      {"[]", "f.json", "must be an object"},
      {"{}", "f.json", "\"touchstone_scene\" is missing"},
      {R"({"touchstone_scene":2,"shapes":[],"bodies":[]})", "f.json: touchstone_scene",
       "version 2 is not known"},
      {R"({"touchstone_scene":"1","shapes":[],"bodies":[]})", "f.json: touchstone_scene", "whole number"},
      {R"({"touchstone_scene":1,"bodies":[]})", "f.json", "\"shapes\" is missing"},
      {R"({"touchstone_scene":1,"shapes":{},"bodies":[]})", "f.json: shapes", "must be an array"},
      {R"({"touchstone_scene":1,"shapes":[],"bodies":[],"camera":1})", "f.json", "unknown field \"camera\""},
      {body_scene("{}"), "f.json: bodies[0]", "\"shape\" is missing"},
      {body_scene("7"), "f.json: bodies[0]", "must be an object"},
      {body_scene(R"({"shape":0,"mass":1})"), "f.json: bodies[0]", "unknown field \"mass\""},
      {body_scene(R"({"shape":0.5})"), "f.json: bodies[0].shape", "whole number"},
      {body_scene(R"({"shape":99999999999})"), "f.json: bodies[0].shape", "out of range"},
      {body_scene(R"({"shape":1})"), "f.json: bodies[0].shape", "outside 0..0"},
      {body_scene(R"({"shape":-1})"), "f.json: bodies[0].shape", "outside"},
      {body_scene(R"({"shape":0,"static":1})"), "f.json: bodies[0].static", "true or false"},
      {body_scene(R"({"shape":0,"name":1})"), "f.json: bodies[0].name", "must be a string"},
      {body_scene(R"({"shape":0,"pose":[]})"), "f.json: bodies[0].pose", "must be an object"},
      {body_scene(R"({"shape":0,"pose":{"translation":[1,2]}})"), "f.json: bodies[0].pose.translation",
       "3 items"},
      {body_scene(R"({"shape":0,"pose":{"translation":[1,2,null]}})"),
       "f.json: bodies[0].pose.translation[2]", "must be a number"},
      {body_scene(R"({"shape":0,"pose":{"translation":[1,2,"3"]}})"), "f.json: bodies[0].pose.translation[2]",
       "must be a number"},
      {body_scene(R"({"shape":0,"pose":{"rotation":[0,0,0]}})"), "f.json: bodies[0].pose.rotation",
       "4 items"},
      {body_scene(R"({"shape":0,"pose":{"rotation":[0,0,-0.0,0]}})"), "f.json: bodies[0].pose.rotation",
       "zero quaternion"},
      {body_scene(R"({"shape":0,"motion":{"spin":[0,0,1]}})"), "f.json: bodies[0].motion",
       "unknown field \"spin\""},
  });
}

TEST_CASE("shapes of the wrong form are refused with their JSON path", "[scene][codec][bad-input]") {
  const auto shape = [](const std::string& s) { return body_scene(R"({"shape":0})", s); };
  check_all({
      {shape(R"({"radius":1})"), "f.json: shapes[0]", "\"type\" is missing"},
      {shape(R"({"type":"torus","radius":1})"), "f.json: shapes[0].type", "unknown shape \"torus\""},
      {shape(R"({"type":"sphere"})"), "f.json: shapes[0]", "\"radius\" is missing"},
      {shape(R"({"type":"sphere","radius":1,"height":1})"), "f.json: shapes[0]", "unknown field \"height\""},
      {shape(R"({"type":"sphere","radius":-1})"), "f.json: shapes[0].radius", "negative"},
      {shape(R"({"type":"sphere","radius":true})"), "f.json: shapes[0].radius", "must be a number"},
      {shape(R"({"type":"box","half_extents":[1,-1e-300,1]})"), "f.json: shapes[0].half_extents[1]",
       "negative"},
      {shape(R"({"type":"ellipsoid","semi_axes":[1,0,1]})"), "f.json: shapes[0].semi_axes[1]", "must be > 0"},
      {shape(R"({"type":"half_space","normal":[0,0,0],"offset":1})"), "f.json: shapes[0].normal",
       "zero vector"},
      {shape(R"({"type":"hull","vertices":[]})"), "f.json: shapes[0].vertices", "is empty"},
      {shape(R"({"type":"hull","vertices":[[1,2]]})"), "f.json: shapes[0].vertices[0]", "3 items"},
      {shape(R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[]})"),
       "f.json: shapes[0].triangles", "is empty"},
      {shape(R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,3]]})"),
       "f.json: shapes[0].triangles[0]", "vertex index 3 is outside 0..2"},
      {shape(R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,-1]]})"),
       "f.json: shapes[0].triangles[0]", "vertex index -1"},
  });
  check_all({{body_scene(R"({"shape":0,"motion":{"linear":[1,0,0]}})",
                         R"({"type":"half_space","normal":[0,0,1],"offset":0})"),
              "f.json: bodies[0].motion", "cannot move"}});
}

TEST_CASE("scripts and ignored pairs of the wrong form are refused with their JSON path",
          "[scene][codec][bad-input]") {
  const auto more = [](const std::string& m) {
    return body_scene(R"({"shape":0},{"shape":0})", R"({"type":"sphere","radius":1})", "," + m);
  };
  check_all({
      {more(R"("script":[{"op":"jump"}])"), "f.json: script[0].op", "insert, move, remove or query"},
      {more(R"("script":[{"body":0}])"), "f.json: script[0]", "\"op\" is missing"},
      {more(R"("script":[{"op":"insert"}])"), "f.json: script[0]", "\"body\" is missing"},
      {more(R"("script":[{"op":"insert","body":2}])"), "f.json: script[0].body", "not a body"},
      {more(R"("script":[{"op":"insert","body":0},{"op":"insert","body":0}])"), "f.json: script[1]",
       "present already"},
      {more(R"("script":[{"op":"remove","body":0}])"), "f.json: script[0]", "not present"},
      {more(R"("script":[{"op":"insert","body":0},{"op":"move","body":0}])"), "f.json: script[1].pose",
       "needs a pose"},
      {more(R"("script":[{"op":"insert","body":0},{"op":"remove","body":0,"pose":{}}])"), "f.json: script[1]",
       "unknown field \"pose\""},
      {more(R"("script":[{"op":"query","body":0}])"), "f.json: script[0]", "unknown field \"body\""},
      {more(R"("script":[{"op":"insert","body":0,"pose":{"rotation":[0,0,0,0]}}])"),
       "f.json: script[0].pose.rotation", "zero quaternion"},
      {more(R"("ignored":[[1,0]])"), "f.json: ignored[0]", "i < j"},
      {more(R"("ignored":[[0,2]])"), "f.json: ignored[0]", "i < j"},
      {more(R"("ignored":[[0]])"), "f.json: ignored[0]", "2 items"},
  });
}

TEST_CASE("ignored pairs may come in any order", "[scene][codec]") {
  const Scene s =
      scene_from_text(body_scene(R"({"shape":0},{"shape":0},{"shape":0})", R"({"type":"sphere","radius":1})",
                                 R"(,"ignored":[[1,2],[0,2]])"));
  CHECK(is_filtered(s, 2, 0));
  CHECK(is_filtered(s, 1, 2));
  CHECK(!is_filtered(s, 0, 1));
}

TEST_CASE("deep nesting is refused without using the stack", "[scene][codec][bad-input]") {
  const std::string deep(10'000'000, '[');
  CHECK(contains(refusal([&] { scene_from_text(deep, "f.json"); }), "nested more than"));
  std::string objects;
  for (int i = 0; i < 1'000'000; ++i) objects += "{\"a\":";
  CHECK(contains(refusal([&] { scene_from_text(objects, "f.json"); }), "nested more than"));
}

TEST_CASE("every truncation of a scene is refused", "[scene][codec][bad-input]") {
  const std::string text = body_scene(R"({"shape":0,"pose":{"translation":[1,2,3]}})");
  int refused = 0;
  for (std::size_t n = 0; n < text.size(); ++n)
    refused += refusal([&] { scene_from_text(text.substr(0, n), "f.json"); }) != "(accepted)";
  CHECK(refused == static_cast<int>(text.size()));
  CHECK_NOTHROW(scene_from_text(text));
}

TEST_CASE("files that cannot be scenes are refused by name", "[scene][codec][bad-input]") {
  const test::TempDir dir;
  const auto said = [](const std::filesystem::path& f) { return refusal([&] { load_scene(f); }); };
  CHECK(contains(said(dir.path() / "none.json"), "none.json: no such file"));
  CHECK(contains(said(dir.path()), "is a directory"));
  CHECK(contains(said(dir.write("empty.json", "")), "empty.json: is empty"));
  CHECK(contains(said(dir.write("cut.json", "{\"touchstone_scene\": 1,")), "cut.json:1:23: "));
  CHECK(contains(said("/dev/zero"), "/dev/zero: is a device, not a file"));

  const auto big = dir.write("big.json", "");
  std::filesystem::resize_file(big, std::uintmax_t{1} << 30);  // sparse: no gigabyte is written or read
  CHECK(contains(said(big), "big.json: is 1024 MiB; files larger than 256 MiB are refused"));
}

TEST_CASE("a number that JSON cannot represent is not written", "[scene][codec][bad-input]") {
  Scene s;
  s.shapes = {Sphere{std::numeric_limits<double>::infinity()}};
  CHECK(contains(refusal([&] { to_text(s); }), "inf"));
}

TEST_CASE("a mesh may be declared solid, and one that encloses nothing is refused by the place of the fault",
          "[scene][codec][bad-input]") {
  const auto scene = [](const std::string& solid, const std::string& triangles) {
    return body_scene(R"({"shape":0,"static":true})",
                      R"({"type":"mesh","solid":)" + solid +
                          R"(,"vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"triangles":)" + triangles + "}");
  };
  const std::string good = "[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]";
  const Scene solid = scene_from_text(scene("true", good));
  CHECK(kind_of(solid.shapes[0]) == ShapeKind::solid_mesh);
  CHECK(kind_of(scene_from_text(scene("false", good)).shapes[0]) == ShapeKind::mesh);
  CHECK(scene_from_text(to_text(solid)).shapes[0] == solid.shapes[0]);
  check_all({
      {scene("1", good), "f.json: shapes[0].solid", ""},
      {scene("true", "[[0,1,2],[0,1,3],[0,3,2],[1,2,3]]"), "f.json: shapes[0].triangles[1]",
       "runs along the edge from vertex 0 to 1 in the same direction as triangles[0]"},
      {scene("true", "[[0,2,1],[0,1,3],[0,3,2]]"), "f.json: shapes[0].triangles[0]",
       "has no triangle on the other side of the edge from vertex 2 to 1: the mesh is open there"},
      {scene("true", "[[0,1,2],[0,3,1],[0,2,3],[1,3,2]]"), "f.json: shapes[0].triangles[0]",
       "is clockwise seen from outside"},
      {scene("true", "[[0,2,1],[0,1,3],[0,3,2],[1,2,4]]"), "f.json: shapes[0].triangles[3]",
       "vertex index 4 is outside 0..3"},
  });
}

TEST_CASE("any shape but a mesh may state a padding, and a height field is a mesh",
          "[scene][codec][bad-input]") {
  const auto scene = [](const std::string& shape) {
    return body_scene(R"({"shape":0,"static":true})", shape);
  };
  const auto shape_of = [&](const std::string& shape) {
    const Scene s = scene_from_text(scene(shape));
    CHECK(scene_from_text(to_text(s)).shapes[0] == s.shapes[0]);
    return s.shapes[0];
  };
  CHECK(shape_of(R"({"type":"sphere","radius":1,"padding":0.5})") == Shape(Sphere{1.5}));
  CHECK(shape_of(R"({"type":"box","half_extents":[1,2,3],"padding":0.5})") ==
        Shape(RoundedBox{Vec3(1, 2, 3), 0.5}));
  CHECK(shape_of(R"({"type":"cone","radius":1,"half_height":2,"padding":0.5})") ==
        Shape(Padded<Cone>{{1, 2}, 0.5}));
  CHECK(shape_of(R"({"type":"cone","radius":1,"half_height":2,"padding":0})") == Shape(Cone{1, 2}));
  const Shape hull =
      shape_of(R"({"type":"hull","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"padding":0.5})");
  REQUIRE(kind_of(hull) == ShapeKind::padded_hull);
  CHECK(hull_if(hull)->dimension == 3);
  CHECK(hull_if(hull)->faces.size() == 4);
  const std::string mesh = R"("vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]],"padding":0.5})";
  check_all({
      {scene(R"({"type":"sphere","radius":1,"padding":-1})"), "f.json: shapes[0].padding",
       "is not a number of at least 0"},
      {scene(R"({"type":"sphere","radius":1,"padding":"1"})"), "f.json: shapes[0].padding", ""},
      {scene(R"({"type":"mesh",)" + mesh), "f.json: shapes[0].padding", "a mesh cannot be padded"},
      {scene(R"({"type":"padded_cone","radius":1,"half_height":2})"), "f.json: shapes[0]",
       "field \"padding\" is missing"},
  });

  const Shape field = shape_of(R"({"type":"height_field","cell":[2,1],"heights":[[0,1],[2,3],[4,5]]})");
  CHECK(field == Shape(TriangleMesh{{{-1, -1, 0}, {1, -1, 1}, {-1, 0, 2}, {1, 0, 3}, {-1, 1, 4}, {1, 1, 5}},
                                    {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}}}));
  const auto heights = [&](const std::string& cell, const std::string& rows) {
    return scene(R"({"type":"height_field","cell":)" + cell + R"(,"heights":)" + rows + "}");
  };
  check_all({
      {heights("[1,0]", "[[0,1],[2,3]]"), "f.json: shapes[0].cell[1]", "is not a number above 0"},
      {heights("[1]", "[[0,1],[2,3]]"), "f.json: shapes[0].cell", ""},
      {heights("[1,1]", "[[0,1]]"), "f.json: shapes[0].heights", "has fewer than two rows"},
      {heights("[1,1]", "[[0],[1]]"), "f.json: shapes[0].heights[0]", "has fewer than two heights"},
      {heights("[1,1]", "[[0,1],[2,3,4]]"), "f.json: shapes[0].heights[1]",
       "has another number of heights than the first row"},
      {heights("[1,1]", "[[0,1],[2,\"x\"]]"), "f.json: shapes[0].heights[1][1]", ""},
  });
}
