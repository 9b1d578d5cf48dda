#include <fmt/format.h>

#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view code = R"(const geom = ({ shape }, name) => ({
  sphere: () => `type="sphere" size="${shape.radius}"`,
  box: () => `type="box" size="${shape.half_extents.join(" ")}"`,
  capsule: () => `type="capsule" size="${shape.radius} ${shape.half_height}"`,
  cylinder: () => `type="cylinder" size="${shape.radius} ${shape.half_height}"`,
  ellipsoid: () => `type="ellipsoid" size="${shape.semi_axes.join(" ")}"`,
  hull: () => `type="mesh" mesh="${name}"`,
}[shape.type]());
const mesh = ({ shape }, name) => shape.type === "hull"
  ? `<mesh name="${name}" inertia="shell" vertex="${shape.vertices.flat().join(" ")}"/>` : "";
const body = (b, name) => {
  const most = Math.max(...b.quaternion.map(Math.abs)), [x, y, z, w] = b.quaternion.map((c) => c / most);
  return `<body pos="${b.at.join(" ")}" quat="${w} ${x} ${y} ${z}"><freejoint/>`
    + `<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><geom ${geom(b, name)}/></body>`;
};
function ask() {
  const model = mujoco.MjModel.from_xml_string(`<mujoco><option>@FLAGS@</option>
    <asset>${mesh(bodies.a, "a")}${mesh(bodies.b, "b")}</asset>
    <worldbody>${body(bodies.a, "a")}${body(bodies.b, "b")}</worldbody></mujoco>`);
  const data = new mujoco.MjData(model);
  mujoco.mj_kinematics(model, data);
@QUESTION@}
)";

constexpr std::string_view distance =
    R"(  return { distance: mujoco.mj_geomDistance(model, data, 0, 1, 1e10, null) };
)";
// MuJoCo's normal points from the first geom of the contact to the second.
constexpr std::string_view contact = R"(  mujoco.mj_collision(model, data);
  const all = data.contact, found = [];
  for (let i = 0; i < data.ncon; ++i) {
    const c = all.get(i), normal = Array.from(c.frame.slice(0, 3)); // it points from geom1 to geom2
    found.push({ depth: -c.dist, normal: c.geom1 === 0 ? normal : normal.map((x) => -x) });
  }
  return { overlap: found.length > 0, ...found.reduce((x, y) => (y.depth > x.depth ? y : x), { depth: -Infinity }) };
)";

std::string flags(std::string_view engine) {
  if (engine == "mujoco-single") return R"(<flag multiccd="disable"/>)";
  return engine == "mujoco-libccd" ? R"(<flag nativeccd="disable"/>)" : "";
}

EngineSource source(const EngineQuestion& q) {
  if (q.question == Question::time_of_impact)
    throw InputError("reproduce", "MuJoCo does not answer this question");
  for (const int i : {q.a, q.b})
    if (std::holds_alternative<HalfSpace>(q.scene.shape_of(i)))
      throw InputError("reproduce", "for MuJoCo no program with a half-space is written");
  EngineSource s;
  s.npm_package = "@mujoco/mujoco";
  s.includes = "import load from \"@mujoco/mujoco\";\nconst mujoco = await load();\n";
  s.code = filled(code, {{"FLAGS", flags(q.engine)},
                         {"QUESTION", std::string(q.question == Question::distance ? distance : contact)}});
  return s;
}

}  // namespace

SourceWriter mujoco_source_writer() { return {{"mujoco", "mujoco-"}, source}; }

}  // namespace touchstone::fuzz
