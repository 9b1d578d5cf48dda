// Malformed recorded data is refused with file, line and reason.
#include <cstring>

#include "scenarios/import/broadphase_sets.h"
#include "scenarios/import/ccd_queries.h"
#include "scenarios/import/fcl_motion.h"
#include "scenarios/import/hull_zoo.h"
#include "scenarios/import/real_scene.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

const std::string scene_text =
    "cdh-scene 1\nname tiny\ncounts shapes 2 bodies 3 dynamic 2 static 1 ignore 1 frames 2 cols 7\n"
    "shape 0 box 1 2 3\nshape 1 hull 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "body 0 dynamic a 2\ngeom 0 0 0 1 0 0 0 1\ngeom 1 1 0 0 0 0 1 0\nbody 1 dynamic b 1\ngeom 1 0 0 0 0 0 0 "
    "1\n"
    "body 2 static floor 1 0 0 -5 0 0 0 1\ngeom 0 0 0 0 0 0 0 1\nignore 0 2\nend\n";

std::string replaced(std::string s, const std::string& from, const std::string& to) {
  const auto at = s.find(from);
  REQUIRE(at != std::string::npos);
  return s.replace(at, from.size(), to);
}

std::string npy(const std::string& shape, const std::vector<double>& values,
                const std::string& descr = "<f8") {
  std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
  std::string s("\x93NUMPY\x01\x00", 8);
  s += static_cast<char>(header.size() & 0xff);
  s += static_cast<char>(header.size() >> 8);
  s += header;
  s.append(reinterpret_cast<const char*>(values.data()), 8 * values.size());
  return s;
}

std::vector<double> identity_poses(std::size_t n) {
  std::vector<double> v;
  for (std::size_t i = 0; i < n; ++i) v.insert(v.end(), {static_cast<double>(i), 0, 0, 0, 0, 0, 1});
  return v;
}

struct TinyScene {
  test::TempDir dir;
  TinyScene() {
    dir.write("scene.txt", scene_text);
    dir.write("frames.npy", npy("(2, 2, 7)", identity_poses(4)));
    dir.write("frames.csv", "frame,segment,kind\n0,0,path\n1,0,path\n");
  }
  std::string said() const {
    return refusal([&] { load_real_scene(dir.path()); });
  }
};

}  // namespace

TEST_CASE("a small recorded scene is read", "[scene][readers]") {
  const TinyScene t;
  const RealScene s = load_real_scene(t.dir.path());
  const Scene f = s.frame(1);
  CHECK_NOTHROW(validate(f));
  REQUIRE(f.bodies.size() == 4);
  CHECK(f.bodies[0].group == 0);
  CHECK(f.bodies[1].group == 0);
  CHECK(f.bodies[2].group == -1);
  CHECK(f.bodies[0].pose.translation == Vec3(2, 0, 1));
  CHECK(f.bodies[3].is_static);
  CHECK(f.ignored == std::vector<BodyPair>{{0, 3}, {1, 3}});
  CHECK(contains(refusal([&] { s.frame(2); }), "outside 0..1"));
  CHECK(contains(refusal([&] { s.script(0, 2); }), "outside 0..1"));
}

