// Robots from files: kinematics against transforms composed by hand, filters, states, trajectories, and what
// is refused.
#include <Eigen/Geometry>
#include <cmath>

#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/model/import.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/model_check.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

using Eigen::AngleAxisd;
using Rigid = Eigen::Isometry3d;

Rigid rigid(const Vec3& xyz, const Vec3& rpy) {
  Rigid f = Rigid::Identity();
  f.translate(xyz);
  f.rotate(AngleAxisd(rpy.z(), Vec3::UnitZ()) * AngleAxisd(rpy.y(), Vec3::UnitY()) *
           AngleAxisd(rpy.x(), Vec3::UnitX()));
  return f;
}
Rigid turned(const Vec3& axis, double angle) { return Rigid(AngleAxisd(angle, axis.normalized())); }
Rigid moved(const Vec3& by) {
  Rigid f = Rigid::Identity();
  f.translate(by);
  return f;
}

ImportOptions parts() {
  ImportOptions o;
  o.package_paths = {test::model_file("")};
  return o;
}

std::string refused(const std::string& text, const ImportOptions& o = {},
                    const std::string& name = "r.urdf") {
  const test::TempDir dir;
  return refusal([&] { import_model(dir.write(name, text), o); });
}

std::string robot(const std::string& inside) { return "<robot name=\"r\">\n" + inside + "\n</robot>\n"; }

bool is_filtered_pair(const Scene& s, const std::string& a, const std::string& b) {
  return !is_filtered(s, test::body(s, a), test::body(s, b)) ? false : true;
}

}  // namespace

TEST_CASE("every joint of URDF moves its link as transforms composed by hand", "[import]") {
  ImportOptions o = parts();
  o.joints = {"yaw=0.5",          "roll=-1.2",       "lift=0.3",         "table/x=0.1",
              "table/y=-0.2",     "table/theta=0.4", "flight/trans_x=1", "flight/trans_z=2",
              "flight/rot_y=0.6", "flight/rot_w=0.8"};
  const ImportedModel m = import_model(test::model_file("every_joint.urdf"), o);
  const auto at = [&](const std::string& link) { return test::link_frame(m, link); };
  const Rigid turret = rigid({0.1, 0.2, 0.3}, {0.1, -0.2, 0.3}) * turned(Vec3::UnitZ(), 0.5);
  const Rigid slider = turret * rigid({0.05, 0, 0.1}, {0, 0.5, 0}) * rigid({0, 0, 0.2}, {0.4, 0, 0}) *
                       moved(Vec3(0, 0.6, 0.8) * 0.3);
  const double grip = -0.5 * 0.3 + 0.02;
  test::check_near(at("base"), Rigid::Identity());
  test::check_near(at("turret"), turret);
  test::check_near(at("wheel"), turret * moved({0, 0.15, 0}) * turned({1, 2, -3}, -1.2));
  test::check_near(at("slider"), slider);
  test::check_near(at("wedge"), slider * moved({grip, 0, 0.3}));
  test::check_near(at("finger"), slider * moved({0, 0.1, 0.3}) * turned(Vec3::UnitY(), 3 * grip));
  test::check_near(at("puck"),
                   rigid({0, 0, 0.5}, {0, 0, 0.7}) * moved({0.1, -0.2, 0}) * turned(Vec3::UnitZ(), 0.4));
  test::check_near(at("drone"), rigid({1, 0, 1}, {0.2, 0, 0}) * moved({1, 0, 2}) *
                                    turned(Vec3::UnitY(), 2 * std::atan2(0.6, 0.8)));
}

