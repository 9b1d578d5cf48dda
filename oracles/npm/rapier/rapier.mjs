// Rapier (npm @dimforge/rapier3d-compat) behind a pipe:  node rapier.mjs FOLDER
// Narrow phase through Shape (contactShape, intersectsShape, castShape), broad phase as run by World::step:
// contactPairsWith lists the pairs whose AABBs it found to overlap.
import * as kit from "../adapter.mjs";

const [modules] = process.argv.slice(2);
const rapier = (await kit.from(modules, "@dimforge/rapier3d-compat")).default;
await rapier.init();

const xyz = ([x, y, z]) => ({ x, y, z });
const list = ({ x, y, z }) => [x, y, z];

function make_shape(s) {
  switch (s.type) {
    case "sphere": return new rapier.Ball(s.radius);
    case "box": return new rapier.Cuboid(...s.half_extents);
    case "capsule": return new rapier.Capsule(s.half_height, s.radius);
    case "cylinder": return new rapier.Cylinder(s.half_height, s.radius);
    case "cone": return new rapier.Cone(s.half_height, s.radius);
    case "half_space": return new rapier.HalfSpace(xyz(unit(s.normal)));
    case "hull": return make_hull(s);
    case "mesh": return make_field(s) ?? new rapier.TriMesh(new Float32Array(s.vertices.flat()), new Uint32Array(s.triangles.flat()));
    default: throw new kit.Unsupported(`the adapter does not support Rapier's ${s.type}`);
  }
}
// Of some points Rapier computes no hull: of points in a plane, for instance. Its convexHull is documented to return
// null then; a ConvexPolyhedron made of them fails at its first use.
function make_hull(s) {
  const hull = new rapier.ConvexPolyhedron(new Float32Array(s.vertices.flat())), made = hull.intoRaw();
  if (!made) throw new kit.Unsupported("Rapier computes no hull of these points");
  made.free();
  return hull;
}
// Rows of the matrix are along Rapier's z, our -y. It is passed column by column, and its size in cells.
function make_field(s) {
  const field = kit.height_field_of(s);
  if (!field) return null;
  const { rows, columns, cell } = field, heights = new Float32Array(rows * columns);
  s.vertices.forEach((v, k) => {
    heights[(k % columns) * rows + rows - 1 - Math.floor(k / columns)] = v[2];
  });
  return new rapier.Heightfield(rows - 1, columns - 1, heights, { x: cell[0] * (columns - 1), y: 1, z: cell[1] * (rows - 1) });
}
// As heightfield3.rs computes its points.
function held_vertices(s) {
  const { rows, columns, cell } = kit.height_field_of(s);
  const along = (k, n, length) => kit.f(kit.f(kit.f(kit.f(1 / (n - 1)) * k) - 0.5) * kit.f(length));
  return s.vertices.map((v, k) => [along(k % columns, columns, cell[0] * (columns - 1)),
    -along(rows - 1 - Math.floor(k / columns), rows, cell[1] * (rows - 1)), kit.f(v[2])]);
}
const stands_on_z = (s) => kit.stands_on_z(s) || kit.height_field_of(s) !== null;
const unit = (n) => n.map((x) => x / Math.hypot(...n));
const unlimited_reach = 1e15; // search distance for closest points

let shapes = [];
const shape_of = (scene, body) => scene.shapes[scene.bodies[body].shape];
function place(scene, body, pose) {
  const s = shape_of(scene, body), q = kit.unit_quaternion(pose.rotation, stands_on_z(s));
  if (s.type === "half_space" && s.offset !== 0)
    throw new kit.Unsupported("Rapier's half-space passes through its origin");
  return { t: xyz(pose.translation), q: { x: q[0], y: q[1], z: q[2], w: q[3] } };
}
function pair(scene, a, b) {
  return [a, b].map((body) => ({ shape: shapes[scene.bodies[body].shape], ...place(scene, body, scene.bodies[body].pose) }));
}

// contactShape finds nothing farther away than `reach`.
function contact_of(scene, a, b, reach) {
  const [p, q] = pair(scene, a, b);
  return p.shape.contactShape(p.t, p.q, q.shape, q.t, q.q, reach);
}

function closest(scene, a, b, reach) {
  const c = contact_of(scene, a, b, reach);
  return c ? { distance: c.distance, point_a: list(c.point1), point_b: list(c.point2), normal: list(c.normal1) } : {};
}