TEST_CASE("scene.txt is refused with file and line", "[scene][readers][bad-input]") {
  struct Bad {
    std::string from, to, place, reason;
  };
  const std::vector<Bad> list{
      {"cdh-scene 1", "cdh-scene 2", "scene.txt:1", "expected: cdh-scene 1"},
      {"name tiny", "name", "scene.txt:2", "expected 2 values"},
      {"bodies 3", "bodies 4", "scene.txt:3", "dynamic + static"},
      {"cols 7", "cols 8", "scene.txt:3", "cols must be"},
      {"counts", "count", "scene.txt:3", "expected: counts"},
      {"box 1 2 3", "box 1 2", "scene.txt:4", "expected 6 values"},
      {"box 1 2 3", "box 1 2 x", "scene.txt:4", "\"x\" is not a number"},
      {"box 1 2 3", "box 1 2 nan", "scene.txt:4", "not finite"},
      {"box 1 2 3", "box 1 2 1e999", "scene.txt:4", "not a number"},
      {"box 1 2 3", "box 1 2 -3", "scene.txt:4", "negative"},
      {"box 1 2 3", "torus 1 2 3", "scene.txt:4", "unknown shape"},
      {"shape 1", "shape 2", "scene.txt:5", "expected: shape 1"},
      {"hull 4", "hull 5", "scene.txt:10", "expected 3 values"},
      {"hull 4", "hull 0", "scene.txt:5", "outside"},
      {"geom 0 0 0 1", "geom 2 0 0 1", "scene.txt:11", "outside 0..1"},
      {"geom 0 0 0 1 0 0 0 1", "geom 0 0 0 1 0 0 0 0", "scene.txt:11", "zero quaternion"},
      {"a 2", "a 3", "scene.txt:13", "expected: geom"},
      {"body 1 dynamic", "body 1 static", "scene.txt:13", "must be dynamic"},
      {"ignore 0 2", "ignore 2 0", "scene.txt:17", "outside"},
      {"end\n", "", "scene.txt:17", "the file ends here"},
      {"end\n", "end\nmore\n", "scene.txt:19", "more after the end"},
  };
  for (const Bad& bad : list) {
    const TinyScene t;
    t.dir.write("scene.txt", replaced(scene_text, bad.from, bad.to));
    const std::string what = t.said();
    INFO(bad.to << " message: " << what);
    CHECK(contains(what, bad.place + ": "));
    CHECK(contains(what, bad.reason));
  }
}

TEST_CASE("frames are refused with file and reason", "[scene][readers][bad-input]") {
  const TinyScene t;
  const auto with_npy = [&](const std::string& bytes) {
    t.dir.write("frames.npy", bytes);
    return t.said();
  };
  CHECK(contains(with_npy(""), "frames.npy: is not a NumPy file"));
  CHECK(contains(with_npy("hello, world"), "frames.npy: is not a NumPy file"));
  CHECK(contains(with_npy(npy("(2, 2, 7)", identity_poses(3))), "its shape needs 224"));
  CHECK(contains(with_npy(npy("(2, 2, 7)", identity_poses(4), "<f4")), "must hold type"));
  CHECK(contains(with_npy(npy("(4, 7)", identity_poses(4))), "shape must be"));
  CHECK(contains(with_npy(npy("(99999999, 99999999, 99999999)", {})), "shape must be"));
  CHECK(contains(with_npy(npy("(1, 4, 7)", identity_poses(4))), "scene.txt announces"));
  auto poses = identity_poses(4);
  poses[6] = 0;
  CHECK(contains(with_npy(npy("(2, 2, 7)", poses)), "zero quaternion"));
  poses[6] = std::nan("");
  CHECK(contains(with_npy(npy("(2, 2, 7)", poses)), "not finite"));
  t.dir.write("frames.npy", npy("(2, 2, 7)", identity_poses(4)));
  t.dir.write("frames.csv", "frame,segment,kind\n0,0,path\n");
  CHECK(contains(t.said(), "scene.txt announces 2"));
  t.dir.write("frames.csv", "frame,segment,kind\n0,0,path\n2,0,path\n");
  CHECK(contains(t.said(), "frames.csv:3: frames must be numbered"));
  std::filesystem::remove(t.dir.path() / "frames.csv");
  CHECK(contains(t.said(), "frames.csv: no such file"));
}

