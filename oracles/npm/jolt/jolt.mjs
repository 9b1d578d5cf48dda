// Jolt Physics (npm jolt-physics) behind a pipe:  node jolt.mjs FOLDER [tuned]
// Narrow phase through TransformedShape (CollideShape, CastShape), broad phase through BroadPhaseQuery::CollideAABox
// with each body's own bounds. Tuned: convex radius 0, tolerances 1e-7.
import * as kit from "../adapter.mjs";

const [modules, how] = process.argv.slice(2);
const tuned = how === "tuned";
const Jolt = await (await kit.from(modules, "jolt-physics")).default({ print: console.error, printErr: console.error });

// Jolt.h: cDefaultConvexRadius, cDefaultCollisionTolerance, cDefaultPenetrationTolerance; ConvexHullShape.h.
const default_radius = 0.05, hull_tolerance = tuned ? 0 : 1e-3, tolerance = tuned ? 1e-7 : 1e-4;
const reach_slack = 1.001; // on the search distance, so that rounding does not lose the closest points

// Objects on the WASM heap live until they are destroyed.
let garbage = [];
function keep(x) {
  garbage.push(x);
  return x;
}
function sweep() {
  garbage.forEach((x) => Jolt.destroy(x));
  garbage = [];
}
const vec = (v) => keep(new Jolt.Vec3(...v));
const rvec = (v) => keep(new Jolt.RVec3(...v));
const list = (v) => [v.GetX(), v.GetY(), v.GetZ()];

function make_world() {
  const settings = new Jolt.JoltSettings();
  const pairs = new Jolt.ObjectLayerPairFilterTable(1), layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  pairs.EnableCollision(0, 0);
  layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  settings.mMaxWorkerThreads = 0;
  return new Jolt.JoltInterface(settings);
}
const physics = make_world().GetPhysicsSystem(), bodies = physics.GetBodyInterface();
const every_layer = new Jolt.BroadPhaseLayerFilter(), every_object = new Jolt.ObjectLayerFilter();
const every_shape = new Jolt.ShapeFilter(), no_turn = new Jolt.Quat(0, 0, 0, 1), one = new Jolt.Vec3(1, 1, 1), origin = new Jolt.RVec3(0, 0, 0);

function settings_of(s) {
  const convex = (most) => (tuned ? 0 : Math.min(default_radius, most));
  switch (s.type) {
    case "sphere": return new Jolt.SphereShapeSettings(s.radius);
    case "box": return new Jolt.BoxShapeSettings(vec(s.half_extents), convex(Math.min(...s.half_extents)));
    case "capsule": return new Jolt.CapsuleShapeSettings(s.half_height, s.radius);
    case "cylinder": return new Jolt.CylinderShapeSettings(s.half_height, s.radius, convex(Math.min(s.half_height, s.radius)));
    case "cone": return new Jolt.TaperedCylinderShapeSettings(s.half_height, 0, s.radius, 0);
    case "hull": {
      const hull = new Jolt.ConvexHullShapeSettings();
      for (const v of s.vertices) hull.mPoints.push_back(vec(v));
      if (tuned) hull.mMaxConvexRadius = 0;
      hull.mHullTolerance = hull_tolerance;
      return hull;
    }
    case "mesh": return field_settings(s) ?? mesh_settings(s);
    default: throw new kit.Unsupported(`the adapter does not support Jolt's ${s.type}`);
  }
}
function mesh_settings({ vertices, triangles }) {
  const list = keep(new Jolt.TriangleList());
  for (const t of triangles) list.push_back(keep(new Jolt.Triangle(...t.map((k) => vec(vertices[k])))));
  return new Jolt.MeshShapeSettings(list);
}
// Jolt's x, y, z are our y, z, x here, so that its cells have the same diagonal. Its fields are square: what is
// missing is a gap. HeightFieldShape.h: mSampleCount is at least twice mBlockSize.
const block_size = 2, height_bits = tuned ? 16 : 8;
const is_field = (s) => kit.height_field_of(s) !== null;
function field_settings(s) {
  const field = kit.height_field_of(s);
  if (!field) return null;
  const { rows, columns, cell } = field, blocks = Math.max(2, Math.ceil(Math.max(rows, columns) / block_size));
  const made = new Jolt.HeightFieldShapeSettings(), n = made.mSampleCount = block_size * blocks;
  const gap = Jolt.HeightFieldShapeConstantValues.prototype.cNoCollisionValue;
  made.mBlockSize = block_size;
  made.mBitsPerSample = height_bits;
  made.mOffset = vec([-cell[1] * (rows - 1) / 2, 0, -cell[0] * (columns - 1) / 2]);
  made.mScale = vec([cell[1], 1, cell[0]]);
  for (let c = 0; c < n; ++c)
    for (let r = 0; r < n; ++r) made.mHeightSamples.push_back(r < rows && c < columns ? s.vertices[r * columns + c][2] : gap);
  return made;
}