TEST_CASE("every geometry of URDF becomes the shape of that size", "[import]") {
  const Scene s = scene_of(import_model(test::model_file("every_joint.urdf"), parts()));
  const auto shape = [&](const std::string& name) -> const Shape& { return s.shape_of(test::body(s, name)); };
  CHECK(shape("base/plate") == Shape(Box{Vec3(0.3, 0.2, 0.05)}));
  CHECK(shape("base#1") == Shape(Sphere{0.05}));
  CHECK(shape("turret") == Shape(Cylinder{0.08, 0.1}));
  CHECK(shape("slider") == Shape(Capsule{0.03, 0.15}));
  const auto& wedge = std::get<TriangleMesh>(shape("wedge"));
  const auto& finger = std::get<TriangleMesh>(shape("finger"));
  REQUIRE(wedge.vertices.size() == finger.vertices.size());
  for (std::size_t i = 0; i < wedge.vertices.size(); ++i)
    CHECK(wedge.vertices[i] == finger.vertices[i].cwiseProduct(Vec3(0.5, -0.25, 2)));
  // The scale mirrors: the triangles turn round, so that they still face outward.
  CHECK(wedge.triangles[0] ==
        std::array{finger.triangles[0][0], finger.triangles[0][2], finger.triangles[0][1]});
  CHECK(s.bodies[0].group == s.bodies[1].group);
  CHECK(s.bodies[0].is_static);
  CHECK_FALSE(s.bodies[static_cast<std::size_t>(test::body(s, "turret"))].is_static);
  CHECK(scene_from_text(to_text(s)) == s);
  ImportOptions convex = parts();
  convex.convex_meshes = true;
  const Scene c = scene_of(import_model(test::model_file("every_joint.urdf"), convex));
  CHECK(std::holds_alternative<Hull>(c.shape_of(test::body(c, "wedge"))));
}

TEST_CASE("an SRDF says which pairs are asked; without one, adjacent links are filtered", "[import]") {
  ImportOptions o = parts();
  const ImportedModel alone = import_model(test::model_file("every_joint.urdf"), o);
  const Scene a = scene_of(alone);
  CHECK(alone.adjacent_filters > 0);
  CHECK(is_filtered_pair(a, "base/plate", "turret"));
  CHECK(is_filtered_pair(a, "turret", "slider"));  // rail, between them, is fixed to the turret
  CHECK_FALSE(is_filtered_pair(a, "wheel", "slider"));
  o.srdf = test::model_file("every_joint.srdf");
  const ImportedModel with = import_model(test::model_file("every_joint.urdf"), o);
  const Scene b = scene_of(with);
  CHECK(with.adjacent_filters == 0);
  CHECK(is_filtered_pair(b, "base/plate", "turret"));
  CHECK(is_filtered_pair(b, "base#1", "turret"));
  CHECK(is_filtered_pair(b, "wheel", "turret"));
  CHECK_FALSE(is_filtered_pair(b, "turret", "slider"));
  CHECK(is_filtered_pair(b, "drone", "wheel"));
  CHECK_FALSE(is_filtered_pair(b, "drone", "puck"));
}

TEST_CASE("a filter of a link with itself is refused", "[import]") {
  const test::TempDir dir;
  ImportOptions o = parts();
  o.srdf = dir.write("r.srdf",
                     "<robot name='every_joint'>\n<disable_collisions link1='base' link2='base'/></robot>")
               .string();
  CHECK(contains(refusal([&] { import_model(test::model_file("every_joint.urdf"), o); }),
                 "r.srdf:2: <disable_collisions>: names the same link twice"));
  CHECK(contains(refused("<mujoco><worldbody><body name='a'/></worldbody>\n<contact><exclude body1='a' "
                         "body2='a'/></contact></mujoco>",
                         {}, "m.xml"),
                 "m.xml:2: <exclude>: names the same body twice"));
}

