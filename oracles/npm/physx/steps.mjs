// What PhysX reports of a scene's step. The pairs of the broad phase reach the filter shader, which suppresses them:
// a suppressed pair is filtered again when filter data change, so after each query's step every pair that is still
// there is shown again. Contacts of pairs are reported, not solved, so that nothing moves.
import * as kit from "../adapter.mjs";
import { keep, list, of, physics, place, px, scale, shape_of, step_claim, top, transform, vec } from "./library.mjs";

const step_time = 0.01;
const region_slack = 1.1, least_region = 1; // MBP sees bodies within its regions only
const material = physics.createMaterial(0, 0, 0), dispatcher = top.DefaultCpuDispatcherCreate(0);
const flag = px.PxPairFlagEnum;
const reported = flag.eDETECT_DISCRETE_CONTACT | flag.eNOTIFY_TOUCH_FOUND | flag.eNOTIFY_CONTACT_POINTS;
const is_fixed = (s) => s.type === "half_space";

/** A scene with the bodies that are inserted; `filter(i, j)` sees pairs of bodies, by number, and returns filter flags. */
class Stage {
  constructor(scene, type, filter, on_contact) {
    this.scene = scene;
    this.bodies = new Map();
    this.count = 0;
    this.shader = new px.PassThroughFilterShaderImpl();
    this.shader.filterShader = (_, i, _1, _2, _3, _4, j) => filter(i, j, this.shader);
    this.events = new px.PxSimulationEventCallbackImpl();
    for (const name of ["onConstraintBreak", "onWake", "onSleep", "onTrigger"]) this.events[name] = () => {};
    this.events.onContact = on_contact;
    const desc = keep(new px.PxSceneDesc(scale));
    desc.gravity = vec([0, 0, 0]);
    desc.cpuDispatcher = dispatcher;
    desc.broadPhaseType = px.PxBroadPhaseTypeEnum[type];
    desc.kineKineFilteringMode = desc.staticKineFilteringMode = px.PxPairFilteringModeEnum.eKEEP;
    desc.simulationEventCallback = this.events;
    top.setupPassThroughFilterShader(desc, this.shader);
    this.world = physics.createScene(desc);
  }
  add_region(half) {
    const region = keep(new px.PxBroadPhaseRegion());
    region.mBounds = keep(new px.PxBounds3(vec([-half, -half, -half]), vec([half, half, half])));
    this.world.addBroadPhaseRegion(region, true);
  }
  filter_data(body) {
    return keep(new px.PxFilterData(body, this.count, 0, 0));
  }
  insert(body, pose) {
    const s = shape_of(this.scene, body), flags = keep(new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE));
    const shape = physics.createShape(of(this.scene, body).geometry, material, true, flags);
    shape.setSimulationFilterData(this.filter_data(body));
    const at = transform(place(this.scene, body, pose));
    const is_static = is_fixed(s) && !this.kinematic; // PhysX pairs no static actors
    const actor = is_static ? physics.createRigidStatic(at) : physics.createRigidDynamic(at);
    if (this.contact_offset) shape.setContactOffset(this.contact_offset);
    actor.attachShape(shape);
    shape.release(); // the actor holds it
    if (this.kinematic) actor.setRigidBodyFlag(px.PxRigidBodyFlagEnum.eKINEMATIC, true);
    this.world.addActor(actor);
    this.bodies.set(body, { actor, shape });
  }
  move(body, pose) {
    this.bodies.get(body).actor.setGlobalPose(transform(place(this.scene, body, pose)));
  }
  remove(body) {
    this.bodies.get(body).actor.release();
    this.bodies.delete(body);
  }
  step() {
    this.world.simulate(step_time);
    this.world.fetchResults(true);
  }
  filter_again() {
    ++this.count;
    for (const [body, { shape }] of this.bodies) shape.setSimulationFilterData(this.filter_data(body));
  }
  release() {
    for (const body of [...this.bodies.keys()]) this.remove(body);
    this.world.release();
    [this.shader, this.events].forEach((x) => px.destroy(x));
  }
}