// The triangles that Jolt holds: those of a mesh with coordinates of 21 bits, and none without area.
function held_triangles(shape, of_field) {
  const all = new Jolt.ShapeGetTriangles(shape, Jolt.AABox.prototype.sBiggest(), vec([0, 0, 0]), no_turn, one);
  const numbers = new Float32Array(Jolt.HEAPF32.buffer, all.GetVerticesData(), 9 * all.GetNumTriangles()).slice();
  Jolt.destroy(all);
  const vertices = [], triangles = [];
  for (let k = 0; k < numbers.length; k += 3) {
    const [x, y, z] = numbers.slice(k, k + 3);
    vertices.push(of_field ? [z, x, y] : [x, y, z]);
    if (k % 9 === 0) triangles.push([0, 1, 2].map((i) => k / 3 + i));
  }
  return { type: "mesh", vertices, triangles };
}

function make_shape(s) {
  const settings = settings_of(s), made = settings.Create();
  if (made.HasError()) throw new kit.Unsupported(`Jolt refuses the ${s.type}: ${made.GetError().c_str()}`);
  const shape = made.Get();
  shape.AddRef();
  Jolt.destroy(settings);
  return shape;
}

// How far a rounded corner, edge or rim may fall short, and a hull's points may stick out.
const height_step = ({ vertices }) => { // HeightFieldShape.h, mBitsPerSample
  const [lo, hi] = vertices.reduce(([x, y], v) => [Math.min(x, v[2]), Math.max(y, v[2])], [Infinity, -Infinity]);
  return (hi - lo) / (2 ** height_bits - 1);
};
function claim_of(s) {
  if (is_field(s)) return height_step(s);
  if (tuned) return 0;
  if (s.type === "hull") return default_radius + hull_tolerance; // mMaxErrorConvexRadius, mHullTolerance
  if (s.type === "box") return (Math.sqrt(3) - 1) * Math.min(default_radius, ...s.half_extents);
  return s.type === "cylinder" ? (Math.SQRT2 - 1) * Math.min(default_radius, s.radius, s.half_height) : 0;
}

let shapes = [], claims = [], reaches = []; // by the numbers of the scene's shapes: Jolt's, what each claims, how far a mesh reaches
const of_body = (list, scene, body) => list[scene.bodies[body].shape];
const shape_of = (scene, body) => of_body(scene.shapes, scene, body);
const rotation_of = (scene, body, pose) => {
  const s = shape_of(scene, body);
  return keep(new Jolt.Quat(...(is_field(s) ? kit.unit_quaternion_cycled(pose.rotation) : kit.unit_quaternion(pose.rotation, kit.stands_on_z(s)))));
};

// A value returned by a function is overwritten by its next call, so it has to be copied.
function copy_of(m) {
  const out = keep(new Jolt.RMat44());
  for (const axis of "XYZ") out[`SetAxis${axis}`](vec(list(m[`GetAxis${axis}`]())));
  out.SetTranslation(rvec(list(m.GetTranslation())));
  return out;
}
const matrix_of = (rotation, translation) => Jolt.RMat44.prototype.sRotationTranslation(rotation, rvec(translation));

// Jolt positions a shape by its centre of mass.
function placed(scene, body) {
  const { shape: number, pose } = scene.bodies[body], shape = shapes[number], rotation = rotation_of(scene, body, pose);
  return { shape, rotation, mass_centre: copy_of(matrix_of(rotation, pose.translation).PreTranslated(shape.GetCenterOfMass())) };
}
function transformed(p) {
  const t = keep(new Jolt.TransformedShape());
  t.mShape = p.shape;
  t.mShapeRotation = p.rotation;
  t.mShapePositionCOM = rvec(list(p.mass_centre.GetTranslation()));
  return t;
}