// What castShape takes after the two shapes, by the number of its arguments, which differs between releases: the
// latest time; whether a shape that starts in contact is reported, as it is without this argument; before both, the
// distance to stop at; after them, an object to write to, which may be left out.
const last_arguments = { 8: [1], 9: [1, true], 10: [0, 1, true], 11: [0, 1, true] };
function cast(p, velocity, q) {
  const last = last_arguments[p.shape.castShape.length];
  if (!last) throw new kit.Unsupported(`Rapier's castShape takes ${p.shape.castShape.length} arguments`);
  const hit = p.shape.castShape(p.t, p.q, xyz(velocity), q.shape, q.t, q.q, xyz([0, 0, 0]), ...last);
  return hit ? { toi: hit.time_of_impact ?? hit.toi } : { toi: null };
}

// Bodies are kinematic, because Rapier reports no pairs of fixed colliders or colliders without a body.
class World {
  constructor(scene) {
    this.scene = scene;
    this.world = new rapier.World({ x: 0, y: 0, z: 0 });
    this.world.timestep = 0;
    this.bodies = new Map();
    this.colliders = new Map();
  }
  insert(body, pose) {
    const { t, q } = place(this.scene, body, pose), wanted = rapier.RigidBodyDesc.kinematicPositionBased();
    const made = this.world.createRigidBody(wanted.setTranslation(t.x, t.y, t.z).setRotation(q));
    const shape = new rapier.ColliderDesc(shapes[this.scene.bodies[body].shape]);
    shape.setActiveCollisionTypes(rapier.ActiveCollisionTypes.ALL);
    this.bodies.set(body, made);
    this.colliders.set(body, this.world.createCollider(shape, made));
  }
  move(body, pose) {
    const { t, q } = place(this.scene, body, pose), moved = this.bodies.get(body);
    moved.setTranslation(t, true);
    moved.setRotation(q, true);
  }
  remove(body) {
    this.world.removeRigidBody(this.bodies.get(body));
    this.bodies.delete(body);
    this.colliders.delete(body);
  }
  pairs(report) {
    this.world.step();
    const numbers = new Map([...this.colliders].map(([body, c]) => [c.handle, body]));
    const visit = this.world.contactPairsWith ? "contactPairsWith" : "contactsWith"; // its earlier name
    for (const [body, c] of this.colliders) this.world[visit](c, (d) => report(body, numbers.get(d.handle)));
  }
}

const engine = {
  card: {
    batches: true, name: "rapier", library: "Rapier, WASM", version: kit.version(modules, "@dimforge/rapier3d-compat"),
    settings: "contactShape, intersectsShape and castShape; World.step and contactPairsWith",
    source: "no tolerance is documented for queries; shape.d.ts: TriMeshFlags and HeightFieldFlags, FIX_INTERNAL_EDGES, "
      + "which is not set: without it, contact normals at inner edges cause bumps",
    separate_triangles: true,
  },
  load(scene) {
    shapes = scene.shapes.map(make_shape);
    const held = scene.bodies.map((b, body) => {
      const s = shape_of(scene, body), on_z = stands_on_z(s);
      return kit.received_body(body, b, kit.columns_of(kit.unit_quaternion(b.pose.rotation, on_z)), on_z);
    });
    const sized = (s, k) => {
      if (s.type === "half_space") return { shape: k, size: [...kit.floats(unit(s.normal)), s.offset] };
      return kit.height_field_of(s) ? { shape: k, size: [], vertices: held_vertices(s) } : kit.received_shape(s, k);
    };
    return { shapes: scene.shapes.map(sized), bodies: held };
  },
  overlap({ a, b }, scene) {
    const [p, q] = pair(scene, a, b);
    return { overlap: p.shape.intersectsShape(p.t, p.q, q.shape, q.t, q.q) };
  },
  contact({ a, b }, scene) {
    const c = contact_of(scene, a, b, 0);
    if (!c || c.distance > 0) return { overlap: false };
    return { overlap: true, normal: list(c.normal1), depth: -c.distance };
  },
  distance({ a, b }, scene) {
    const { normal, ...answer } = closest(scene, a, b, unlimited_reach);
    if (answer.distance === undefined) throw new kit.Unsupported("Rapier found no closest points");
    return answer;
  },
  ...kit.margin_questions(closest), // Shape.contactShape, prediction
  time_of_impact({ a, b }, scene) {
    const translation = kit.relative_translation(scene.bodies[a], scene.bodies[b]), [p, q] = pair(scene, a, b);
    return cast(p, translation, q);
  },
  candidates(_, scene) {
    const world = new World(scene);
    try {
      return kit.candidates(scene, world);
    } finally {
      world.world.free();
    }
  },
};
kit.serve(engine);
