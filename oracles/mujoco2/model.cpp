#include "oracles/mujoco2/model.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

namespace touchstone::mujoco2 {
namespace {

// Room for the contacts of this many pairs; mjMAXCONPAIR of MuJoCo is the most contacts of a pair.
constexpr int most_pairs = 2000;
constexpr int most_contacts_of_a_pair = 50;

bool is_solid(const ts_shape& s, int sizes) {
  return std::all_of(s.size, s.size + sizes, [](double x) { return x > 0; });
}

// The MJCF type and the number of its sizes; null if MuJoCo has no such shape, or refuses its sizes.
const char* type_of(const ts_shape& s, int& sizes) {
  sizes = s.kind == TS_SPHERE ? 1 : s.kind == TS_CAPSULE || s.kind == TS_CYLINDER ? 2 : 3;
  switch (s.kind) {
    case TS_SPHERE:
      return is_solid(s, sizes) ? "sphere" : nullptr;
    case TS_CAPSULE:
      return is_solid(s, sizes) ? "capsule" : nullptr;
    case TS_CYLINDER:
      return is_solid(s, sizes) ? "cylinder" : nullptr;
    case TS_ELLIPSOID:
      return is_solid(s, sizes) ? "ellipsoid" : nullptr;
    case TS_BOX:
      return is_solid(s, sizes) ? "box" : nullptr;
    case TS_HULL:
      return s.dimension == 3 ? "mesh" : nullptr;
    case TS_HALF_SPACE:
      return "plane";
    default:  // MuJoCo collides the hull of a mesh, and has no cone
      return nullptr;
  }
}

void write_mesh(std::ostream& out, std::size_t number, const ts_shape& s) {
  out << "<mesh name=\"m" << number << "\" vertex=\"";
  for (std::size_t i = 0; i < 3 * s.vertex_count; ++i) out << s.vertices[i] << ' ';
  out << "\"/>\n";
}

// The plane's origin is the point of its surface nearest to the body's origin, its normal is z.
void write_plane(std::ostream& out, int body, const ts_shape& s, const ts_pose& at) {
  const Pose pose = kit::pose_of(at);
  const Vec3 n = kit::vec3(s.size);
  const double length = n.stableNorm();
  const Vec3 normal = rotation_matrix(pose.rotation) * (n / length);
  const Vec3 origin = pose.translation + normal * (s.size[3] / length);
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal);
  out << "<geom name=\"g" << body << "\" type=\"plane\" size=\"0 0 1\" pos=\"" << origin.x() << ' '
      << origin.y() << ' ' << origin.z() << "\" quat=\"" << q.w() << ' ' << q.x() << ' ' << q.y() << ' '
      << q.z() << "\"/>\n";
}

void write_body(std::ostream& out, int body, int shape, const ts_shape& s) {
  int sizes = 0;
  const char* type = type_of(s, sizes);
  if (!type) return;
  out << "<body name=\"b" << body
      << "\"><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>"
      << "<geom name=\"g" << body << "\" type=\"" << type << "\" ";
  if (s.kind == TS_HULL) {
    out << "mesh=\"m" << shape << '"';
  } else {
    out << "size=\"";
    for (int i = 0; i < sizes; ++i) out << s.size[i] << ' ';
    out << '"';
  }
  out << "/></body>\n";
}

std::string mjcf(const ts_scene& scene) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  const auto pairs = std::min<std::size_t>(most_pairs, scene.body_count * scene.body_count);
  out << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n<size nconmax=\""
      << pairs * most_contacts_of_a_pair << "\" njmax=\"1\"/>\n<asset>\n";
  for (std::size_t i = 0; i < scene.shape_count; ++i)
    if (int sizes = 0; scene.shapes[i].kind == TS_HULL && type_of(scene.shapes[i], sizes))
      write_mesh(out, i, scene.shapes[i]);
  out << "</asset>\n<worldbody>\n";
  for (std::size_t i = 0; i < scene.body_count; ++i) {
    const ts_body& b = scene.bodies[i];
    const ts_shape& s = scene.shapes[b.shape];
    if (s.kind == TS_HALF_SPACE)
      write_plane(out, static_cast<int>(i), s, b.pose);
    else
      write_body(out, static_cast<int>(i), b.shape, s);
  }
  out << "</worldbody></mujoco>\n";
  return out.str();
}

// MuJoCo's own handlers write a file, and wait for a key.
void set_handlers() {
  mju_user_warning = [](const char*) {};
  mju_user_error = [](const char* text) {
    std::fprintf(stderr, "MuJoCo: %s\n", text);
    std::abort();
  };
}

mjModel* compile(const std::string& text) {
  set_handlers();
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char error[200] = "";
  mjModel* model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw kit::Unsupported(std::string("MuJoCo refuses the model: ") + error);
  return model;
}

}  // namespace

World::World(const ts_scene& scene, const ts_received& received) : model_(compile(mjcf(scene))) {
  data_.reset(mj_makeData(model_.get()));
  bodies_.resize(static_cast<std::size_t>(model_->ngeom), -1);
  for (std::size_t i = 0; i < scene.body_count; ++i) {
    geoms_.push_back(mj_name2id(model_.get(), mjOBJ_GEOM, ("g" + std::to_string(i)).c_str()));
    if (geoms_.back() >= 0) bodies_[static_cast<std::size_t>(geoms_.back())] = static_cast<int>(i);
  }
  place_bodies(scene);
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  report(scene, received);
}

void World::place_bodies(const ts_scene& scene) {
  for (std::size_t i = 0; i < scene.body_count; ++i) {
    const int id = mj_name2id(model_.get(), mjOBJ_BODY, ("b" + std::to_string(i)).c_str());
    if (id < 0) continue;
    double* at = data_->qpos + model_->jnt_qposadr[model_->body_jntadr[id]];
    const Pose pose = kit::pose_of(scene.bodies[i].pose);
    const Quat q = normalized(pose.rotation);
    const double values[7] = {
        pose.translation.x(), pose.translation.y(), pose.translation.z(), q.w, q.x, q.y, q.z};
    std::copy_n(values, 7, at);
  }
}

void World::report(const ts_scene& scene, const ts_received& received) const {
  const double upward[4] = {0, 0, 1, 0};
  for (std::size_t i = 0; i < scene.body_count; ++i) {
    const int geom = geoms_[i], shape = scene.bodies[i].shape;
    if (geom < 0) continue;
    received.body(received.ctx, static_cast<int>(i), data_->geom_xmat + 9 * geom,
                  data_->geom_xpos + 3 * geom);
    if (model_->geom_type[geom] == mjGEOM_PLANE) received.shape(received.ctx, shape, upward, nullptr, 0);
    if (model_->geom_type[geom] != mjGEOM_MESH) continue;
    const int mesh = model_->geom_dataid[geom];
    const float* vertices = model_->mesh_vert + 3 * model_->mesh_vertadr[mesh];
    const std::vector<double> held(vertices, vertices + 3 * model_->mesh_vertnum[mesh]);
    ts_shape hull{};
    hull.kind = TS_HULL;
    hull.vertices = held.data();
    hull.vertex_count = held.size() / 3;
    kit::report_other_shape(received, shape, hull);
  }
}

void World::collide() { mj_collision(model_.get(), data_.get()); }

void World::collide_within(int body, double margin) {
  mjtNum& of_geom = model_->geom_margin[geoms_[static_cast<std::size_t>(body)]];
  of_geom = margin;
  collide();
  of_geom = 0;
}

}  // namespace touchstone::mujoco2
