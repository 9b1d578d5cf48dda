#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

// The package is built for browsers and refuses to load where it finds a `process`.
constexpr std::string_view includes = R"(import { readFileSync } from "node:fs";
import load from "physx-js-webidl";
const node = globalThis.process;
globalThis.process = undefined;
globalThis.WorkerGlobalScope = Object;
const px = await load({ wasmBinary: readFileSync("node_modules/physx-js-webidl/physx-js-webidl.wasm") });
globalThis.process = node;
)";

constexpr std::string_view code =
    R"(const top = px.PxTopLevelFunctions.prototype, cores = px.PxConvexCoreGeometryFactory.prototype;
const foundation = top.CreateFoundation(top.PHYSICS_VERSION, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
const vec = (v) => new px.PxVec3(...v);
function cooked(vertices) {
  const points = new px.Vector_PxVec3(vertices.length), desc = new px.PxConvexMeshDesc();
  vertices.forEach((v, i) => ["x", "y", "z"].forEach((c, k) => (points.at(i)[c] = v[k])));
  [desc.points.count, desc.points.stride, desc.points.data] = [vertices.length, 12, points.data()];
  desc.flags = new px.PxConvexFlags(px.PxConvexFlagEnum.eCOMPUTE_CONVEX);
  return top.CreateConvexMesh(new px.PxCookingParams(new px.PxTolerancesScale()), desc);
}
const geometry = ({ shape: s }) => ({
  sphere: () => new px.PxSphereGeometry(s.radius),
  box: () => new px.PxBoxGeometry(...s.half_extents),
  capsule: () => new px.PxCapsuleGeometry(s.radius, s.half_height),
  cylinder: () => cores.createFromCylinder(new px.PxConvexCoreCylinder(2 * s.half_height, s.radius), 0),
  cone: () => cores.createFromCone(new px.PxConvexCoreCone(2 * s.half_height, s.radius), 0),
  ellipsoid: () => cores.createFromEllipsoid(new px.PxConvexCoreEllipsoid(...s.semi_axes), 0),
  hull: () => new px.PxConvexMeshGeometry(cooked(s.vertices)),
}[s.type]());
const support_mapping = (b) => ({
  sphere: () => new px.SphereSupport(b.shape.radius),
  capsule: () => new px.CapsuleSupport(b.shape.radius, b.shape.half_height),
  box: () => new px.BoxSupport(vec(b.shape.half_extents), 0),
  hull: () => new px.ConvexMeshSupport(cooked(b.shape.vertices)),
}[b.shape.type] ?? (() => new px.ConvexGeomSupport(geometry(b), 0)))();
// Axes of PhysX's shapes are x; those of the bodies are z.
function pose(b) {
  const [x, y, z, w] = unit(b), h = Math.SQRT1_2;
  const turned = ["capsule", "cylinder", "cone"].includes(b.shape.type) ? [x + z, y - w, z - x, w + y].map((c) => c * h) : [x, y, z, w];
  return new px.PxTransform(vec(b.at), new px.PxQuat(...turned));
}
function ask() {
  const { a, b } = bodies;
@QUESTION@}
)";

constexpr std::string_view overlap =
    R"(  return { overlap: px.PxGeometryQuery.prototype.overlap(geometry(a), pose(a), geometry(b), pose(b)) };
)";
constexpr std::string_view sweep =
    R"(  const hit = new px.PxSweepHit(), moved = @MOVED@, length = Math.hypot(...moved); // of A, as seen from B
  const found = px.PxGeometryQuery.prototype.sweep(vec(moved.map((c) => c / length)), length, geometry(a), pose(a),
    geometry(b), pose(b), hit);
  return { impact: found ? hit.distance / length : null };
)";
constexpr std::string_view gjk_overlap =
    R"(  return { overlap: px.PxGjkQuery.prototype.overlap(support_mapping(a), support_mapping(b), pose(a), pose(b)) };
)";
constexpr std::string_view gjk_sweep =
    R"(  const hit = new px.PxGjkQuerySweepResult(), moved = @MOVED@.map((c) => -c), length = Math.hypot(...moved); // of B
  const found = px.PxGjkQuery.prototype.sweep(support_mapping(a), support_mapping(b), pose(a), pose(b),
    vec(moved.map((c) => c / length)), length, hit);
  return { impact: found ? hit.t / length : null };
)";
// Moving B along PhysX's axis by the separation makes the bodies touch: it points from B to A.
constexpr std::string_view gjk_proximity = R"(  const r = new px.PxGjkQueryProximityInfoResult();
  const found = px.PxGjkQuery.prototype.proximityInfo(support_mapping(a), support_mapping(b), pose(a), pose(b), @REACH@, 1, r);
  const normal = [r.separatingAxis.x, r.separatingAxis.y, r.separatingAxis.z].map((c) => -c); // from A to B
  return { overlap: found && r.separation <= 0, distance: found ? r.separation : NaN, depth: -r.separation, normal };
)";

std::string question(const EngineQuestion& q) {
  const bool gjk = q.engine == "physx-gjk";
  if (q.question == Question::time_of_impact)
    return filled(gjk ? gjk_sweep : sweep, {{"MOVED", js_relative_translation(q)}});
  if (q.question == Question::overlap) return std::string(gjk ? gjk_overlap : overlap);
  return filled(gjk_proximity, {{"REACH", q.question == Question::distance ? "1e15" : "0"}});
}

EngineSource source(const EngineQuestion& q) {
  const bool measures = q.question != Question::overlap && q.question != Question::time_of_impact;
  if (q.engine == "physx-query" && measures)
    throw InputError("reproduce", "physx-query does not answer this question");
  for (const int i : {q.a, q.b})
    if (std::holds_alternative<HalfSpace>(q.scene.shape_of(i)))
      throw InputError("reproduce", "for PhysX no program with a half-space is written");
  EngineSource s;
  s.npm_package = "physx-js-webidl";
  s.includes = includes;
  s.code = std::string(js_unit) + filled(code, {{"QUESTION", question(q)}});
  return s;
}

}  // namespace

SourceWriter physx_source_writer() { return {{"physx-query", "physx-gjk"}, source}; }

}  // namespace touchstone::fuzz