const broad_names = { sap: "eSAP", mbp: "eMBP", abp: "eABP" };
export function broad_phase(how) {
  const farthest = (scene) => Math.max(least_region, ...[...scene.bodies, ...scene.steps].flatMap((x) => x.pose?.translation ?? []).map(Math.abs))
    + Math.max(...scene.shapes.map((s) => Math.hypot(...[s.vertices ?? [], s.half_extents ?? s.semi_axes ?? [], s.radius ?? 0, s.half_height ?? 0].flat(2))));
  return {
    settings: `pairs of ${broad_names[how]} as the filter shader sees them, contact offset 0.02; kinematic actors`
      + (how === "mbp" ? "; one region around the scene" : ""),
    candidates(_, scene) {
      let seen = [];
      const stage = new Stage(scene, broad_names[how], (i, j) => {
        seen.push([i, j]);
        return px.PxFilterFlagEnum.eSUPPRESS;
      }, () => {});
      stage.kinematic = true;
      if (how === "mbp") stage.add_region(region_slack * farthest(scene));
      stage.pairs = (report) => {
        stage.step();
        stage.filter_again();
        seen = [];
        stage.step();
        seen.forEach(([i, j]) => report(i, j));
      };
      try {
        return kit.candidates(scene, stage);
      } finally {
        stage.release();
      }
    },
  };
}

// The points of a contact between a and b, with normals from a to b. The shapes' contact offsets are PhysX's own, or one
// of half the margin each.
function contact_points(scene, a, b, margin) {
  const found = [], room = keep(new px.PxArray_PxContactPairPoint(64));
  const stage = new Stage(scene, "eABP", (i, j, shader) => {
    shader.outputPairFlags = reported;
    return px.PxFilterFlagEnum.eDEFAULT;
  }, (_, pairs, count) => {
    for (let k = 0; k < count; ++k) {
      const c = px.NativeArrayHelpers.prototype.getContactPairAt(px.wrapPointer(pairs, px.PxContactPair), k);
      const side = c.get_shapes(0).getSimulationFilterData().word0 === a ? -1 : 1; // it points from shape 1 to shape 0
      for (let i = 0, n = c.extractContacts(room.begin(), room.size()); i < n; ++i) {
        const p = room.get(i);
        found.push({ position: list(p.position), normal: list(p.normal).map((x) => side * x), depth: -p.separation });
      }
    }
  });
  stage.contact_offset = margin / 2;
  try {
    [a, b].forEach((body) => stage.insert(body, scene.bodies[body].pose));
    stage.step();
    return found;
  } finally {
    stage.release();
  }
}
function touching(scene, a, b, margin = 0) {
  if ([a, b].every((body) => is_fixed(shape_of(scene, body)))) throw new kit.Unsupported("PhysX reports no contacts of two planes");
  return contact_points(scene, a, b, margin).filter((p) => p.depth >= -margin);
}
function near_points(scene, a, b) {
  if (!(scene.margin > 0)) throw new kit.Unsupported("contact offsets are positive");
  return touching(scene, a, b, scene.margin);
}
function contact_of(scene, a, b, points) {
  const claimed_tolerance = step_claim(scene, a, b);
  if (points.length === 0) return { overlap: false, claimed_tolerance };
  return { overlap: true, ...kit.manifold(points, kit.has_ball(scene, a, b)), claimed_tolerance };
}
// PxContactPairPoint: the separation is that of the shapes at the point.
export const simulation = {
  settings: "contact reports of a step, PCM, contact offset 0.02, rest offset 0; bodies without a response",
  overlap({ a, b }, scene) {
    return { overlap: touching(scene, a, b).length > 0, claimed_tolerance: step_claim(scene, a, b) };
  },
  // PxShape.h, setContactOffset: shapes nearer than the sum of their offsets, which are positive, generate contacts.
  within({ a, b }, scene) {
    return { overlap: near_points(scene, a, b).length > 0, claimed_tolerance: step_claim(scene, a, b) };
  },
  contact: ({ a, b }, scene) => contact_of(scene, a, b, touching(scene, a, b)),
  contact_within: ({ a, b }, scene) => contact_of(scene, a, b, near_points(scene, a, b)),
};
