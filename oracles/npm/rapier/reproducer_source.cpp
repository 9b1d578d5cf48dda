#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view includes = R"(import rapier from "@dimforge/rapier3d-compat";
await rapier.init();
)";

constexpr std::string_view code =
    R"(const xyz = ([x, y, z]) => ({ x, y, z }), list = ({ x, y, z }) => [x, y, z];
const xyzw = ([x, y, z, w]) => ({ x, y, z, w });
const shape = (s) => ({
  sphere: () => new rapier.Ball(s.radius),
  box: () => new rapier.Cuboid(...s.half_extents),
  capsule: () => new rapier.Capsule(s.half_height, s.radius),
  cylinder: () => new rapier.Cylinder(s.half_height, s.radius),
  cone: () => new rapier.Cone(s.half_height, s.radius),
  half_space: () => new rapier.HalfSpace(xyz(s.normal.map((x) => x / Math.hypot(...s.normal)))),
  hull: () => new rapier.ConvexPolyhedron(new Float32Array(s.vertices.flat())),
@MESHES@}[s.type]());
@FIELD@function ask() {
  const place = (body) => ({ shape: shape(body.shape), t: xyz(body.at), q: xyzw(turn(body)) });
  const p = place(bodies.a), q = place(bodies.b);
@QUESTION@}
)";

constexpr std::string_view mesh_entries =
    R"(  mesh: () => new rapier.TriMesh(new Float32Array(s.vertices.flat()), new Uint32Array(s.triangles.flat())),
  field: () => field(s),
)";
constexpr std::string_view field_function =
    R"(// A matrix by columns; its rows are along Rapier's z, the -y of the bodies above. Its size is given in cells.
function field({ rows, columns, cell, heights }) {
  const matrix = new Float32Array(rows * columns);
  heights.forEach((h, k) => { matrix[(k % columns) * rows + rows - 1 - Math.floor(k / columns)] = h; });
  return new rapier.Heightfield(rows - 1, columns - 1, matrix, { x: cell[0] * (columns - 1), y: 1, z: cell[1] * (rows - 1) });
}
)";

constexpr std::string_view overlap =
    "  return { overlap: p.shape.intersectsShape(p.t, p.q, q.shape, q.t, q.q) };\n";
constexpr std::string_view contact = R"(  const c = p.shape.contactShape(p.t, p.q, q.shape, q.t, q.q, 0);
  if (!c || c.distance > 0) return { overlap: false };
  return { overlap: true, normal: list(c.normal1), depth: -c.distance };
)";
constexpr std::string_view distance = R"(  const c = p.shape.contactShape(p.t, p.q, q.shape, q.t, q.q, 1e15);
  return { distance: c ? c.distance : NaN };
)";
// What follows the two shapes depends on the release: the distance to stop at, the latest time, whether
// shapes that start in contact are reported.
constexpr std::string_view cast =
    R"(  const moved = xyz(@MOVED@), still = xyz([0, 0, 0]); // of A, as seen from B
  const last = { 8: [1], 9: [1, true], 10: [0, 1, true], 11: [0, 1, true] }[p.shape.castShape.length];
  const hit = p.shape.castShape(p.t, p.q, moved, q.shape, q.t, q.q, still, ...last);
  return { impact: hit ? (hit.time_of_impact ?? hit.toi) : null };
)";

std::string question(const EngineQuestion& q) {
  if (q.question == Question::overlap) return std::string(overlap);
  if (q.question == Question::contact) return std::string(contact);
  if (q.question == Question::distance) return std::string(distance);
  return filled(cast, {{"MOVED", js_relative_translation(q)}});
}

EngineSource source(const EngineQuestion& q) {
  for (const int i : {q.a, q.b}) {
    const Shape& shape = q.scene.shape_of(i);
    if (kind_of(shape) == ShapeKind::ellipsoid) throw InputError("reproduce", "Rapier has no ellipsoid");
    if (const auto* plane = std::get_if<HalfSpace>(&shape); plane && plane->offset != 0)
      throw InputError("reproduce", "Rapier's half-space passes through its origin");
  }
  const bool has_mesh = is_mesh(q.scene.shape_of(q.a)) || is_mesh(q.scene.shape_of(q.b));
  EngineSource s;
  s.npm_package = "@dimforge/rapier3d-compat";
  s.makes_meshes = true;
  s.includes = includes;
  s.code = std::string(js_unit) + std::string(js_turn_from_y) +
           filled(code, {{"MESHES", std::string(has_mesh ? mesh_entries : "")},
                         {"FIELD", std::string(has_mesh ? field_function : "")},
                         {"QUESTION", question(q)}});
  return s;
}

}  // namespace

SourceWriter rapier_source_writer() { return {{"rapier"}, source}; }

}  // namespace touchstone::fuzz