TEST_CASE("states and --joint set variables; a trajectory becomes the script", "[import]") {
  ImportOptions o = parts();
  o.srdf = test::model_file("every_joint.srdf");
  o.state = "arm/up";
  o.joints = {"lift=0.125"};
  const std::string file = test::model_file("every_joint.urdf");
  const ImportedModel m = import_model(file, o);
  CHECK(m.configurations[0][test::joint(m, "yaw")][0] == 0.5);
  CHECK(m.configurations[0][test::joint(m, "lift")][0] == 0.125);
  o.state = "away";
  CHECK(import_model(file, o).configurations[0][test::joint(m, "flight")].back() == 1);
  o.state = "awry";
  CHECK(contains(refusal([&] { import_model(file, o); }), "there is no state awry"));
  o.state = "";
  o.joints = {"grip=1"};
  CHECK(contains(refusal([&] { import_model(file, o); }), "joint grip follows joint lift"));
  o.joints = {"yaw"};
  CHECK(contains(refusal([&] { import_model(file, o); }), "expected NAME=VALUE"));
  o.joints = {"yew=1"};
  CHECK(contains(refusal([&] { import_model(file, o); }), "did you mean yaw"));
  o.joints.clear();
  o.trajectory = test::model_file("sweep.csv");
  const ImportedModel t = import_model(file, o);
  REQUIRE(t.configurations.size() == 3);
  CHECK(t.configurations[2][test::joint(t, "lift")][0] == 0.15);
  const Scene s = scene_of(t);
  const auto queries = std::count_if(s.script.begin(), s.script.end(),
                                     [](const Step& step) { return step.op == Step::Op::query; });
  CHECK(queries == 3);
  const int turret = test::body(s, "turret");
  for (const Step& step : s.script)
    CHECK((step.op != Step::Op::move || !s.bodies[static_cast<std::size_t>(step.body)].is_static));
  const auto last =
      std::find_if(s.script.rbegin(), s.script.rend(), [&](const Step& step) { return step.body == turret; });
  CHECK(last->pose->translation == s.bodies[static_cast<std::size_t>(turret)].pose.translation);
  CHECK_FALSE(last->pose->rotation == s.bodies[static_cast<std::size_t>(turret)].pose.rotation);
  const test::TempDir dir;
  const auto bad = [&](const std::string& csv) {
    o.trajectory = dir.write("t.csv", csv);
    return refusal([&] { import_model(file, o); });
  };
  CHECK(contains(bad("time,yow\n0,1\n"), "t.csv:1: there is no joint variable yow"));
  CHECK(contains(bad("yaw,yaw\n0,1\n"), "two columns"));
  CHECK(contains(bad("yaw\n0\nx\n"), "t.csv:3: x is not a finite number"));
  CHECK(contains(bad("yaw,lift\n0\n"), "t.csv:2: expected 2 values, found 1"));
  CHECK(contains(bad("yaw\n"), "no rows"));
}

TEST_CASE("a bad robot is refused by file, line and element", "[import]") {
  CHECK(contains(refused("<robot>"), "r.urdf:1: is not well-formed XML"));
  CHECK(contains(refused("<model/>"), "r.urdf:1: <model>: is not the root element <robot>"));
  CHECK(contains(refused(robot("<xacro:arm/>")), "expand it first: xacro "));
  CHECK(contains(refused(robot("")), "has no links"));
  CHECK(contains(refused(robot("<link name='a'/>\n<link name='a'/>")),
                 "r.urdf:3: <link>: the name a is taken"));
  CHECK(contains(refused(robot("<link name='a'/><link name='b'/>")), "has two root links, a and b"));
  CHECK(contains(
      refused(robot("<link name='a'><collision><geometry><box size='1 2'/></geometry></collision></link>")),
      "size has 2 numbers instead of 3"));
  CHECK(contains(
      refused(
          robot("<link name='a'><collision><geometry><sphere radius='-1'/></geometry></collision></link>")),
      "r.urdf:2: <sphere>: "));
  CHECK(contains(refused(robot("<link name='a'><collision><geometry><torus/></geometry></collision></link>")),
                 "r.urdf:2: <torus>: is not a shape of URDF"));
  const auto joint = [&](const std::string& attributes, const std::string& inside = "") {
    return refused(robot("<link name='a'/><link name='b'/>\n<joint name='j' " + attributes +
                         "><parent link='a'/><child link='b'/>" + inside + "</joint>"));
  };
  CHECK(contains(joint("type='bent'"), "r.urdf:3: <joint>: unknown type bent"));
  CHECK(contains(joint("type='revolute'", "<axis xyz='0 0 0'/>"), "the axis is zero"));
  CHECK(contains(joint("type='revolute'", "<axis xyz='0 nan 0'/>"), "not a list of finite numbers"));
  CHECK(contains(joint("type='revolute'", "<mimic joint='j'/>"), "joint j mimics itself"));
  CHECK(contains(joint("type='revolute'", "<mimic joint='k'/>"), "there is no joint k"));
  CHECK(
      contains(refused(robot("<link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/>"
                             "<child link='b'/></joint><joint name='k' type='fixed'><parent link='b'/><child "
                             "link='a'/></joint>")),
               "is its own ancestor"));
}

