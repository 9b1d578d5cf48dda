// Havok (npm @babylonjs/havok) behind a pipe:  node havok.mjs FOLDER [sim]
// Queries of a world that holds the first body: shape proximity and shape casts. sim: the collision events of a step of
// bodies at rest. Floats; boxes take full sizes, capsules and cylinders two points. Havok is closed: that a shape is a
// core rounded by a convex radius, and a cylinder a prism, is what HP_Shape_CreateDebugDisplayGeometry (the core) and
// HP_Shape_GetBoundingBox (core and radius) of the shape say, and is reported as such.
import { readFileSync } from "node:fs";
import * as kit from "../adapter.mjs";

const [modules, how = ""] = process.argv.slice(2);
const { default: load_havok } = await kit.from(modules, "@babylonjs/havok");
const wasmBinary = readFileSync(`${modules}/node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm`);
const hk = await load_havok({ wasmBinary, print: console.error, printErr: console.error });

const identity = [0, 0, 0, 1], step_time = 1e-4, everyone = [0n]; // no body is ignored
/** The value of a result [code, value] or of a bare code. */
function checked(result, what) {
  const [code, value] = Array.isArray(result) ? result : [result];
  if (code !== hk.Result.RESULT_OK) throw new Error(`Havok returns ${code.value} from ${what}`);
  return value;
}
const hits = checked(hk.HP_QueryCollector_Create(1), "HP_QueryCollector_Create");

const shape_of = (scene, body) => scene.shapes[scene.bodies[body].shape];
const place = (b) => [kit.floats(b.pose.translation), kit.floats(kit.unit(b.pose.rotation))];

function hull_of(vertices) {
  const at = hk._malloc(12 * vertices.length);
  try {
    new Float32Array(hk.HEAPU8.buffer, at, 3 * vertices.length).set(vertices.flat());
    return hk.HP_Shape_CreateConvexHull(at, vertices.length);
  } finally {
    hk._free(at);
  }
}
function create(s) {
  const ends = [-1, 1].map((side) => [0, 0, side * s.half_height]);
  switch (s.type) {
    case "sphere": return hk.HP_Shape_CreateSphere([0, 0, 0], s.radius);
    case "box": return hk.HP_Shape_CreateBox([0, 0, 0], identity, s.half_extents.map((x) => 2 * x));
    case "capsule": return hk.HP_Shape_CreateCapsule(...ends, s.radius);
    case "cylinder": return hk.HP_Shape_CreateCylinder(...ends, s.radius);
    case "hull": return hull_of(s.vertices);
    default: throw new kit.Unsupported(`Havok has no ${s.type}`);
  }
}
function core_of(shape) {
  const shown = checked(hk.HP_Shape_CreateDebugDisplayGeometry(shape), "HP_Shape_CreateDebugDisplayGeometry");
  const [at, count] = checked(hk.HP_DebugGeometry_GetInfo(shown), "HP_DebugGeometry_GetInfo");
  const all = Array.from(new Float32Array(hk.HEAPU8.buffer, at, 3 * count));
  hk.HP_DebugGeometry_Release(shown);
  return Array.from({ length: count }, (_, i) => all.slice(3 * i, 3 * i + 3));
}
const most = (points, k) => Math.max(...points.map((p) => p[k]));
const apart = (p, q) => Math.hypot(...p.map((c, k) => c - q[k]));

