#include "core/base/input_error.h"
#include "oracles/reproducer/engine_source.h"
#include "oracles/reproducer/source_text.h"

namespace touchstone::fuzz {
namespace {

constexpr std::string_view includes = "import load from \"jolt-physics\";\nconst Jolt = await load();\n";

constexpr std::string_view code =
    R"(// A physics system, which registers the shapes' functions.
const world = new Jolt.JoltSettings(), table = new Jolt.ObjectLayerPairFilterTable(1);
const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
world.mObjectLayerPairFilter = table;
world.mBroadPhaseLayerInterface = layers;
world.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, table, 1);
new Jolt.JoltInterface(world);

const vec = (v) => new Jolt.Vec3(...v), rvec = (v) => new Jolt.RVec3(...v);
const list = (v) => [v.GetX(), v.GetY(), v.GetZ()];
const radius = (...extents) => @RADIUS@; // by which edges are rounded
const settings = (s) => ({
  sphere: () => new Jolt.SphereShapeSettings(s.radius),
  box: () => new Jolt.BoxShapeSettings(vec(s.half_extents), radius(...s.half_extents)),
  capsule: () => new Jolt.CapsuleShapeSettings(s.half_height, s.radius),
  cylinder: () => new Jolt.CylinderShapeSettings(s.half_height, s.radius, radius(s.half_height, s.radius)),
  cone: () => new Jolt.TaperedCylinderShapeSettings(s.half_height, 0, s.radius, 0),
  hull: () => {
    const hull = new Jolt.ConvexHullShapeSettings();
    for (const v of s.vertices) hull.mPoints.push_back(vec(v));
@HULL@    return hull;
  },
@MESHES@}[s.type]());
@FIELD@// Jolt positions a shape by its centre of mass. A matrix that a function returns is overwritten by its next call.
function placed(body) {
  const shape = settings(body.shape).Create().Get(), rotation = new Jolt.Quat(...@TURN@(body)), at = new Jolt.RMat44();
  shape.AddRef();
  const m = Jolt.RMat44.prototype.sRotationTranslation(rotation, rvec(body.at)).PreTranslated(shape.GetCenterOfMass());
  const [x, y, z, t] = [m.GetAxisX(), m.GetAxisY(), m.GetAxisZ(), m.GetTranslation()].map(list);
  at.SetAxisX(vec(x));
  at.SetAxisY(vec(y));
  at.SetAxisZ(vec(z));
  at.SetTranslation(rvec(t));
  return { shape, rotation, at, centre: t };
}
const one = new Jolt.Vec3(1, 1, 1), origin = new Jolt.RVec3(0, 0, 0), every_shape = new Jolt.ShapeFilter();
function transformed(p) {
  const t = new Jolt.TransformedShape();
  t.mShape = p.shape;
  t.mShapeRotation = p.rotation;
  t.mShapePositionCOM = rvec(p.centre);
  return t;
}
function ask() {
  const p = placed(bodies.a), q = placed(bodies.b);
@QUESTION@}
)";

constexpr std::string_view mesh_entries = R"(  mesh: () => {
    const all = new Jolt.TriangleList();
    for (const t of s.triangles) all.push_back(new Jolt.Triangle(...t.map((k) => vec(s.vertices[k]))));
    return new Jolt.MeshShapeSettings(all);
  },
  field: () => field(s),
)";
// With a bound of the distance of a mesh from its origin, about which it may be anywhere.
constexpr std::string_view field_functions =
    R"(// Jolt's x, y, z are the y, z, x of the bodies above. Its fields are square: what is missing is a gap.
function field({ rows, columns, cell, heights }) {
  const made = new Jolt.HeightFieldShapeSettings(), n = 2 * Math.max(2, Math.ceil(Math.max(rows, columns) / 2));
  const gap = Jolt.HeightFieldShapeConstantValues.prototype.cNoCollisionValue;
  made.mSampleCount = n;
  made.mBlockSize = 2;
  made.mBitsPerSample = @BITS@;
  made.mOffset = vec([-cell[1] * (rows - 1) / 2, 0, -cell[0] * (columns - 1) / 2]);
  made.mScale = vec([cell[1], 1, cell[0]]);
  for (let c = 0; c < n; ++c)
    for (let r = 0; r < n; ++r) made.mHeightSamples.push_back(r < rows && c < columns ? heights[r * columns + c] : gap);
  return made;
}
function turn_of(body) {
  const [x, y, z, w] = unit(body), cycled = [w + x + y - z, w - x + y + z, w + x - y + z, w - x - y - z];
  return body.shape.type === "field" ? cycled.map((c) => c / 2) : turn(body);
}
const farthest = (body) => Math.max(0, ...(body.shape.vertices ?? []).map((v) => Math.hypot(...v)),
  ...(body.shape.heights ?? []).map((h) => Math.hypot(h, body.shape.cell[0] * body.shape.columns, body.shape.cell[1] * body.shape.rows)));
)";