TEST_CASE("with --lenient, what cannot be represented is left out and counted", "[import]") {
  const test::TempDir dir;
  const auto file =
      dir.write("r.urdf", robot("<link name='a'>\n<collision><geometry><torus/></geometry></collision>\n"
                                "<collision><geometry><mesh filename='gone.stl'/></geometry></collision>\n"
                                "<collision><geometry><sphere radius='1'/></geometry></collision></link>"));
  ImportOptions o;
  o.lenient = true;
  const ImportedModel m = import_model(file, o);
  REQUIRE(m.notes.size() == 2);
  CHECK(contains(m.notes[0].place, "r.urdf:3"));
  CHECK(contains(m.notes[1].place, "r.urdf:4"));
  CHECK(scene_of(m).bodies.size() == 1);
}

TEST_CASE("no file outside the robot's folder and the package paths is read", "[import]") {
  const test::TempDir outside, dir;
  const auto secret = outside.write("secret.stl", read_file(test::model_file("wedge.stl")));
  std::filesystem::create_symlink(secret, dir.path() / "link.stl");
  std::filesystem::create_directory_symlink(outside.path(), dir.path() / "parts");
  const auto with = [&](const std::string& uri, const ImportOptions& o = {}) {
    return refusal([&] {
      import_model(dir.write("r.urdf", robot("<link name='a'><collision><geometry><mesh filename='" + uri +
                                             "'/></geometry></collision></link>")),
                   o);
    });
  };
  CHECK(contains(with("link.stl"), "leads out of the folder"));
  CHECK(contains(with("parts/secret.stl"), "leads out of the folder"));
  CHECK(contains(with("../secret.stl"), "must not contain \"..\""));
  CHECK(contains(with(secret.string()), "is an absolute path"));
  CHECK(contains(with("file://" + secret.string()), "only package://"));
  CHECK(contains(with("https://example.org/a.stl"), "only package://"));
  CHECK(contains(with("package://parts/meshes/wedge.stl"), "--package-path"));
  CHECK(contains(with("package://parts/../secret.stl", parts()), "must not lead out of its package"));
  CHECK(contains(with("package://../secret.stl", parts()), "must not lead out of its package"));
  CHECK(with("package://parts/meshes/wedge.stl", parts()) == "(accepted)");
  CHECK(contains(with("gone.stl"), "there is no file"));
  CHECK(contains(with("r.urdf"), "meshes are read from"));
}