// The prism with the faces of a rounded one: its core's sides and ends moved outwards by the radius.
function prism(core, radius) {
  const sides = core.length / 2, outer = Math.hypot(core[0][0], core[0][1]), slant = Math.cos(Math.PI / sides);
  const grown = 1 + radius / (slant * outer);
  return core.map(([x, y, z]) => [x * grown, y * grown, z + Math.sign(z) * radius]);
}
// What is held for a shape, for the receipt, and how far it departs from that at its edges and corners, or, if flat, at
// its faces. A box is held as a rounded box; that its corners are missing is claimed all the same.
function held_for(s, shape, k) {
  if (s.type === "sphere" || s.type === "capsule") return { receipt: kit.received_shape(s, k), off: 0 };
  const core = core_of(shape), [, above] = checked(hk.HP_Shape_GetBoundingBox(shape, [[0, 0, 0], identity]), "HP_Shape_GetBoundingBox");
  if (core.length === 0) throw new kit.Unsupported(`Havok makes no core of the ${s.type}`);
  const radius = Math.max(0, above[2] - most(core, 2));
  if (s.type === "box") {
    const half_extents = [0, 1, 2].map((axis) => most(core, axis));
    return { receipt: { shape: k, as: { type: "rounded_box", half_extents, radius } }, off: (Math.sqrt(3) - 1) * radius };
  }
  const vertices = s.type === "cylinder" ? prism(core, radius) : s.vertices.map(kit.floats);
  if (![above, ...core, ...vertices].flat().every(Number.isFinite)) throw new kit.Unsupported(`Havok's ${s.type} is not finite`);
  const off = Math.max(...vertices.map((v) => Math.abs(Math.min(...core.map((c) => apart(v, c))) - radius)));
  return { receipt: s.type === "cylinder" ? { shape: k, as: { type: "hull", vertices } } : { ...kit.received_shape(s, k), vertices }, off };
}

let made = [];
function make(s, k) {
  const [code, shape] = create(s);
  if (code !== hk.Result.RESULT_OK) throw new kit.Unsupported(`Havok refuses the ${s.type}`);
  made.push({ shape });
  Object.assign(made.at(-1), held_for(s, shape, k));
}
const of = (scene, body) => made[scene.bodies[body].shape];
const claim = (scene, a, b) => of(scene, a).off + of(scene, b).off;

// Each question has a world of its own, since a step depends on those before it.
function with_bodies(scene, numbers, motion, use) {
  const world = checked(hk.HP_World_Create(), "HP_World_Create");
  checked(hk.HP_World_SetGravity(world, [0, 0, 0]), "HP_World_SetGravity");
  const bodies = numbers.map((body) => {
    const made_body = checked(hk.HP_Body_Create(), "HP_Body_Create");
    checked(hk.HP_Body_SetShape(made_body, of(scene, body).shape), "HP_Body_SetShape");
    checked(hk.HP_Body_SetMotionType(made_body, motion), "HP_Body_SetMotionType");
    checked(hk.HP_Body_SetMassProperties(made_body, [[0, 0, 0], 1, [1, 1, 1], identity]), "HP_Body_SetMassProperties");
    checked(hk.HP_Body_SetQTransform(made_body, place(scene.bodies[body])), "HP_Body_SetQTransform");
    checked(hk.HP_Body_SetEventMask(made_body, hk.EventType.COLLISION_STARTED.value), "HP_Body_SetEventMask");
    checked(hk.HP_World_AddBody(world, made_body, false), "HP_World_AddBody");
    return made_body;
  });
  try {
    return use(world, bodies);
  } finally {
    for (const body of bodies) {
      hk.HP_World_RemoveBody(world, body);
      hk.HP_Body_Release(body);
    }
    hk.HP_World_Release(world);
  }
}
const first_hit = (get, what) => (checked(hk.HP_QueryCollector_GetNumHits(hits), "HP_QueryCollector_GetNumHits") > 0 ? checked(get(hits, 0), what) : null);

function proximity(scene, a, b, reach) {
  return with_bodies(scene, [a], hk.MotionType.STATIC, (world) => {
    const [at, turn] = place(scene.bodies[b]), asked = [of(scene, b).shape, at, turn, reach, false, everyone];
    checked(hk.HP_World_ShapeProximityWithCollector(world, hits, asked), "HP_World_ShapeProximityWithCollector");
    return first_hit(hk.HP_QueryCollector_GetShapeProximityResult, "HP_QueryCollector_GetShapeProximityResult");
  });
}
// The diagonal of the box around both bodies.
function reach_of(scene, a, b) {
  const boxes = [a, b].map((k) => checked(hk.HP_Shape_GetBoundingBox(of(scene, k).shape, place(scene.bodies[k])), "HP_Shape_GetBoundingBox"));
  return Math.hypot(...[0, 1, 2].map((k) => Math.max(...boxes.map((x) => x[1][k])) - Math.min(...boxes.map((x) => x[0][k]))));
}
// The point on the queried shape is in that shape's space.
function to_world(b, p) {
  const [at, turn] = place(b), columns = kit.columns_of(turn);
  return at.map((c, k) => c + columns[0][k] * p[0] + columns[1][k] * p[1] + columns[2][k] * p[2]);
}