// Also finds the closest points of shapes that are apart by no more than `reach`. Jolt inflates one shape by it, and
// 1e15 would leave no digits. The distance between the centres of mass suffices for any, since both shapes contain theirs.
// A mesh may be anywhere about its own.
const farthest_vertex = (s) => (s.type === "mesh" ? s.vertices.reduce((most, v) => Math.max(most, Math.hypot(...v)), 0) : 0);
const any = (x, y) => reach_slack * Math.hypot(...x.map((c, k) => c - y[k]));
const is_mesh = (scene, body) => shape_of(scene, body).type === "mesh";
function collide(scene, a, b, reach) {
  if (is_mesh(scene, a) && is_mesh(scene, b)) throw new kit.Unsupported("Jolt does not collide meshes with meshes");
  const settings = keep(new Jolt.CollideShapeSettings());
  settings.mCollisionTolerance = settings.mPenetrationTolerance = tolerance;
  const found = keep(new Jolt.CollideShapeClosestHitCollisionCollector());
  const [p, q] = [placed(scene, a), placed(scene, b)], [x, y] = [p, q].map((s) => list(s.mass_centre.GetTranslation()));
  settings.mMaxSeparationDistance = reach === any ? any(x, y) + Math.max(...[a, b].map((body) => of_body(reaches, scene, body))) : reach;
  settings.mBackFaceMode = Jolt.EBackFaceMode_CollideWithBackFaces; // a mesh is a surface
  // In the result, shape 1 is the argument and shape 2 the transformed shape.
  transformed(q).CollideShape(p.shape, one, p.mass_centre, settings, origin, found, every_shape);
  return found.HadHit() ? found.mHit : null;
}

const claim = (scene, a, b, depth = 0) =>
  tolerance * (1 + Math.abs(depth)) + of_body(claims, scene, a) + of_body(claims, scene, b);
// First without a search distance, which would spoil shallow depths.
function closest(scene, a, b, reach) {
  const hit = collide(scene, a, b, 0) || collide(scene, a, b, reach);
  const found = hit && { distance: -hit.mPenetrationDepth, point_a: list(hit.mContactPointOn1), point_b: list(hit.mContactPointOn2),
    normal: unit(list(hit.mPenetrationAxis)) };
  sweep();
  return { ...found, claimed_tolerance: claim(scene, a, b, found?.distance ?? (reach === any ? 0 : reach)) };
}
const unit = (axis) => axis.map((x) => x / Math.hypot(...axis));

class World {
  constructor(scene) {
    this.scene = scene;
    this.ids = new Map();
  }
  insert(body, pose) {
    const s = this.scene.bodies[body], at = keep(new Jolt.BodyCreationSettings(shapes[s.shape], rvec(pose.translation),
      rotation_of(this.scene, body, pose), s.static || is_mesh(this.scene, body) ? Jolt.EMotionType_Static : Jolt.EMotionType_Kinematic, 0));
    const made = bodies.CreateBody(at);
    bodies.AddBody(made.GetID(), Jolt.EActivation_DontActivate);
    this.ids.set(body, made);
  }
  move(body, pose) {
    bodies.SetPositionAndRotation(this.ids.get(body).GetID(), rvec(pose.translation),
      rotation_of(this.scene, body, pose), Jolt.EActivation_DontActivate);
  }
  remove(body) {
    const id = this.ids.get(body).GetID();
    bodies.RemoveBody(id);
    bodies.DestroyBody(id);
    this.ids.delete(body);
  }
  pairs(report) {
    const numbers = new Map([...this.ids].map(([body, made]) => [made.GetID().GetIndexAndSequenceNumber(), body]));
    for (const [body, made] of this.ids) {
      const found = keep(new Jolt.CollideShapeBodyCollectorJS());
      found.Reset = () => found.ResetEarlyOutFraction();
      found.AddHit = (id) => report(body, numbers.get(Jolt.wrapPointer(id, Jolt.BodyID).GetIndexAndSequenceNumber()));
      physics.GetBroadPhaseQuery().CollideAABox(made.GetWorldSpaceBounds(), found, every_layer, every_object);
    }
  }
  clear() { // OptimizeBroadPhase releases the tree's unused nodes
    for (const body of [...this.ids.keys()]) this.remove(body);
    physics.OptimizeBroadPhase();
  }
}