TEST_CASE("MJCF: classes, orientations and sizes as MuJoCo reads them", "[import]") {
  ImportOptions o;
  const Scene s = scene_of(import_model(test::model_file("every_geom.xml"), o));
  const auto shape = [&](const std::string& name) -> const Shape& { return s.shape_of(test::body(s, name)); };
  CHECK(shape("world/floor") == Shape(HalfSpace{Vec3::UnitZ(), 0}));
  CHECK(shape("arm/upper") == Shape(Capsule{0.02, 0.2}));
  CHECK(shape("trunk") == Shape(Ellipsoid{Vec3(0.2, 0.15, 0.1)}));
  CHECK(shape("hand") == Shape(Box{Vec3(0.1, 0.05, 0.02)}));
  CHECK(std::get<Hull>(shape("tip")).vertices.size() == 4);
  CHECK(std::abs(std::get<Capsule>(shape("arm/lower")).half_height - std::sqrt(0.14) / 2) <
        test::pose_tolerance);
  CHECK(s.bodies.size() == 9);                       // `visual` never collides
  CHECK(is_filtered_pair(s, "hand", "leg"));         // excluded
  CHECK(is_filtered_pair(s, "trunk", "arm/upper"));  // a body and its parent
  CHECK(is_filtered_pair(s, "tip", "ball"));         // contype and conaffinity
  CHECK_FALSE(is_filtered_pair(s, "trunk", "ball"));
  CHECK_FALSE(is_filtered_pair(s, "world/floor", "ball"));  // the world is no parent
  o.state = "home";
  const ImportedModel m = import_model(test::model_file("every_geom.xml"), o);
  CHECK(m.configurations[0][test::joint(m, "root")] ==
        std::vector<double>{0.1, 0.2, 1.3, 0.5, -0.5, 0.5, 0.5});
  const auto bad = [&](const std::string& inside) {
    return refused("<mujoco>\n" + inside + "</mujoco>", {}, "m.xml");
  };
  CHECK(contains(bad("<worldbody><geom type='sdf'/></worldbody>"),
                 "m.xml:2: <geom>: type sdf cannot be represented"));
  CHECK(contains(bad("<worldbody><geom size='1' class='no'/></worldbody>"), "there is no default class no"));
  CHECK(
      contains(bad("<worldbody><geom type='box' size='1'/></worldbody>"), "size has 1 numbers instead of 3"));
  CHECK(contains(bad("<worldbody><body><composite type='grid'/></body></worldbody>"),
                 "<composite>: type grid cannot be represented"));
  CHECK(contains(bad("<include file='m.xml'/>"), "includes a file for the second time"));
  CHECK(contains(bad("<worldbody><body><joint/><geom type='plane'/></body></worldbody>"),
                 "a plane on a body that moves"));
}

TEST_CASE("a package is found by the name in its package.xml", "[import]") {
  const test::TempDir dir;
  std::filesystem::create_directories(dir.path() / "packages/arm_folder/meshes");
  std::filesystem::create_directories(dir.path() / "robots");
  std::filesystem::copy(test::model_file("wedge.stl"), dir.path() / "packages/arm_folder/meshes/wedge.stl");
  dir.write("packages/arm_folder/package.xml", "<package format='2'><name>arm_description</name></package>");
  const auto file =
      dir.write("robots/r.urdf", robot("<link name='a'><collision><geometry><mesh "
                                       "filename='package://arm_description/meshes/wedge.stl'/></geometry>"
                                       "</collision></link>"));
  ImportOptions o;
  for (const char* folder : {"packages", "packages/arm_folder"}) {
    o.package_paths = {dir.path() / folder};
    CHECK(scene_of(import_model(file, o)).bodies.size() == 1);
  }
  dir.write("packages/arm_folder/package.xml", "<package><name>leg_description</name></package>");
  CHECK(
      contains(refusal([&] { import_model(file, o); }), "package arm_description is in none of the folders"));
  dir.write("packages/arm_folder/package.xml", "<package><name>");
  CHECK(contains(refusal([&] { import_model(file, o); }), "package.xml"));
}

TEST_CASE("URDF as Bullet's models write it", "[import]") {
  const auto text = [](const std::string& in_joint) {
    return robot(
        "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/><child "
        "link='b'/>" +
        in_joint + "</joint>");
  };
  const test::TempDir dir;
  const auto file = dir.write("r.urdf", text("<limit effort='1'/><joint_properties damping='0'/>"));
  CHECK(import_model(file, {}).model.joints[0].upper == 0);
  const std::string reversed = text("<limit lower='1' upper='-1'/>");
  CHECK(contains(refused(reversed), "<limit>: lower is larger than upper"));
  ImportOptions lenient;
  lenient.lenient = true;
  const ImportedModel m = import_model(dir.write("r.urdf", reversed), lenient);
  CHECK(m.notes.size() == 1);
  CHECK(m.model.joints[0].upper == std::numeric_limits<double>::infinity());
}

