// World poses of imported robots against MuJoCo's own compiler and kinematics, where libmujoco is installed.
#include <mujoco/mujoco.h>

#include <memory>

#include "tests/scenarios/import/model_check.h"
#include "tests/scenarios/import/temp_dir.h"

using namespace touchstone;

namespace {

struct Simulation {
  explicit Simulation(const std::string& file) {
    char error[1000] = "";
    model.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
    INFO(error);
    REQUIRE(model);
    data.reset(mj_makeData(model.get()));
  }
  std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, decltype(&mj_deleteData)> data{nullptr, mj_deleteData};
};

Eigen::Isometry3d frame_of(const mjtNum* position, const mjtNum* matrix) {
  Eigen::Isometry3d f = Eigen::Isometry3d::Identity();
  f.translation() = Vec3(position[0], position[1], position[2]);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) f.linear()(r, c) = matrix[3 * r + c];
  return f;
}

// Every body of the simulation that the model has too, and every primitive geom.
void check_poses(const Simulation& s, const ImportedModel& m, int least_bodies, int least_geoms) {
  int bodies = 0, geoms = 0;
  for (int b = 1; b < s.model->nbody; ++b) {
    const std::string name = mj_id2name(s.model.get(), mjOBJ_BODY, b);
    INFO(name);
    test::check_near(test::link_frame(m, name), frame_of(s.data->xpos + 3 * b, s.data->xmat + 9 * b));
    ++bodies;
  }
  const Scene scene = scene_of(m);
  for (int g = 0; g < s.model->ngeom; ++g) {
    const char* name = mj_id2name(s.model.get(), mjOBJ_GEOM, g);
    if (!name || s.model->geom_type[g] == mjGEOM_MESH) continue;  // MuJoCo moves a mesh to its centre of mass
    const std::string body = mj_id2name(s.model.get(), mjOBJ_BODY, s.model->geom_bodyid[g]);
    for (const Body& b : scene.bodies)
      if (b.name == body + "/" + name) {
        INFO(b.name);
        test::check_near(test::isometry(b.pose),
                         frame_of(s.data->geom_xpos + 3 * g, s.data->geom_xmat + 9 * g));
        ++geoms;
      }
  }
  CHECK(bodies >= least_bodies);
  CHECK(geoms >= least_geoms);
}

}  // namespace

TEST_CASE("poses of an MJCF file are MuJoCo's", "[import][optional]") {
  const std::string file = test::model_file("every_geom.xml");
  const Simulation s(file);
  mj_kinematics(s.model.get(), s.data.get());
  check_poses(s, import_model(file, {}), 6, 4);
  ImportOptions home;
  home.state = "home";
  mj_resetDataKeyframe(s.model.get(), s.data.get(), 0);
  mj_kinematics(s.model.get(), s.data.get());
  check_poses(s, import_model(file, home), 6, 4);
}

TEST_CASE("poses of an arm of seven joints are MuJoCo's", "[import][optional]") {
  const std::string file = test::model_file("cell/arm7.xml");
  const Simulation s(file);
  ImportOptions ready;
  ready.state = "ready";
  mj_resetDataKeyframe(s.model.get(), s.data.get(), 0);
  mj_kinematics(s.model.get(), s.data.get());
  check_poses(s, import_model(file, ready), 11, 0);
}

TEST_CASE("poses of a URDF file are MuJoCo's", "[import][optional]") {
  const std::string file = test::model_file("arm.urdf");
  const Simulation s(file);
  ImportOptions o;
  const std::vector<std::pair<std::string, double>> values{
      {"j1", 0.4}, {"j2", -0.9}, {"j3", 1.3}, {"slide", 0.07}, {"spin", 2.5}};
  for (const auto& [name, value] : values) {
    o.joints.push_back(name + "=" + std::to_string(value));
    const int j = mj_name2id(s.model.get(), mjOBJ_JOINT, name.c_str());
    REQUIRE(j >= 0);
    s.data->qpos[s.model->jnt_qposadr[j]] = std::stod(std::to_string(value));
  }
  mj_kinematics(s.model.get(), s.data.get());
  check_poses(s, import_model(file, o), 5, 0);
}

TEST_CASE("the heights of a binary file and of an image are MuJoCo's", "[import][optional]") {
  for (const std::string name : {"hills.bin", "hills.png"}) {
    INFO(name);
    const test::TempDir dir;
    std::filesystem::copy(test::model_file(name), dir.path() / name);
    const auto file =
        dir.write("m.xml", "<mujoco><asset><hfield name='f' file='" + name +
                               "' size='3 2 0.5 0.1'/></asset><worldbody><geom name='ground' type='hfield' "
                               "hfield='f'/></worldbody></mujoco>");
    const Simulation s(file.string());
    const Scene scene = scene_of(import_model(file, {}));
    const auto& mesh = std::get<TriangleMesh>(scene.shape_of(0));
    REQUIRE(s.model->nhfield == 1);
    REQUIRE(mesh.vertices.size() ==
            static_cast<std::size_t>(s.model->hfield_nrow[0] * s.model->hfield_ncol[0]));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      CHECK(mesh.vertices[i].z() == 0.5 * static_cast<double>(s.model->hfield_data[i]));
    CHECK(mesh.vertices.size() >= 20);
  }
}
