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
}[s.type]());
// Jolt positions a shape by its centre of mass. A matrix that a function returns is overwritten by its next call.
function placed(body) {
  const shape = settings(body.shape).Create().Get(), rotation = new Jolt.Quat(...turn(body)), at = new Jolt.RMat44();
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

// Apart, closest points are found up to a distance. Without one, shallow depths are the most exact.
constexpr std::string_view collide = R"(  const collide = (most) => {
    const settings = new Jolt.CollideShapeSettings(), found = new Jolt.CollideShapeClosestHitCollisionCollector();
    settings.mCollisionTolerance = settings.mPenetrationTolerance = @TOLERANCE@;
    settings.mMaxSeparationDistance = most;
    transformed(q).CollideShape(p.shape, one, p.at, settings, origin, found, every_shape);
    return found.HadHit() ? found.mHit : null;
  };
)";
constexpr std::string_view contact = R"(  const hit = collide(0);
  if (!hit) return { overlap: false };
  const axis = list(hit.mPenetrationAxis), normal = axis.map((x) => x / Math.hypot(...axis));
  return { overlap: true, normal, depth: hit.mPenetrationDepth };
)";
constexpr std::string_view distance =
    R"(  const hit = collide(0) ?? collide(1.001 * Math.hypot(...p.centre.map((c, k) => c - q.centre[k])));
  return { distance: hit ? -hit.mPenetrationDepth : NaN };
)";
constexpr std::string_view cast = R"(  const settings = new Jolt.ShapeCastSettings();
  settings.mCollisionTolerance = settings.mPenetrationTolerance = @TOLERANCE@;
@BACK@  const found = new Jolt.CastShapeClosestHitCollisionCollector(), moved = vec(@MOVED@); // of A, as seen from B
  transformed(q).CastShape(new Jolt.RShapeCast(p.shape, one, p.at, moved), settings, origin, found, every_shape);
  return { impact: found.HadHit() ? Math.max(0, found.mHit.mFraction) : null };
)";

std::string question(const EngineQuestion& q) {
  const std::string tolerance = q.tuned() ? "1e-7" : "1e-4";
  if (q.question != Question::time_of_impact)
    return filled(collide, {{"TOLERANCE", tolerance}}) +
           std::string(q.question == Question::distance ? distance : contact);
  return filled(cast,
                {{"TOLERANCE", tolerance},
                 {"BACK", q.tuned() ? "  settings.mBackFaceModeConvex = settings.mBackFaceModeTriangles = "
                                      "Jolt.EBackFaceMode_CollideWithBackFaces;\n"
                                    : ""},
                 {"MOVED", js_relative_translation(q)}});
}

EngineSource source(const EngineQuestion& q) {
  for (const int i : {q.a, q.b}) {
    const ShapeKind kind = kind_of(q.scene.shape_of(i));
    if (kind == ShapeKind::half_space || kind == ShapeKind::ellipsoid)
      throw InputError("reproduce", "for Jolt no programs with half-spaces or ellipsoids are written");
  }
  EngineSource s;
  s.npm_package = "jolt-physics";
  s.includes = includes;
  s.code = std::string(js_unit) + std::string(js_turn_from_y) +
           filled(code, {{"RADIUS", q.tuned() ? "0" : "Math.min(0.05, ...extents)"},
                         {"HULL", q.tuned() ? "    hull.mMaxConvexRadius = hull.mHullTolerance = 0;\n"
                                            : "    hull.mHullTolerance = 1e-3;\n"},
                         {"QUESTION", question(q)}});
  return s;
}

}  // namespace

SourceWriter jolt_source_writer() { return {{"jolt", "jolt-tuned"}, source}; }

}  // namespace touchstone::fuzz