TEST_CASE("a terrain of three height fields, from an image, a binary file and the text", "[import]") {
  const Scene s = scene_of(import_model(test::model_file("terrain.xml"), {}));
  REQUIRE(s.bodies.size() == 4);
  const auto mesh = [&](const std::string& name) -> const TriangleMesh& {
    return std::get<TriangleMesh>(s.shape_of(test::body(s, name)));
  };
  CHECK(mesh("world/hills").vertices.size() == 63);
  CHECK(mesh("world/hills").triangles.size() == 96);
  CHECK(mesh("world/dunes").triangles.size() == 24);
  CHECK(mesh("world/steps").triangles.size() == 6);
  for (const char* name : {"world/hills", "world/dunes", "world/steps"}) {
    INFO(name);
    CHECK(s.bodies[static_cast<std::size_t>(test::body(s, name))].is_static);
  }
}

TEST_CASE("MJCF: a height field is a surface of two triangles a cell", "[import]") {
  const auto text = [](const std::string& field) {
    return "<mujoco>\n<asset>" + field +
           "</asset>\n<worldbody><geom name='g' type='hfield' hfield='f' pos='0 0 1'/></worldbody></mujoco>";
  };
  // Heights 2 to 6, the first row of greatest y.
  const test::TempDir dir;
  const Scene s = scene_of(import_model(
      dir.write("m.xml",
                text("<hfield name='f' nrow='2' ncol='3' size='2 1 8 0.1' elevation='2 3 4  6 5 4'/>")),
      {}));
  REQUIRE(s.bodies.size() == 1);
  CHECK(s.bodies[0].pose.translation == Vec3(0, 0, 1));
  const auto& m = std::get<TriangleMesh>(s.shape_of(0));
  CHECK(m.vertices ==
        std::vector<Vec3>{{-2, -1, 8}, {0, -1, 6}, {2, -1, 4}, {-2, 1, 0}, {0, 1, 2}, {2, 1, 4}});
  CHECK(m.triangles == std::vector<std::array<int, 3>>{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});

  const std::string flat_text = text("<hfield name='f' nrow='2' ncol='2' size='1 1 3 1'/>");
  const auto flat = scene_of(import_model(dir.write("flat.xml", flat_text), {}));
  for (const Vec3& v : std::get<TriangleMesh>(flat.shape_of(0)).vertices) CHECK(v.z() == 0);

  const auto bad = [&](const std::string& field) { return refused(text(field), {}, "m.xml"); };
  CHECK(contains(bad(""), "m.xml:3: <geom>: there is no hfield f"));
  CHECK(contains(bad("<hfield name='f' nrow='1' ncol='3' size='1 1 1 1'/>"),
                 "m.xml:2: <hfield>: a height field needs two rows and two columns"));
  CHECK(contains(bad("<hfield name='f' nrow='1e9' ncol='1e9' size='1 1 1 1'/>"), "is not read"));
  CHECK(contains(bad("<hfield name='f' nrow='2.5' ncol='3' size='1 1 1 1'/>"), "must be whole numbers"));
  CHECK(contains(bad("<hfield name='f' nrow='2' ncol='2' size='1 1 1 1' elevation='1 2 3'/>"),
                 "elevation has 3 numbers instead of 4"));
  CHECK(contains(bad("<hfield name='f' nrow='2' ncol='2' size='1 1 1 1' elevation='1 2 3 1e300'/>"),
                 "too large for a float"));
  CHECK(
      contains(bad("<hfield name='f' nrow='2' ncol='2' size='1 -1 1 1'/>"), "needs a size of four positive"));
  CHECK(contains(bad("<hfield name='f' file='no.png' size='1 1 1 1'/>"), "there is no file"));
  CHECK(contains(bad("<hfield name='f' file='/etc/passwd' size='1 1 1 1'/>"), "absolute path"));
  ImportOptions lenient;
  lenient.lenient = true;
  CHECK(import_model(dir.write("m.xml", text("<hfield name='f' nrow='1' ncol='1' size='1 1 1 1'/>")), lenient)
            .notes.size() == 1);
}

