#include <fmt/format.h>

#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view includes = R"(#include <mujoco/mujoco.h>
#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
)";

constexpr std::string_view code = R"source(const std::string scene = R"(<mujoco>
<compiler inertiafromgeom="false"/>
<size nconmax="200" njmax="1"/>
<asset>@MESHES@</asset>
<worldbody>
@BODIES@</worldbody>
</mujoco>
)";
mjModel* compiled() {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(scene.size()));
  std::memcpy(files->filedata[0], scene.data(), scene.size());
  char error[200] = "";
  mjModel* model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
  if (!model) throw std::runtime_error(error);
  return model;
}

Answer ask() {
  const mjModel* m = compiled();
  mjData* d = mj_makeData(m);
  const double places[2][7] = {{@PLACE_A@},
                               {@PLACE_B@}};  // position, unit quaternion with w first
  for (int i = 0; i < 2; ++i) std::copy_n(places[i], 7, d->qpos + 7 * i);
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_collision(m, d);
  Answer x;
  x.overlap = d->ncon > 0;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    x.points.push_back({c.pos[0], c.pos[1], c.pos[2]});
    if (-c.dist <= x.depth) continue;
    x.depth = -c.dist;
    const double sign = c.geom1 == 0 ? 1 : -1;  // MuJoCo's normal points from geom1 to geom2
    x.normal = {sign * c.frame[0], sign * c.frame[1], sign * c.frame[2]};
  }
  return x;
}
)source";

// The attributes of a geom.
std::string geom(const Shape& shape, std::string_view name) {
  const auto sized = [](const char* type, const Vec3& v, int count) {
    std::string sizes;
    for (int k = 0; k < count; ++k) sizes += fmt::format("{}{}", k ? " " : "", v[k]);
    return fmt::format("type=\"{}\" size=\"{}\"", type, sizes);
  };
  if (const auto* s = std::get_if<Sphere>(&shape)) return sized("sphere", {s->radius, 0, 0}, 1);
  if (const auto* s = std::get_if<Box>(&shape)) return sized("box", s->half_extents, 3);
  if (const auto* s = std::get_if<Ellipsoid>(&shape)) return sized("ellipsoid", s->semi_axes, 3);
  if (const auto* s = std::get_if<Capsule>(&shape))
    return sized("capsule", {s->radius, s->half_height, 0}, 2);
  if (const auto* s = std::get_if<Cylinder>(&shape))
    return sized("cylinder", {s->radius, s->half_height, 0}, 2);
  if (std::holds_alternative<Hull>(shape)) return fmt::format("type=\"mesh\" mesh=\"{}\"", name);
  throw InputError("reproduce", "for MuJoCo 2.2 no programs with cones, half-spaces or meshes are written");
}

std::string mesh(const Shape& shape, std::string_view name) {
  const auto* hull = std::get_if<Hull>(&shape);
  if (!hull) return "";
  std::string vertices;
  for (const Vec3& v : hull->vertices) vertices += fmt::format("{} {} {}  ", v.x(), v.y(), v.z());
  return fmt::format("<mesh name=\"{}\" vertex=\"{}\"/>", name, vertices);
}

std::string body(const Shape& shape, std::string_view name) {
  return fmt::format(
      "<body><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/><geom {}/></body>\n",
      geom(shape, name));
}

std::string place(const Pose& p) {
  const Quat q = normalized(p.rotation);
  return fmt::format("{}, {}, {}, {}, {}", literals(p.translation), literal(q.w), literal(q.x), literal(q.y),
                     literal(q.z));
}

EngineSource source(const EngineQuestion& q) {
  if (q.question != Question::overlap && q.question != Question::contact)
    throw InputError("reproduce", "MuJoCo 2.2 answers overlap and contact only");
  const Shape &a = q.scene.shape_of(q.a), &b = q.scene.shape_of(q.b);
  EngineSource s;
  s.compile = "-lmujoco";
  s.includes = includes;
  s.code = filled(code, {{"MESHES", mesh(a, "a") + mesh(b, "b")},
                         {"BODIES", body(a, "a") + body(b, "b")},
                         {"PLACE_A", place(q.body(q.a).pose)},
                         {"PLACE_B", place(q.body(q.b).pose)}});
  return s;
}

}  // namespace

SourceWriter mujoco2_source_writer() { return {{"mujoco2"}, source}; }

}  // namespace touchstone::fuzz