const queries = {
  settings: "shape proximity (of distance 0 for overlaps) and shape casts",
  overlap({ a, b }, scene) {
    return { overlap: proximity(scene, a, b, 0) !== null, claimed_tolerance: claim(scene, a, b) };
  },
  contact({ a, b }, scene) {
    const hit = proximity(scene, a, b, 0), claimed_tolerance = claim(scene, a, b);
    if (!hit || hit[0] > 0) return { overlap: false, claimed_tolerance };
    return { overlap: true, normal: hit[2][4], depth: -hit[0], claimed_tolerance };
  },
  distance({ a, b }, scene) {
    const hit = proximity(scene, a, b, reach_of(scene, a, b));
    if (!hit) return { outcome: "not_converged", detail: "no hit within the bodies' bounds" };
    return { distance: hit[0], point_a: hit[2][3], point_b: to_world(scene.bodies[b], hit[1][3]), claimed_tolerance: claim(scene, a, b) };
  },
  // Casts report no body that overlaps at the start and is left behind; nothing documents what is meant.
  time_of_impact({ a, b }, scene) {
    const moved = kit.relative_translation(scene.bodies[a], scene.bodies[b]), [at, turn] = place(scene.bodies[a]);
    return with_bodies(scene, [b], hk.MotionType.STATIC, (world) => {
      const end = kit.floats(at.map((c, k) => c + moved[k]));
      checked(hk.HP_World_ShapeCastWithCollector(world, hits, [of(scene, a).shape, turn, at, end, false, everyone]), "HP_World_ShapeCastWithCollector");
      const hit = first_hit(hk.HP_QueryCollector_GetShapeCastResult, "HP_QueryCollector_GetShapeCastResult");
      if (!hit && proximity(scene, a, b, 0)) throw new kit.Unsupported("a cast out of an overlap reports no hit");
      return { toi: hit ? hit[0] : null, claimed_tolerance: claim(scene, a, b) };
    });
  },
};

// The points of a and b that touch or overlap, with the normal from a to b: an event has a point on each body.
function events(scene, a, b) {
  return with_bodies(scene, [a, b], hk.MotionType.DYNAMIC, (world, [first]) => {
    checked(hk.HP_World_Step(world, step_time), "HP_World_Step");
    const found = [];
    for (let [, e] = hk.HP_World_GetCollisionEvents(world); e; e = hk.HP_World_GetNextCollisionEvent(world, e)) {
      const [, on_one, on_other] = checked(hk.HP_Event_AsCollision(e), "HP_Event_AsCollision");
      const [p, q] = on_one[0][0] === first[0] ? [on_one, on_other] : [on_other, on_one], normal = p[4];
      found.push({ position: p[3], normal, depth: normal.reduce((sum, n, k) => sum + n * (p[3][k] - q[3][k]), 0) });
    }
    return found.filter((c) => c.depth >= 0);
  });
}
const steps = {
  settings: `collision events of a step of ${step_time} s, bodies at rest; depths are those at points`,
  overlap({ a, b }, scene) {
    return { overlap: events(scene, a, b).length > 0, claimed_tolerance: claim(scene, a, b) };
  },
  contact({ a, b }, scene) {
    const points = events(scene, a, b), claimed_tolerance = claim(scene, a, b);
    if (points.length === 0) return { overlap: false, claimed_tolerance };
    return { overlap: true, ...kit.manifold(points, kit.has_ball(scene, a, b)), claimed_tolerance };
  },
};

const { settings, ...questions } = how === "sim" ? steps : queries;
kit.serve({
  card: {
    batches: how !== "sim", name: how ? `havok-${how}` : "havok", library: "Havok, WASM", version: kit.version(modules, "@babylonjs/havok"), settings,
    source: "no tolerance is documented; how far rounded corners fall short follows from each shape's debug geometry and "
      + "bounding box",
  },
  load(scene) {
    made.forEach(({ shape }) => hk.HP_Shape_Release(shape));
    made = [];
    scene.shapes.forEach(make);
    return { shapes: made.map((m) => m.receipt), bodies: scene.bodies.map((b, k) => kit.received_body(k, b, kit.columns_of(place(b)[1]))) };
  },
  ...questions,
});
