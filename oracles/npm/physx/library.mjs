// PhysX as its adapters share it: the module, shapes and poses in its types, and the tolerances that its sources state.
// Cylinders, cones and ellipsoids are convex cores, which are exact; hulls are cooked, and the vertices of the cooked
// mesh are reported. Axes of shapes are x; arithmetic is in floats.
import { readFileSync } from "node:fs";
import * as kit from "../adapter.mjs";

export const [modules, how] = process.argv.slice(2);
export const px = await loaded("physx-js-webidl");
export const top = px.PxTopLevelFunctions.prototype;
const query = px.PxGeometryQuery.prototype, cores = px.PxConvexCoreGeometryFactory.prototype, arrays = px.NativeArrayHelpers.prototype;

// The module is built for browsers and refuses to load where there is a `process`.
async function loaded(name) {
  const { default: load } = await kit.from(modules, name), node = globalThis.process;
  const wasmBinary = readFileSync(`${modules}/node_modules/${name}/${name}.wasm`);
  globalThis.process = undefined;
  globalThis.WorkerGlobalScope = Object;
  try {
    return await load({ wasmBinary, print: console.error, printErr: console.error });
  } finally {
    globalThis.process = node;
    delete globalThis.WorkerGlobalScope;
  }
}

const version = top.PHYSICS_VERSION;
export const scale = new px.PxTolerancesScale();
const foundation = top.CreateFoundation(version, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
export const physics = top.CreatePhysics(version, foundation, scale);
const cooking = new px.PxCookingParams(scale), heap = new kit.Heap((x) => px.destroy(x));
export const keep = (x) => heap.keep(x), sweep = () => heap.sweep();
export const list = (v) => [v.x, v.y, v.z], vec = (v) => keep(new px.PxVec3(...v));

const on_x = (s) => kit.stands_on_z(s);
export const is_core = (s) => ["cylinder", "cone", "ellipsoid"].includes(s.type);
export const shape_of = (scene, body) => scene.shapes[scene.bodies[body].shape];

function cook(s) {
  const points = keep(new px.Vector_PxVec3(s.vertices.length)), desc = keep(new px.PxConvexMeshDesc());
  s.vertices.forEach((v, i) => ["x", "y", "z"].forEach((c, k) => (points.at(i)[c] = v[k])));
  desc.points.count = s.vertices.length;
  desc.points.stride = 12;
  desc.points.data = points.data();
  desc.flags = keep(new px.PxConvexFlags(px.PxConvexFlagEnum.eCOMPUTE_CONVEX));
  const mesh = top.CreateConvexMesh(cooking, desc);
  if (px.getPointer(mesh) === 0) throw new kit.Unsupported("PhysX's cooking refuses the hull");
  return mesh;
}
const vertices_of = (mesh) => Array.from({ length: mesh.getNbVertices() }, (_, i) => list(arrays.getVec3At(mesh.getVertices(), i)));

function geometry_of(s) {
  switch (s.type) {
    case "sphere": return new px.PxSphereGeometry(s.radius);
    case "box": return new px.PxBoxGeometry(...s.half_extents);
    case "capsule": return new px.PxCapsuleGeometry(s.radius, s.half_height);
    case "cylinder": return cores.createFromCylinder(keep(new px.PxConvexCoreCylinder(2 * s.half_height, s.radius)), 0);
    case "cone": return cores.createFromCone(keep(new px.PxConvexCoreCone(2 * s.half_height, s.radius)), 0);
    case "ellipsoid": return cores.createFromEllipsoid(keep(new px.PxConvexCoreEllipsoid(...s.semi_axes)), 0);
    case "half_space": return new px.PxPlaneGeometry();
    case "hull": return null; // made from its mesh
    default: throw new kit.Unsupported(`the adapter does not support PhysX's ${s.type}`);
  }
}
function support_of(s, { geometry, mesh }) {
  switch (s.type) {
    case "sphere": return new px.SphereSupport(s.radius);
    case "capsule": return new px.CapsuleSupport(s.radius, s.half_height);
    case "box": return new px.BoxSupport(vec(s.half_extents), 0);
    case "hull": return new px.ConvexMeshSupport(mesh);
    case "half_space": return null;
    default: return new px.ConvexGeomSupport(geometry, 0);
  }
}
function make(s) {
  const mesh = s.type === "hull" ? cook(s) : null, geometry = mesh ? new px.PxConvexMeshGeometry(mesh) : geometry_of(s);
  const made = { mesh, geometry };
  if (!mesh && s.type !== "half_space" && !query.isValid(geometry)) throw new kit.Unsupported(`PhysX refuses the ${s.type}`);
  return { ...made, support: how === "gjk" ? support_of(s, made) : null };
}
function release({ mesh, geometry, support }) {
  [support, geometry].forEach((x) => x && px.destroy(x));
  mesh?.release();
}

// PhysX's plane is x = 0, solid below: a half-space is placed by its own frame, in which it is x <= 0.
export function place(scene, body, pose) {
  const s = shape_of(scene, body), q = kit.unit(pose.rotation);
  if (s.type !== "half_space") return { at: kit.floats(pose.translation), turn: on_x(s) ? kit.unit_quaternion_to_x(q) : kit.floats(q) };
  const n = kit.unit(s.normal), d = s.offset / Math.hypot(...s.normal), columns = kit.columns_of(q);
  const world = [0, 1, 2].map((k) => columns[0][k] * n[0] + columns[1][k] * n[1] + columns[2][k] * n[2]);
  const [x, y, z] = world, turn = x >= 0 ? [0, -z, y, 1 + x] : [y, 1 - x, 0, -z];
  return { at: kit.floats(pose.translation.map((c, k) => c + d * world[k])), turn: kit.floats(kit.unit(turn)) };
}
export const transform = ({ at, turn }) => keep(new px.PxTransform(vec(at), keep(new px.PxQuat(...turn))));
export const pose_of = (scene, body) => transform(place(scene, body, scene.bodies[body].pose));

let made = [];
export function load(scene) {
  sweep();
  made.forEach(release);
  made = [];
  scene.shapes.forEach((s) => made.push(make(s)));
  const shapes = scene.shapes.map((s, k) => {
    if (s.type === "half_space") return { shape: k, size: [1, 0, 0, 0] }; // x <= 0, in the frame of place()
    const held = kit.received_shape(s, k);
    return made[k].mesh ? { ...held, vertices: vertices_of(made[k].mesh) } : held;
  });
  const bodies = scene.bodies.map((b, body) => {
    const { at, turn } = place(scene, body, b.pose), s = shape_of(scene, body);
    return { ...kit.received_body_from_x(body, b, kit.columns_of(turn), on_x(s)), translation: at };
  });
  return { shapes, bodies };
}
export const of = (scene, body) => made[scene.bodies[body].shape];
export const pair = (scene, a, b) => [of(scene, a), pose_of(scene, a), of(scene, b), pose_of(scene, b)];

// GuGJK.h, GuEPA.cpp, GuGJKRaycast.h: iterations end at 10 % of the smaller margin of the two shapes, and 1.5 % squared
// of the distance between their cores. GuVecBox.h, GuVecConvexHull.h, GuVecCapsule.h, GuGjkQuery.cpp: the margins.
export const iteration_share = 0.1, core_share = 0.000225, support_margin = 0.001;
const margin_share = 0.05;
const sides_of = (s) => [0, 1, 2].map((k) => Math.max(...s.vertices.map((v) => v[k])) - Math.min(...s.vertices.map((v) => v[k])));
function margin(s) {
  switch (s.type) {
    case "box": return margin_share * Math.min(...s.half_extents);
    case "hull": return (margin_share / 2) * Math.min(...sides_of(s));
    case "sphere": case "capsule": return margin_share * s.radius;
    default: return support_margin;
  }
}
// PxCooking.h: points nearer to a hull than planeTolerance, which grows with the hull's size, are dropped.
export function cooking_claim(scene, a, b) {
  const dropped = (s) => cooking.planeTolerance * Math.max(1, sides_of(s).reduce((x, y) => x + y) / 2);
  return [a, b].map((body) => shape_of(scene, body)).reduce((sum, s) => sum + (s.type === "hull" ? dropped(s) : 0), 0);
}
/** Of an iteration about these bodies; 0 if the pair has a closed form. Convex cores go through PxGjkQuery. */
function iteration_claim(scene, a, b, iterates) {
  const both = [a, b].map((body) => shape_of(scene, body));
  if (both.some((s) => s.type === "half_space")) return 0;
  if (both.some(is_core)) return iteration_share * support_margin;
  return both.some(iterates) ? iteration_share * Math.min(...both.map(margin)) : 0;
}
// GuRefGjkEpa.h, which finds the contacts of convex cores in a step: a support point that is nearer to an earlier one than
// the accuracy of its core, 1 % of the core's greatest extent, is taken for that one.
const core_accuracy = 0.01;
function core_extent(s) {
  if (s.type === "hull") return Math.max(...sides_of(s));
  return 2 * Math.max(...(s.half_extents ?? s.semi_axes ?? [s.half_height ?? 0, is_core(s) ? s.radius : 0]));
}
/** Of the contacts that a step reports. */
export function step_claim(scene, a, b) {
  const both = [a, b].map((body) => shape_of(scene, body));
  if (!both.some(is_core) || both.some((s) => s.type === "half_space")) return claim(scene, a, b);
  return core_accuracy * (core_extent(both[0]) + core_extent(both[1])) + cooking_claim(scene, a, b);
}
export const claim = (scene, a, b, iterates = (s) => s.type === "hull" || s.type === "box") =>
  iteration_claim(scene, a, b, iterates) + cooking_claim(scene, a, b);