TEST_CASE("SDFormat: poses relative to frames, nested models, joints", "[import]") {
  const std::string file = test::model_file("nested.sdf");
  ImportOptions o;
  const Rigid robot = rigid({1, 2, 0}, {0, 0, 0.5}) * rigid({0.1, 0, 0.2}, {0, 0.3, 0});
  const Rigid base = robot * moved({0, 0, 0.1});
  const double degree = 3.14159265358979323846 / 180;
  const Rigid arm = base * moved({0.1, 0, 0.1}) * rigid({0, 0, 0.2}, Vec3(10, 20, 30) * degree);
  const ImportedModel zero = import_model(file, o);
  test::check_near(test::link_frame(zero, "robot::base"), base);
  test::check_near(test::link_frame(zero, "robot::arm"), arm);
  test::check_near(test::link_frame(zero, "robot::tool::tip"), arm * moved({0, 0, 0.3}));
  o.joints = {"robot::swing=0.4", "robot::push=0.05", "robot::cross/axis=0.3", "robot::cross/axis2=-0.2"};
  const ImportedModel m = import_model(file, o);
  // About the base's y axis through the joint, which is 0.15 below the arm's origin.
  const Vec3 centre = arm * Vec3(0, 0, -0.15);
  Rigid about = Rigid::Identity();
  about.translate(centre);
  about.rotate(AngleAxisd(0.4, base.linear() * Vec3::UnitY()));
  about.translate(-centre);
  test::check_near(test::link_frame(m, "robot::arm"), about * arm);
  test::check_near(test::link_frame(m, "robot::tool::tip"), about * arm * moved({0, 0, 0.35}));
  test::check_near(test::link_frame(m, "robot::wheel"),
                   robot * moved({0, 0.3, 0}) * turned(Vec3::UnitX(), 0.3) * turned(Vec3::UnitY(), -0.2));
  const Scene s = scene_of(m);
  CHECK(is_filtered_pair(s, "robot::base/box", "robot::arm"));  // a joint connects them
  CHECK_FALSE(is_filtered_pair(s, "robot::arm", "robot::wheel"));
  CHECK(is_filtered_pair(s, "robot::tool::tip", "robot::wheel"));  // the tool does not collide with itself
  CHECK_FALSE(is_filtered_pair(s, "ground::link", "robot::wheel"));
  CHECK(s.bodies[static_cast<std::size_t>(test::body(s, "ground::link"))].is_static);
  const auto bad = [&](const std::string& inside) {
    return refused("<sdf version='1.9'>\n<model name='m'>" + inside + "</model></sdf>", {}, "m.sdf");
  };
  CHECK(
      contains(bad("<link name='a'><pose relative_to='b'/></link>"), "m.sdf:2: <link>: there is no frame b"));
  CHECK(contains(
      bad("<frame name='a'><pose relative_to='b'/></frame><frame name='b'><pose relative_to='a'/></frame>"
          "<link name='l'><pose relative_to='a'/></link>"),
      "relative to itself"));
  CHECK(
      contains(bad("<link name='a'><collision name='c'><geometry><heightmap/></geometry></collision></link>"),
               "<heightmap>: cannot be represented"));
  CHECK(contains(bad("<link name='a'/><link name='b'/><joint name='j' "
                     "type='screw'><parent>a</parent><child>b</child></joint>"),
                 "type screw cannot be represented"));
}

TEST_CASE("an arm of seven joints is the same in URDF and in MJCF", "[import]") {
  ImportOptions urdf, mjcf;
  urdf.package_paths = {test::model_file("")};
  urdf.joints = {"shoulder_pan=0.3", "shoulder_lift=-0.7", "upper_arm_roll=2", "elbow_flex=1.1",
                 "forearm_roll=-1",  "wrist_flex=0.4",     "wrist_roll=0.9",   "finger=0.02"};
  mjcf.joints = urdf.joints;
  mjcf.joints.push_back("finger_mirror=0.02");
  const ImportedModel a = import_model(test::model_file("cell/arm7.urdf"), urdf),
                      b = import_model(test::model_file("cell/arm7.xml"), mjcf);
  const Rigid lift = moved({0, 0, 0.001});  // the pedestal of the MJCF file stands above its floor
  for (const ModelLink& l : a.model.links) {
    if (l.name == "tool_flange") continue;  // a link without a shape, which the MJCF file leaves out
    INFO(l.name);
    test::check_near(lift * test::link_frame(a, l.name), test::link_frame(b, l.name));
  }
  const Scene sa = scene_of(a), sb = scene_of(b);
  CHECK(sa.bodies.size() == 12);
  CHECK(sb.bodies.size() == 13);
  const auto& shell = std::get<TriangleMesh>(sa.shape_of(test::body(sa, "forearm_roll_link")));
  CHECK(shell.triangles.size() == 160);
  CHECK(std::get<Hull>(sb.shape_of(test::body(sb, "forearm_roll_link"))).vertices.size() <= 82);
  CHECK(sa.shape_of(test::body(sa, "shoulder_lift_link")) == Shape(Capsule{0.06, 0.08}));
}