const engine = {
  card: {
    batches: true, name: tuned ? "jolt-tuned" : "jolt", library: "Jolt Physics, WASM", version: kit.version(modules, "jolt-physics"),
    settings: tuned ? "CollideShape and CastShape, convex radius 0, tolerances 1e-7, back faces hit; CollideAABox"
      : "CollideShape and CastShape as shipped: convex radius 0.05 or the smallest half extent; CollideAABox",
    source: "PhysicsSettings.h: cDefaultCollisionTolerance, cDefaultPenetrationTolerance, cDefaultConvexRadius; "
      + "ConvexHullShape.h: mMaxErrorConvexRadius, mHullTolerance",
  },
  load(scene) {
    shapes.forEach((s) => s.Release());
    shapes = [];
    for (const s of scene.shapes) shapes.push(make_shape(s));
    claims = scene.shapes.map(claim_of);
    reaches = scene.shapes.map(farthest_vertex);
    const held = scene.bodies.map((b, body) => {
      const m = matrix_of(rotation_of(scene, body, b.pose), b.pose.translation);
      const columns = [list(m.GetAxisX()), list(m.GetAxisY()), list(m.GetAxisZ())];
      const s = shape_of(scene, body), ours = is_field(s) ? [columns[2], columns[0], columns[1]] : columns;
      return kit.received_body(body, b, ours, kit.stands_on_z(s));
    });
    const held_shape = (s, k) => s.type === "mesh"
      ? { shape: k, as: held_triangles(shapes[k], is_field(s)) } : kit.received_shape(s, k);
    const sized = scene.shapes.map(held_shape);
    sweep();
    return { shapes: sized, bodies: held };
  },
  overlap({ a, b }, scene) {
    return { overlap: collide(scene, a, b, 0) !== null, claimed_tolerance: claim(scene, a, b) };
  },
  contact({ a, b }, scene) {
    const hit = collide(scene, a, b, 0), depth = hit ? hit.mPenetrationDepth : 0;
    const answer = hit ? { overlap: true, normal: unit(list(hit.mPenetrationAxis)), depth } : { overlap: false };
    sweep();
    return { ...answer, claimed_tolerance: claim(scene, a, b, depth) };
  },
  distance({ a, b }, scene) {
    const { normal, ...answer } = closest(scene, a, b, any);
    if (answer.distance === undefined) throw new kit.Unsupported("Jolt found no closest points");
    return answer;
  },
  ...kit.margin_questions(closest), // CollideShape.h, mMaxSeparationDistance
  // Of a mesh and a convex shape, the convex one is cast.
  time_of_impact({ a: first, b: second }, scene) {
    const [a, b] = is_mesh(scene, first) ? [second, first] : [first, second];
    if (is_mesh(scene, a)) throw new kit.Unsupported("Jolt casts no meshes");
    const translation = kit.relative_translation(scene.bodies[a], scene.bodies[b]);
    const [p, q] = [placed(scene, a), placed(scene, b)], settings = keep(new Jolt.ShapeCastSettings());
    settings.mCollisionTolerance = settings.mPenetrationTolerance = tolerance;
    settings.mBackFaceModeTriangles = Jolt.EBackFaceMode_CollideWithBackFaces;
    if (tuned) settings.mBackFaceModeConvex = Jolt.EBackFaceMode_CollideWithBackFaces;
    const found = keep(new Jolt.CastShapeClosestHitCollisionCollector());
    const cast = keep(new Jolt.RShapeCast(p.shape, one, p.mass_centre, vec(translation)));
    transformed(q).CastShape(cast, settings, origin, found, every_shape);
    const toi = found.HadHit() ? Math.max(0, found.mHit.mFraction) : null;
    sweep();
    return { toi, claimed_tolerance: claim(scene, a, b) };
  },
  candidates(_, scene) {
    const world = new World(scene);
    try {
      return kit.candidates(scene, world);
    } finally {
      world.clear();
      sweep();
    }
  },
};
kit.serve(engine);