TEST_CASE("malformed hulls, clouds, boxes, atoms and motions are refused with their place",
          "[scene][readers][bad-input]") {
  const test::TempDir dir;
  dir.write("zoo.csv", "");
  const auto zoo = [&](const std::string& text) {
    dir.write("zoo.txt", text);
    return refusal([&] { load_hull_zoo(dir.path()); });
  };
  CHECK(contains(zoo("cdh-hulls 1\ncount 1\nhull 0 4 4\n0 0 0\n1 0 0\n0 1 0\n"),
                 "zoo.txt:6: the file ends here"));
  CHECK(contains(zoo("cdh-hulls 1\ncount 1\nhull 0 4 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 4\n"),
                 "zoo.txt:8: 4 is outside"));
  CHECK(contains(zoo("cdh-hulls 1\ncount 1\nhull 7 4 4\n"), "zoo.txt:3: expected: hull 0"));
  CHECK(contains(zoo("cdh-hulls 1\ncount 0\nend\n"), "zoo.csv:"));

  const std::string one_point("\x01\x00\x00\x00\x00\x00\x80\x3f\x00\x00\x80\x3f\x00\x00\x80\x3f", 16);
  CHECK(load_point_clouds(dir.write("c.bin", one_point + one_point)).size() == 2);
  for (std::size_t n : {1u, 3u, 4u, 15u, 17u, 31u})
    CHECK(contains(
        refusal([&] { load_point_clouds(dir.write("c.bin", (one_point + one_point).substr(0, n))); }),
        "is cut off in cloud"));
  CHECK(contains(refusal([&] { load_point_clouds(dir.write("c.bin", "\xff\xff\xff\xff")); }), "is cut off"));

  const auto boxes = [&](const std::string& rows) {
    return refusal([&] { load_aabbs(dir.write("b.csv", rows)); });
  };
  CHECK(boxes("minx,miny,minz,maxx,maxy,maxz\n0,0,0,1,1,1\n") == "(accepted)");
  CHECK(contains(boxes("0,0,0,1,1,1\n"), "b.csv:1: expected the header"));
  CHECK(contains(boxes("minx,miny,minz,maxx,maxy,maxz\n0,0,0,1,1\n"), "b.csv:2: expected 6 values"));
  CHECK(contains(boxes("minx,miny,minz,maxx,maxy,maxz\n0,0,0,1,1,-1\n"), "b.csv:2: a minimum"));
  CHECK(contains(boxes("minx,miny,minz,maxx,maxy,maxz\n0,0,0,1,,1\n"), "b.csv:2: \"\" is not a number"));
  CHECK(contains(refusal([&] { load_atoms(dir.write("a.csv", "x,y,z,radius,element\n1,2,3,-1,C\n")); }),
                 "a.csv:2: the radius is negative"));
}

TEST_CASE("a rational that is not a double is refused, others are read exactly",
          "[scene][readers][bad-input]") {
  const test::TempDir dir;
  const auto query = [&](const std::string& x) {
    std::string s = x + ",0,1,0,1,1\n";
    for (int i = 1; i < 8; ++i) s += "0,1,0,1,0,1,1\n";
    return dir.write("q.csv", s);
  };
  const auto said = [&](const std::string& x) { return refusal([&] { load_ccd_file(query(x), true); }); };
  CHECK(load_ccd_file(query("3,8"), true).at(0).start[0].x() == 0.375);
  CHECK(load_ccd_file(query("-8388609,8388608"), true).at(0).start[0].x() == -8388609.0 / 8388608.0);
  CHECK(load_ccd_file(query("1,1267650600228229401496703205376"), true).at(0).start[0].x() == 0x1p-100);
  CHECK(contains(said("1,3"), "not exactly a double"));
  CHECK(contains(said("9007199254740993,1"), "not exactly a double"));
  CHECK(contains(said("1,0"), "denominator"));
  CHECK(contains(said("1.5,1"), "not an integer"));
  CHECK(contains(said(","), "not an integer"));
  CHECK(contains(refusal([&] { load_ccd_file(dir.write("q.csv", "0,1,0,1,0,1,1\n"), true); }),
                 "q.csv:1: the file ends here"));
}

TEST_CASE("a printed matrix that is not a rotation is refused", "[scene][readers][bad-input]") {
  const test::TempDir dir;
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  dir.write("obj1.obj", obj);
  dir.write("obj2.obj", obj);
  const std::string header =
      "frame,time,p1x,p1y,p1z,r1_00,r1_01,r1_02,r1_10,r1_11,r1_12,r1_20,r1_21,r1_22,p2x,p2y,p2z,r2_00,r2_01,"
      "r2_02,"
      "r2_10,r2_11,r2_12,r2_20,r2_21,r2_22\n";
  const std::string identity = "0,0,0,1,0,0,0,1,0,0,0,1";
  dir.write("frames.csv", header + "1,0.5," + identity + "," + identity + "\n");
  CHECK(load_fcl_motion(dir.path()).frame(0).bodies[1].pose == Pose{});
  dir.write("frames.csv", header + "1,0.5," + identity + ",0,0,0,1,0,0,0,1,0,0,0,-1\n");
  CHECK(
      contains(refusal([&] { load_fcl_motion(dir.path()); }), "frames.csv:2: the matrix is not a rotation"));
}
