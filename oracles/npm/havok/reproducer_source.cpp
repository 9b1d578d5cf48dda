#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view includes = R"(import { readFileSync } from "node:fs";
import load from "@babylonjs/havok";
const hk = await load({ wasmBinary: readFileSync("node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm") });
)";

constexpr std::string_view code = R"(function made([code, value]) {
  if (code !== hk.Result.RESULT_OK) throw new Error("Havok refuses");
  return value;
}
function hull(vertices) {
  const at = hk._malloc(12 * vertices.length);
  new Float32Array(hk.HEAPU8.buffer, at, 3 * vertices.length).set(vertices.flat());
  return hk.HP_Shape_CreateConvexHull(at, vertices.length);
}
const shape = ({ shape: s }) => made({
  sphere: () => hk.HP_Shape_CreateSphere([0, 0, 0], s.radius),
  box: () => hk.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], s.half_extents.map((x) => 2 * x)),
  capsule: () => hk.HP_Shape_CreateCapsule([0, 0, -s.half_height], [0, 0, s.half_height], s.radius),
  cylinder: () => hk.HP_Shape_CreateCylinder([0, 0, -s.half_height], [0, 0, s.half_height], s.radius),
  hull: () => hull(s.vertices),
}[s.type]());
function ask() {
  const { a, b } = bodies, world = made(hk.HP_World_Create()), hits = made(hk.HP_QueryCollector_Create(1));
  const body = made(hk.HP_Body_Create());
  hk.HP_Body_SetShape(body, shape(@STANDS@));
  hk.HP_Body_SetMotionType(body, hk.MotionType.STATIC);
  hk.HP_Body_SetQTransform(body, [@STANDS@.at, unit(@STANDS@)]);
  hk.HP_World_AddBody(world, body, false);
@QUESTION@}
)";

constexpr std::string_view proximity =
    R"(  hk.HP_World_ShapeProximityWithCollector(world, hits, [shape(b), b.at, unit(b), @REACH@, false, [0n]]);
  if (made(hk.HP_QueryCollector_GetNumHits(hits)) === 0) return { overlap: false, distance: NaN };
  const [distance, , on_a] = made(hk.HP_QueryCollector_GetShapeProximityResult(hits, 0)), normal = on_a[4];
  return { overlap: @SAYS@, distance, depth: -distance, normal };
)";
constexpr std::string_view cast = R"(  const moved = @MOVED@; // of A, as seen from B
  hk.HP_World_ShapeCastWithCollector(world, hits, [shape(a), unit(a), a.at, a.at.map((c, k) => c + moved[k]), false, [0n]]);
  if (made(hk.HP_QueryCollector_GetNumHits(hits)) === 0) return { impact: null };
  return { impact: made(hk.HP_QueryCollector_GetShapeCastResult(hits, 0))[0] };
)";

std::string question(const EngineQuestion& q) {
  if (q.question != Question::time_of_impact)
    return filled(proximity, {{"REACH", q.question == Question::distance ? "1e4" : "0"},
                              {"SAYS", q.question == Question::overlap ? "true" : "distance <= 0"}});
  return filled(cast, {{"MOVED", js_relative_translation(q)}});
}

EngineSource source(const EngineQuestion& q) {
  for (const int i : {q.a, q.b}) {
    const ShapeKind kind = kind_of(q.scene.shape_of(i));
    if (kind == ShapeKind::half_space || kind == ShapeKind::cone || kind == ShapeKind::ellipsoid)
      throw InputError("reproduce", "Havok has no such shape");
  }
  EngineSource s;
  s.npm_package = "@babylonjs/havok";
  s.includes = includes;
  s.code =
      std::string(js_unit) + filled(code, {{"STANDS", q.question == Question::time_of_impact ? "b" : "a"},
                                           {"QUESTION", question(q)}});
  return s;
}

}  // namespace

SourceWriter havok_source_writer() { return {{"havok"}, source}; }

}  // namespace touchstone::fuzz