// Apart, closest points are found up to a distance. Without one, shallow depths are the most exact.
constexpr std::string_view collide = R"(  const collide = (most) => {
    const settings = new Jolt.CollideShapeSettings(), found = new Jolt.CollideShapeClosestHitCollisionCollector();
    settings.mCollisionTolerance = settings.mPenetrationTolerance = @TOLERANCE@;
    settings.mMaxSeparationDistance = most;
@FACES@    transformed(q).CollideShape(p.shape, one, p.at, settings, origin, found, every_shape);
    return found.HadHit() ? found.mHit : null;
  };
)";
constexpr std::string_view contact = R"(  const hit = collide(0);
  if (!hit) return { overlap: false };
  const axis = list(hit.mPenetrationAxis), normal = axis.map((x) => x / Math.hypot(...axis));
  return { overlap: true, normal, depth: hit.mPenetrationDepth };
)";
constexpr std::string_view distance =
    R"(  const hit = collide(0) ?? collide(1.001 * Math.hypot(...p.centre.map((c, k) => c - q.centre[k]))@FAR@);
  return { distance: hit ? -hit.mPenetrationDepth : NaN };
)";
constexpr std::string_view cast = R"(  const settings = new Jolt.ShapeCastSettings();
  settings.mCollisionTolerance = settings.mPenetrationTolerance = @TOLERANCE@;
@BACK@  const found = new Jolt.CastShapeClosestHitCollisionCollector(), moved = vec(@MOVED@); // of A, as seen from B
  transformed(q).CastShape(new Jolt.RShapeCast(p.shape, one, p.at, moved), settings, origin, found, every_shape);
  return { impact: found.HadHit() ? Math.max(0, found.mHit.mFraction) : null };
)";

// "a" or "b", the body with a mesh; empty: neither.
std::string mesh_of(const EngineQuestion& q) {
  for (const int i : {q.a, q.b})
    if (is_mesh(q.scene.shape_of(i))) return i == q.a ? "a" : "b";
  return "";
}

std::string question(const EngineQuestion& q) {
  const std::string tolerance = q.tuned() ? "1e-7" : "1e-4", mesh = mesh_of(q);
  if (q.question != Question::time_of_impact) {
    const std::string_view faces = "    settings.mBackFaceMode = Jolt.EBackFaceMode_CollideWithBackFaces;\n";
    const std::string far = mesh.empty() ? "" : " + farthest(bodies." + mesh + ")";
    return filled(collide, {{"TOLERANCE", tolerance}, {"FACES", mesh.empty() ? "" : std::string(faces)}}) +
           (q.question == Question::distance ? filled(distance, {{"FAR", far}}) : std::string(contact));
  }
  if (mesh == "a") throw InputError("reproduce", "Jolt casts no meshes");
  const auto faces = [](const char* of) {
    return std::string("  settings.mBackFaceMode") + of + " = Jolt.EBackFaceMode_CollideWithBackFaces;\n";
  };
  return filled(cast, {{"TOLERANCE", tolerance},
                       {"BACK", (q.tuned() ? faces("Convex") : "") +
                                    (q.tuned() || !mesh.empty() ? faces("Triangles") : "")},
                       {"MOVED", js_relative_translation(q)}});
}

EngineSource source(const EngineQuestion& q) {
  for (const int i : {q.a, q.b}) {
    const ShapeKind kind = kind_of(q.scene.shape_of(i));
    if (kind == ShapeKind::half_space || kind == ShapeKind::ellipsoid)
      throw InputError("reproduce", "for Jolt no programs with half-spaces or ellipsoids are written");
  }
  const bool has_mesh = !mesh_of(q).empty();
  EngineSource s;
  s.npm_package = "jolt-physics";
  s.makes_meshes = true;
  s.includes = includes;
  s.code =
      std::string(js_unit) + std::string(js_turn_from_y) +
      filled(code, {{"MESHES", has_mesh ? std::string(mesh_entries) : ""},
                    {"FIELD", has_mesh ? filled(field_functions, {{"BITS", q.tuned() ? "16" : "8"}}) : ""},
                    {"TURN", has_mesh ? "turn_of" : "turn"},
                    {"RADIUS", q.tuned() ? "0" : "Math.min(0.05, ...extents)"},
                    {"HULL", q.tuned() ? "    hull.mMaxConvexRadius = hull.mHullTolerance = 0;\n"
                                       : "    hull.mHullTolerance = 1e-3;\n"},
                    {"QUESTION", question(q)}});
  return s;
}

}  // namespace

SourceWriter jolt_source_writer() { return {{"jolt", "jolt-tuned"}, source}; }

}  // namespace touchstone::fuzz
