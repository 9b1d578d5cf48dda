// MJCF's elements that make many: replicas, attachments, chains; against poses that MuJoCo 3.14 computed
// (mujoco_poses.mjs), and what is refused.
#include <fstream>
#include <limits>
#include <sstream>

#include "scenarios/codec/scene_codec.h"
#include "scenarios/import/model/import.h"
#include "scenarios/import/pose_algebra.h"
#include "tests/scenarios/import/expect_error.h"
#include "tests/scenarios/import/model_check.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;
using test::contains;
using test::refusal;

namespace {

// The lines of a .poses file.
struct Expected {
  std::vector<std::pair<std::string, std::vector<double>>> joints, bodies, geoms;
  std::vector<std::pair<std::string, std::string>> excludes;

  explicit Expected(const std::string& file) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string kind, name, other;
      words >> kind >> name;
      if (kind == "exclude") {
        words >> other;
        excludes.emplace_back(name, other);
        continue;
      }
      std::vector<double> v;
      for (double x = 0; words >> x;) v.push_back(x);
      (kind == "joint" ? joints : kind == "body" ? bodies : geoms).emplace_back(name, v);
    }
  }

  std::vector<std::string> assignments() const {
    std::vector<std::string> all;
    for (const auto& [name, v] : joints)
      for (std::size_t k = 0; k < v.size(); ++k) {
        static constexpr const char* of_quaternion[] = {"/rot_w", "/rot_x", "/rot_y", "/rot_z"};
        all.push_back(name + (v.size() == 1 ? "" : of_quaternion[k]) + "=" + exact_text(v[k]));
      }
    return all;
  }

 private:
  static std::string exact_text(double x) {
    std::ostringstream out;
    out.precision(17);
    out << x;
    return out.str();
  }
};

Eigen::Isometry3d body_frame(const std::vector<double>& v) {
  return test::isometry({{v[0], v[1], v[2]}, Quat{v[4], v[5], v[6], v[3]}});
}
Eigen::Isometry3d geom_frame(const std::vector<double>& v) {
  Eigen::Isometry3d f = Eigen::Isometry3d::Identity();
  f.translation() = Vec3(v[0], v[1], v[2]);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) f.linear()(r, c) = v[static_cast<std::size_t>(3 + 3 * r + c)];
  return f;
}

std::vector<Pose> geom_poses(const ImportedModel& m, const std::string& name) {
  const auto links = link_poses(m.model, m.configurations[0]);
  std::vector<Pose> found;
  for (std::size_t i = 0; i < links.size(); ++i)
    for (const ModelShape& s : m.model.links[i].shapes)
      if (s.name == name) found.push_back(compose(links[i], s.in_link));
  return found;
}

std::string mujoco(const std::string& inside) { return "<mujoco>\n" + inside + "\n</mujoco>\n"; }
ImportedModel read(const std::string& text, const ImportOptions& o = {}) {
  const test::TempDir dir;
  return import_model(dir.write("m.xml", text), o);
}
std::string refused(const std::string& text) {
  return refusal([&] { read(text); });
}

}  // namespace

namespace {

// MuJoCo turns the segments of a curved cable with vertices that are floats; in which order it rounds is its
// own.
double tolerance_of(const std::string& name) {
  return name.starts_with("coil") ? std::numeric_limits<float>::epsilon() : test::pose_tolerance;
}

}  // namespace

TEST_CASE("replicas, attachments, chains and frames around joints are where MuJoCo puts them", "[import]") {
  const Expected expected(test::model_file("mjcf/replicas.poses"));
  REQUIRE(expected.bodies.size() == 62);
  REQUIRE(expected.geoms.size() == 65);
  ImportOptions o;
  o.joints = expected.assignments();
  const ImportedModel m = import_model(test::model_file("mjcf/replicas.xml"), o);
  for (const auto& [name, v] : expected.bodies) {
    INFO(name);
    test::check_near(test::link_frame(m, name), body_frame(v), tolerance_of(name));
  }
  CHECK(scene_of(m).bodies.size() == expected.geoms.size());
  for (const auto& [name, v] : expected.geoms) {
    INFO(name);
    const std::vector<Pose> found = geom_poses(m, name);
    REQUIRE(found.size() == 1);
    test::check_near(test::isometry(found[0]), geom_frame(v), tolerance_of(name));
  }
}

TEST_CASE("contact exclusions of replicas concern bodies of the same copy", "[import]") {
  const Expected expected(test::model_file("mjcf/replicas.poses"));
  const ImportedModel m = import_model(test::model_file("mjcf/replicas.xml"), {});
  REQUIRE(expected.excludes.size() == 52);
  const auto link = [&](const std::string& name) {
    for (std::size_t i = 0; i < m.model.links.size(); ++i)
      if (m.model.links[i].name == name) return static_cast<int>(i);
    FAIL(name);
    return -1;
  };
  const auto has = [&](int a, int b) {
    return std::binary_search(m.model.filters.begin(), m.model.filters.end(), LinkPair(std::minmax(a, b)));
  };
  for (const auto& [a, b] : expected.excludes) {
    INFO(a << " " << b);
    CHECK(has(link(a), link(b)));
  }
  CHECK_FALSE(has(link("tip0"), link("tip1")));
  CHECK_FALSE(has(link("tip0"), link("link-001")));
  CHECK_FALSE(has(link("copy_shoulder0"), link("copy_elbow1")));
}

