// cannon-es (npm cannon-es) behind a pipe:  node cannon.mjs FOLDER [sap]
// Contacts by Narrowphase.getContacts of two bodies; broad phases NaiveBroadphase, as a World has it, and SAPBroadphase.
// It has neither distances nor sweeps. Its cylinder is a prism and its capsule several shapes: both are unsupported.
import * as kit from "../adapter.mjs";

const [modules, how] = process.argv.slice(2);
console.log = console.error; // ConvexPolyhedron logs clamped depths, on the stream of the answers
const module = await kit.from(modules, "cannon-es"), cannon = module.World ? module : module.default;

const vec = (v) => new cannon.Vec3(...v);
const list = ({ x, y, z }) => [x, y, z];
const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], up = [0, 0, 1];
const dot = (p, q) => p.reduce((sum, x, k) => sum + x * q[k], 0);

const turned = (q, v) => list(q.vmult(vec(v)));
const quaternion_of = (pose) => new cannon.Quaternion(...kit.unit(pose.rotation));

/** A plane is solid below z = 0 of its own frame: offset and orientation put it into that of the body. */
function made_plane({ normal, offset }) {
  const length = Math.hypot(...normal), n = normal.map((x) => x / length);
  const orientation = new cannon.Quaternion(), at = n.map((x) => (x * offset) / length);
  orientation.setFromVectors(vec(up), vec(n));
  const held = turned(orientation, up);
  return { shape: new cannon.Plane(), offset: vec(at), orientation, size: [...held, dot(held, at)] };
}
function made_shape(s) {
  switch (s.type) {
    case "sphere": return { shape: new cannon.Sphere(s.radius) };
    case "box": return { shape: new cannon.Box(vec(s.half_extents)) };
    case "hull": return { shape: new cannon.ConvexPolyhedron({ vertices: s.vertices.map(vec), faces: s.triangles }) };
    case "half_space": return made_plane(s);
    default: throw new kit.Unsupported(`the adapter does not support cannon-es's ${s.type}`);
  }
}

let shapes = [];
function body_at(scene, number, pose, mass) {
  const { shape, offset, orientation } = shapes[scene.bodies[number].shape];
  const body = new cannon.Body({ mass, position: vec(pose.translation), quaternion: quaternion_of(pose) });
  body.addShape(shape, offset, orientation);
  return body;
}

// Faces are clipped as polygons, which a hull's triangles are not: only against balls and planes does that not matter.
const is_clipped = (s) => s.type === "box" || s.type === "hull";
function require_unclipped(p, q) {
  if ((p.type === "hull" && is_clipped(q)) || (q.type === "hull" && is_clipped(p)))
    throw new kit.Unsupported("cannon-es clips the faces of hulls, and the scene states triangles");
}

const world = new cannon.World();
// clipFaceAgainstHull keeps points up to 1e-6 outside a face, of bodies that touch; contact() leaves these points out.
// Points on both bodies and a normal from bi to bj; the depth is that which ContactEquation.computeB opposes.
function contact_points(scene, a, b) {
  require_unclipped(scene.shapes[scene.bodies[a].shape], scene.shapes[scene.bodies[b].shape]);
  const [p, q] = [a, b].map((body) => body_at(scene, body, scene.bodies[body].pose, 1)), found = [];
  world.narrowphase.getContacts([p], [q], world, found, [], [], []);
  return found.map(({ bi, bj, ni, ri, rj }) => {
    const on_i = list(bi.position.vadd(ri)), on_j = list(bj.position.vadd(rj)), n = list(ni);
    return {
      position: on_i.map((x, k) => (x + on_j[k]) / 2), normal: bi === p ? n : n.map((x) => -x),
      depth: dot(n, on_i) - dot(n, on_j),
    };
  });
}
// All vertices behind a plane are reported, and a ball touches at one point.
const is_whole = (scene, a, b) => kit.has_ball(scene, a, b) ||
  [a, b].some((body) => scene.shapes[scene.bodies[body].shape].type === "half_space");

class Stage {
  constructor(scene) {
    this.scene = scene;
    this.world = new cannon.World();
    if (how === "sap") this.world.broadphase = new cannon.SAPBroadphase(this.world);
    this.bodies = new Map();
  }
  insert(number, pose) {
    const body = body_at(this.scene, number, pose, this.scene.bodies[number].static ? 0 : 1);
    this.bodies.set(number, body);
    this.world.addBody(body);
  }
  move(number, pose) {
    const body = this.bodies.get(number);
    body.position.copy(vec(pose.translation));
    body.quaternion.copy(quaternion_of(pose));
    body.aabbNeedsUpdate = true;
  }
  remove(number) {
    this.world.removeBody(this.bodies.get(number));
    this.bodies.delete(number);
  }
  pairs(report) {
    const first = [], second = [], numbers = new Map([...this.bodies].map(([number, body]) => [body, number]));
    this.world.broadphase.dirty = true; // as World.internalStep leaves it
    this.world.broadphase.collisionPairs(this.world, first, second);
    first.forEach((body, k) => report(numbers.get(body), numbers.get(second[k])));
  }
}

const broad = {
  candidates: (_, scene) => kit.candidates(scene, new Stage(scene)),
};
const narrow = {
  overlap: ({ a, b }, scene) => ({ overlap: contact_points(scene, a, b).length > 0 }),
  contact({ a, b }, scene) {
    const points = contact_points(scene, a, b);
    if (points.length === 0) return { overlap: false };
    const found = kit.manifold(points, is_whole(scene, a, b));
    return { overlap: true, ...found, points: found.points.filter((p) => p.depth >= 0) };
  },
};
kit.serve({
  card: {
    batches: !how, name: how ? `cannon-${how}` : "cannon", library: "cannon-es", version: kit.version(modules, "cannon-es"),
    unit_roundoff: 2 ** -53, shapes: ["sphere", "box", "hull", "half_space"],
    settings: how === "sap" ? "SAPBroadphase of bounding spheres" : "Narrowphase.getContacts; NaiveBroadphase of bounding spheres",
    source: "no tolerance is documented for contacts",
  },
  load(scene) {
    shapes = scene.shapes.map(made_shape);
    const held = scene.bodies.map(({ pose }, body) => {
      const columns = axes.map((axis) => turned(quaternion_of(pose), axis));
      return { body, matrix: [0, 1, 2].flatMap((k) => columns.map((c) => c[k])), translation: pose.translation };
    });
    return { shapes: shapes.flatMap(({ size }, shape) => (size ? [{ shape, size }] : [])), bodies: held };
  },
  ...(how ? broad : { ...broad, ...narrow }),
});