TEST_CASE("a table with fifteen objects, as a planning scene", "[import]") {
  const ImportedModel m = import_model(test::model_file("cell/table15.scene"), {});
  CHECK(m.model.links.size() == 15);
  const Scene s = scene_of(m);
  CHECK(s.bodies.size() == 19);
  CHECK(std::all_of(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.is_static; }));
  CHECK(s.shape_of(test::body(s, "traffic_cone")) == Shape(Cone{0.09, 0.15}));
  CHECK(std::get<TriangleMesh>(s.shape_of(test::body(s, "mug_without_lid"))).triangles.size() == 70);
}

TEST_CASE("models in models of SDFormat keep their poses, and a world its name", "[import]") {
  const ImportedModel m = import_model(test::model_file("cell/table15.sdf"), {});
  CHECK(m.model.name == "table15");
  const Rigid tray = moved({0.8, 0, 0.25}) * rigid({-0.2, 0.1, 0.011}, {0, 0, 0.4});
  test::check_near(test::link_frame(m, "table::tray::plate"), tray);
  test::check_near(test::link_frame(m, "table::tray::fruit::plum"), tray * moved({0.03, 0, 0.051}));
  test::check_near(test::link_frame(m, "pole::flag"), moved({0.4, 0.3, 0.5}));
  const Scene s = scene_of(m);
  const auto& finger = std::get<TriangleMesh>(s.shape_of(test::body(s, "mug::body")));
  double most = 0;
  for (const Vec3& v : finger.vertices) most = std::max(most, v.x());
  CHECK(most == 2 * static_cast<double>(0.02F));
}

TEST_CASE("a mesh is the same in every format", "[import]") {
  for (const char* name : {"cell/meshes/wedge.ply", "cell/meshes/wedge.dae", "wedge.stl"}) {
    INFO(name);
    const Scene s = scene_of(import_model(test::model_file(name), {}));
    const auto& mesh = std::get<TriangleMesh>(s.shape_of(0));
    CHECK(mesh.triangles.size() == 4);
    CHECK(mesh.vertices.size() == 4);
    Vec3 most = Vec3::Zero();
    for (const Vec3& v : mesh.vertices) most = most.cwiseMax(v);
    CHECK(most == Vec3(static_cast<double>(0.1F), static_cast<double>(0.2F), static_cast<double>(0.05F)));
  }
}

TEST_CASE("a planning scene has fixed objects", "[import]") {
  const Scene s = scene_of(import_model(test::model_file("table.scene"), {}));
  REQUIRE(s.bodies.size() == 3);
  CHECK(s.shape_of(0) == Shape(Box{Vec3(0.5, 0.3, 0.025)}));
  CHECK(s.shape_of(1) == Shape(Cylinder{0.05, 0.25}));
  CHECK(s.bodies[2].name == "ball");
  test::check_near(test::isometry(s.bodies[1].pose),
                   moved({0, 0, 0.5}) * turned(Vec3::UnitZ(), std::atan(1)) * moved({0.4, 0, -0.25}));
  CHECK(contains(refused("room\n* a\n0 0 0\n0 0 0 1\n1\ntorus\n", {}, "t.scene"),
                 "t.scene:6: unknown shape torus"));
  CHECK(contains(refused("room\n* a\n0 0 0\n0 0 0 1\n1\nbox\n1 1\n", {}, "t.scene"),
                 "t.scene:7: expected the size of a box"));
  CHECK(contains(refused("room\n", {}, "t.scene"), "the file ends here"));
}
