#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view code = R"(const vec = (v) => new cannon.Vec3(...v);
function made(placed) {
  const { shape: s, at } = placed, quaternion = new cannon.Quaternion(...unit(placed));
  const body = new cannon.Body({ mass: 1, position: vec(at), quaternion });
  body.addShape(s.type === "sphere" ? new cannon.Sphere(s.radius) : new cannon.Box(vec(s.half_extents)));
  return body;
}
function ask() {
  const [a, b] = [bodies.a, bodies.b].map(made), world = new cannon.World(), found = [];
  world.narrowphase.getContacts([a], [b], world, found, [], [], []);
  // The deepest point: a normal from bi to bj, and points on both, relative to the bodies.
  const points = found.map(({ bi, bj, ni, ri, rj }) => ({
    normal: bi === a ? ni : ni.negate(),
    depth: ni.dot(bi.position.vadd(ri)) - ni.dot(bj.position.vadd(rj)),
  }));
  if (points.length === 0) return { overlap: false };
  const { normal, depth } = points.reduce((p, q) => (q.depth > p.depth ? q : p));
  return { overlap: true, normal: [normal.x, normal.y, normal.z], depth };
}
)";

EngineSource source(const EngineQuestion& q) {
  if (q.question != Question::overlap && q.question != Question::contact)
    throw InputError("reproduce", "cannon-es answers overlap and contact only");
  for (const int i : {q.a, q.b}) {
    const ShapeKind kind = kind_of(q.scene.shape_of(i));
    if (kind != ShapeKind::sphere && kind != ShapeKind::box)
      throw InputError("reproduce", "for cannon-es programs with spheres and boxes are written");
  }
  EngineSource s;
  s.npm_package = "cannon-es";
  s.includes = "import * as cannon from \"cannon-es\";\n";
  s.code = std::string(js_unit) + std::string(code);
  return s;
}

}  // namespace

SourceWriter cannon_source_writer() { return {{"cannon"}, source}; }

}  // namespace touchstone::fuzz