TEST_CASE("a state of an attached model is one of the copy", "[import]") {
  ImportOptions o;
  o.state = "copy_folded1";
  const ImportedModel m = import_model(test::model_file("mjcf/replicas.xml"), o);
  CHECK(m.configurations[0][test::joint(m, "copy_lift1")][0] == 0.4);
  CHECK(m.configurations[0][test::joint(m, "copy_fold1")][0] == -1.1);
  CHECK(m.configurations[0][test::joint(m, "copy_lift0")][0] == 0);
}

TEST_CASE("what deforms is named, and counted if asked to be lenient", "[import]") {
  const std::string text = mujoco(
      "<worldbody>\n<geom size='1'/>\n<flexcomp name='f' type='grid' count='3 3 1'/>\n</worldbody>\n"
      "<deformable>\n<skin/>\n<flex name='g' dim='2'/>\n</deformable>");
  CHECK(contains(refused(text), "m.xml:4: <flexcomp>: cannot be represented"));
  ImportOptions lenient;
  lenient.lenient = true;
  const ImportedModel m = read(text, lenient);
  REQUIRE(m.notes.size() == 2);
  CHECK(contains(m.notes[1].place, "m.xml:8"));
  CHECK(scene_of(m).bodies.size() == 1);
}

TEST_CASE("elements that make many are refused with their place", "[import]") {
  const auto world = [](const std::string& inside) {
    return refused(mujoco("<worldbody>\n" + inside + "\n</worldbody>"));
  };
  CHECK(contains(world("<replicate><geom size='1'/></replicate>"),
                 "m.xml:3: <replicate>: lacks the attribute count"));
  CHECK(contains(world("<replicate count='0'/>"), "m.xml:3: <replicate>: count must be a whole number"));
  CHECK(contains(world("<replicate count='1e9'/>"), "m.xml:3: <replicate>: count must be a whole number"));
  CHECK(contains(world("<replicate count='11' euler='0 1e308 0'><geom size='1'/></replicate>"),
                 "m.xml:3: <replicate>: the angles of the last copy exceed the range of doubles"));
  CHECK(contains(world("<replicate count='100000'>\n<replicate count='100000'/>\n</replicate>"),
                 "m.xml:4: <replicate>: a model with more than"));
  CHECK(contains(world("<attach prefix='a'/>"), "m.xml:3: <attach>: names neither"));
  CHECK(contains(world("<attach body='b' prefix='a'/>"), "m.xml:3: <attach>: there is no body"));
  CHECK(contains(world("<attach model='b' prefix='a'/>"), "m.xml:3: <attach>: there is no model"));
  // A body that attaches itself.
  CHECK(contains(world("<body name='b'>\n<attach body='b' prefix='a'/>\n</body>"), "is nested deeper"));
  const auto cable = [&](const std::string& attributes) {
    return world("<composite type='cable' " + attributes + "><geom type='box' size='1 1 1'/></composite>");
  };
  CHECK(contains(world("<composite type='cloth'/>"), "type cloth cannot be represented"));
  CHECK(contains(cable("count='1' curve='s'"), "m.xml:3: <composite>: count must begin"));
  CHECK(contains(cable("count='3 2' curve='s'"), "a cable has one dimension"));
  CHECK(contains(cable("count='3' curve='tan(s)'"), "the unknown function tan(s)"));
  CHECK(contains(cable("vertex='0 0 0'"), "vertex has 3 numbers"));
  CHECK(contains(cable("vertex='0 0 0 1 0 0 0 0 0'"), "turns straight back at vertex 1"));
  CHECK(contains(cable("vertex='0 0 0 1 0 0 1 0 0'"), "two vertices that follow each other are equal"));
  CHECK(contains(cable("vertex='0 0 0 1e99 0 0'"), "too far away for a float"));
}

TEST_CASE("models are attached from the folder of the file only", "[import]") {
  const test::TempDir dir;
  dir.write("b.xml", mujoco("<asset><model name='a' file='a.xml'/></asset>"
                            "<worldbody><attach model='a' prefix='x'/></worldbody>"));
  const auto a = dir.write("a.xml", mujoco("<asset><model name='b' file='b.xml'/></asset>"
                                           "<worldbody>\n<attach model='b' prefix='x'/></worldbody>"));
  CHECK(contains(refusal([&] { import_model(a, {}); }), "is nested deeper"));
  CHECK(contains(refused(mujoco("<asset>\n<model name='a' file='../a.xml'/></asset><worldbody>"
                                "<attach model='a' prefix='x'/></worldbody>")),
                 "must not contain \"..\""));
}
