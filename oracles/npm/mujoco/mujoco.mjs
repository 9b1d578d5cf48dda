// MuJoCo (npm @mujoco/mujoco) behind a pipe:  node mujoco.mjs FOLDER [single | libccd]
// Contacts through mj_collision, distances through mj_geomDistance, with margin 0. A scene is compiled to a model in
// which each body is free, except those of half-spaces, since MuJoCo attaches planes to fixed bodies only. Shapes and
// poses are doubles; vertices of a mesh are floats in the frame of its inertia. single: at most one contact for a pair
// without an analytic collider (mjDSBL_MULTICCD); libccd: the legacy convex pipeline (mjDSBL_NATIVECCD).
import * as kit from "../adapter.mjs";

const [modules, how = ""] = process.argv.slice(2);
const mj = await (await kit.from(modules, "@mujoco/mujoco")).default({ print: console.error, printErr: console.error });

// Documentation, XMLreference, option/ccd_tolerance: "in units of distance" (Computation, Convex collisions).
const ccd_tolerance = 1e-6;
const box_preference = 0.05, box_slack = 1e-13; // share of the depth; of the sum of half extents
const farthest = 1e10; // distmax of mj_geomDistance: mjMAXVAL
const flags = { "": "", single: '<flag multiccd="disable"/>', libccd: '<flag nativeccd="disable"/>' }[how];

// mjCOLLISIONFUNC: these pairs have their own colliders, all others go to the convex pipeline.
const analytic = new Set(["sphere sphere", "capsule sphere", "cylinder sphere", "box sphere", "capsule capsule",
  "box capsule", "box box"]);
const shape_of = (scene, body) => scene.shapes[scene.bodies[body].shape];
const kinds = (scene, a, b) => [a, b].map((body) => shape_of(scene, body).type).sort();
function require_collider(scene, a, b) {
  if (kinds(scene, a, b).every((k) => k === "half_space")) throw new kit.Unsupported("MuJoCo collides no two planes");
}
const is_box_pair = (scene, a, b) => kinds(scene, a, b).every((k) => k === "box");
const is_convex_pair = (scene, a, b) => {
  const both = kinds(scene, a, b);
  return !both.includes("half_space") && !analytic.has(both.join(" "));
};
// Further contacts of these pairs are found after rotating both geoms by 1e-3 rad (Computation, Multiple contacts), so
// they are not points of the bodies as placed.
const has_rotated_points = (scene, a, b) =>
  is_convex_pair(scene, a, b) && (how === "libccd" || kinds(scene, a, b).some((k) => k !== "box" && k !== "hull"));

function geom_of(s, number) {
  switch (s.type) {
    case "sphere": return `type="sphere" size="${s.radius}"`;
    case "box": return `type="box" size="${s.half_extents.join(" ")}"`;
    case "capsule": return `type="capsule" size="${s.radius} ${s.half_height}"`;
    case "cylinder": return `type="cylinder" size="${s.radius} ${s.half_height}"`;
    case "ellipsoid": return `type="ellipsoid" size="${s.semi_axes.join(" ")}"`;
    case "half_space": return `type="plane" size="0 0 1" ${plane_frame(s)}`; // solid below, infinite
    case "hull": return `type="mesh" mesh="m${number}"`;
    default: throw new kit.Unsupported(`MuJoCo has no ${s.type}`);
  }
}

// The frame whose z axis is the normal: the shortest turn from z; beyond a right angle, that from -z after a half turn.
function plane_frame({ normal, offset }) {
  const n = Math.hypot(...normal), [x, y, z] = normal.map((c) => c / n);
  const turn = z >= 0 ? [-y, x, 0, 1 + z] : [1 - z, 0, x, -y];
  return `pos="${[x, y, z].map((c) => (c * offset) / n).join(" ")}" quat="${wxyz(kit.unit(turn))}"`;
}
const wxyz = ([x, y, z, w]) => `${w} ${x} ${y} ${z}`;

// The scene's bodies by the bodies of the model that have them as geoms: each alone, or, `linked`, those of one group
// together.
function links_of(scene, linked) {
  const links = new Map();
  scene.bodies.forEach((b, k) => {
    const key = linked && b.group >= 0 && shape_of(scene, k).type !== "half_space" ? `group ${b.group}` : k;
    links.set(key, [...(links.get(key) ?? []), k]);
  });
  return [...links.values()];
}
const placed = (at, rotation) => `pos="${at.join(" ")}" quat="${wxyz(rotation)}"`;
// Of a body, as seen from another one.
function relative(pose, from) {
  const [x, y, z, w] = kit.unit(pose.rotation), [i, j, k, l] = kit.unit(from.rotation);
  const turn = [l * x - i * w - j * z + k * y, l * y + i * z - j * w - k * x, l * z - i * y + j * x - k * w, l * w + i * x + j * y + k * z];
  const apart = pose.translation.map((c, n) => c - from.translation[n]);
  return placed(kit.columns_of([i, j, k, l]).map((c) => c[0] * apart[0] + c[1] * apart[1] + c[2] * apart[2]), kit.unit(turn));
}

function xml_of(scene, links) {
  const meshes = scene.shapes.map((s, k) => s.type === "hull"
    ? `<mesh name="m${k}" inertia="shell" vertex="${s.vertices.flat().join(" ")}"/>` : "");
  const bodies = links.map(([first, ...others]) => {
    const b = scene.bodies[first], s = scene.shapes[b.shape], at = placed(b.pose.translation, kit.unit(b.pose.rotation));
    const free = s.type === "half_space" ? "" : '<freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>';
    const geoms = others.map((k) => `<geom ${geom_of(shape_of(scene, k), scene.bodies[k].shape)} ${relative(scene.bodies[k].pose, b.pose)}/>`);
    return `<body ${at}>${free}<geom ${geom_of(s, b.shape)}/>${geoms.join("")}</body>`;
  });
  return `<mujoco><option>${flags}</option><asset>${meshes.join("")}</asset>`
    + `<worldbody>${bodies.join("")}</worldbody></mujoco>`;
}

// Of the scene with each body alone; `linked`, {model, data, order}, of that with a group's bodies together, if they
// differ: its k-th geom is that of the scene's body order[k].
let model = null, data = null, linked = null;
function compiled(scene, links) {
  let made = null;
  try {
    made = mj.MjModel.from_xml_string(xml_of(scene, links));
  } catch (why) {
    throw new kit.Unsupported(`MuJoCo's compiler refuses the scene: ${String(why.message || why).split("\n").join(" ")}`);
  }
  const state = new mj.MjData(made);
  mj.mj_kinematics(made, state);
  return { model: made, data: state, order: links.flat() };
}
function compile(scene) {
  for (const made of [data, model, linked?.data, linked?.model]) made?.delete();
  model = data = linked = null;
  ({ model, data } = compiled(scene, links_of(scene, false)));
  const links = links_of(scene, true);
  if (links.length < scene.bodies.length) linked = compiled(scene, links);
}

// A mesh as placed in the frame of its shape: mesh_vert, rotated by mesh_quat, at mesh_pos.
function held_vertices(geom) {
  const k = model.geom_dataid[geom], first = model.mesh_vertadr[k], [w, x, y, z] = model.mesh_quat.slice(4 * k, 4 * k + 4);
  const columns = kit.columns_of([x, y, z, w]), at = model.mesh_pos.slice(3 * k, 3 * k + 3);
  return Array.from({ length: model.mesh_vertnum[k] }, (_, i) => {
    const v = model.mesh_vert.slice(3 * (first + i), 3 * (first + i) + 3);
    return [0, 1, 2].map((r) => columns[0][r] * v[0] + columns[1][r] * v[1] + columns[2][r] * v[2] + at[r]);
  });
}

// All contacts, or those of two bodies, as {geom, distance, normal, position}; a geom has the number of its body.
function contacts(a, b) {
  mj.mj_collision(model, data);
  if (data.warning.get(mj.mjtWarning.mjWARN_CONTACTFULL.value).number > 0) throw new Error("MuJoCo's buffer of contacts is full");
  const all = data.contact, out = [];
  for (let i = 0; i < data.ncon; ++i) {
    const c = all.get(i), geom = [c.geom1, c.geom2];
    if (a === undefined || (geom.includes(a) && geom.includes(b)))
      out.push({ geom, distance: c.dist, normal: Array.from(c.frame.slice(0, 3)), position: Array.from(c.pos) });
    c.delete();
  }
  all.delete();
  return out;
}
// All contacts of the scene with its groups as bodies of several geoms, by the numbers of the scene's bodies.
function linked_contacts() {
  if (!linked) return contacts();
  const own = { model, data }, { order } = linked;
  ({ model, data } = linked);
  try {
    return contacts().map((c) => ({ ...c, geom: c.geom.map((k) => order[k]) }));
  } finally {
    ({ model, data } = own);
  }
}
// mjmodel.h: vertices of a mesh are floats; they are also turned into the frame of its inertia and back.
const vertex_roundings = 4;
const rounding_of = (s) => (s.type === "hull"
  ? vertex_roundings * kit.float_roundoff * Math.max(...s.vertices.map((v) => Math.hypot(...v))) : 0);
const roundings = (scene, a, b) => rounding_of(shape_of(scene, a)) + rounding_of(shape_of(scene, b));
// Box-box distances go through the convex pipeline too.
const distance_claim = (scene, a, b) => roundings(scene, a, b) +
  (is_convex_pair(scene, a, b) || is_box_pair(scene, a, b) ? ccd_tolerance : 0);
// The depth may fall short of the least one by the tolerance, and the width along the normal exceed it by as much.
// engine_collision_box.c: a face is preferred to an edge pair of up to 5 % less depth, and separation has some slack.
function contact_claim(scene, a, b, depth = 0) {
  if (is_box_pair(scene, a, b)) return box_preference * depth + box_slack *
    [a, b].flatMap((body) => shape_of(scene, body).half_extents).reduce((x, y) => x + y);
  return roundings(scene, a, b) + (is_convex_pair(scene, a, b) ? 2 * ccd_tolerance : 0);
}
const deepest_of = (all) => all.reduce((x, y) => (y.distance < x.distance ? y : x));

// The contact of a pair, with normal from a to b. Of contacts found after rotating geoms only the first is of the bodies
// as placed, and all have its depth. Manifolds of the convex pipeline are clipped, and state depths at points, except
// for balls and ellipsoids, which it does not clip.
function answer_of(scene, found, a, b) {
  const rotated = has_rotated_points(scene, a, b) && found.every((c) => c.distance === found[0].distance);
  const all = (rotated ? found.slice(0, 1) : found).map((c) => ({ position: c.position, depth: -c.distance,
    normal: c.geom[0] === a ? c.normal : c.normal.map((x) => -x) }));
  const smooth = kinds(scene, a, b).some((k) => k === "sphere" || k === "ellipsoid");
  const is_whole = !is_convex_pair(scene, a, b) || how !== "" || smooth || found.length > 1 && rotated;
  const claimed_tolerance = contact_claim(scene, a, b, Math.max(0, -deepest_of(found).distance));
  return { overlap: true, ...kit.manifold(all, is_whole), claimed_tolerance };
}
const contact_of = (scene, found, a, b) =>
  found.length > 0 ? answer_of(scene, found, a, b) : { overlap: false, claimed_tolerance: contact_claim(scene, a, b) };
const from_to = new mj.DoubleBuffer(6);

function closest(scene, a, b, reach) {
  if (how === "libccd" && (is_convex_pair(scene, a, b) || is_box_pair(scene, a, b)))
    throw new kit.Unsupported("MuJoCo's documentation disclaims distances of its libccd pipeline");
  const distance = mj.mj_geomDistance(model, data, a, b, reach, from_to), points = Array.from(from_to.GetView());
  const claimed_tolerance = distance_claim(scene, a, b);
  if (distance >= reach) return { claimed_tolerance };
  if (points.every((x) => x === 0)) return { distance, claimed_tolerance }; // it has written none
  return { distance, point_a: points.slice(0, 3), point_b: points.slice(3), claimed_tolerance };
}

// XMLreference, body/geom/margin: contacts are detected below this distance. Of two geoms' margins one is 0, so that it
// does not matter how MuJoCo combines them.
function near_contacts(scene, a, b) {
  require_collider(scene, a, b);
  if ((scene.margin ?? 0) < 0) throw new kit.Unsupported("a margin is not for depths");
  const margins = model.geom_margin;
  margins[a] = scene.margin ?? 0;
  try {
    return contacts(a, b);
  } finally {
    margins[a] = 0;
  }
}

const engine = {
  card: {
    name: how ? `mujoco-${how}` : "mujoco", library: "MuJoCo, WASM", version: kit.version(modules, "@mujoco/mujoco"),
    settings: { "": "as shipped: native convex collisions, several contacts", single: "multiccd disabled",
      libccd: "nativeccd disabled: libccd's MPR" }[how] + "; mj_collision, mj_geomDistance; margin 0",
    unit_roundoff: 2 ** -53, unit_roundoffs: { hull: kit.float_roundoff },
    source: "XMLreference, option: ccd_tolerance 1e-6; Computation, Convex collisions: in units of distance. Distances of "
      + "the libccd pipeline, and points found after rotating geoms, are disclaimed there. "
      + "mjmodel.h: vertices of meshes are float",
  },
  load(scene) {
    compile(scene);
    const shapes = new Map();
    scene.bodies.forEach((b, geom) => {
      const s = scene.shapes[b.shape];
      if (s.type === "half_space" || shapes.has(b.shape)) return;
      const size = Array.from(model.geom_size.slice(3 * geom, 3 * geom + 3));
      shapes.set(b.shape, { shape: b.shape, ...(s.type === "hull" ? { size: [], vertices: held_vertices(geom) } : { size }) });
    });
    const bodies = scene.bodies.map((_, k) => ({ body: k, matrix: Array.from(data.xmat.slice(9 * (k + 1), 9 * (k + 2))),
      translation: Array.from(data.xpos.slice(3 * (k + 1), 3 * (k + 2))) }));
    return { shapes: [...shapes.values()], bodies };
  },
  overlap({ a, b }, scene) {
    require_collider(scene, a, b);
    return { overlap: contacts(a, b).length > 0, claimed_tolerance: contact_claim(scene, a, b) };
  },
  contact({ a, b }, scene) {
    require_collider(scene, a, b);
    return contact_of(scene, contacts(a, b), a, b);
  },
  distance({ a, b }, scene) {
    const answer = closest(scene, a, b, farthest);
    if (answer.distance === undefined) throw new kit.Unsupported(`MuJoCo finds no distance below ${farthest}`);
    return answer;
  },
  within({ a, b }, scene) {
    return { overlap: near_contacts(scene, a, b).length > 0, claimed_tolerance: contact_claim(scene, a, b) };
  },
  // mjmodel.h, mjContact.dist: the distance between the nearest points.
  contact_within: ({ a, b }, scene) => contact_of(scene, near_contacts(scene, a, b), a, b),
  bounded_distance: kit.margin_questions(closest).bounded_distance, // mujoco.h, mj_geomDistance, distmax
  scene_contacts(_, scene) {
    const drops = kit.filter_of(scene), pairs = new Map(), planes = [...scene.bodies.keys()].filter((k) =>
      shape_of(scene, k).type === "half_space");
    planes.forEach((a) => planes.forEach((b) => drops(a, b) || require_collider(scene, a, b)));
    for (const c of linked_contacts().filter(({ geom }) => !drops(...geom))) {
      const key = c.geom.join(" ");
      pairs.set(key, [...(pairs.get(key) ?? []), c]);
    }
    const answers = [...pairs.values()].map((found) => ({ geom: found[0].geom, ...answer_of(scene, found, ...found[0].geom) }));
    if (answers.some((x) => x.depth === undefined)) throw new kit.Unsupported("a clipped manifold of MuJoCo states no depth of the whole contact");
    return { contacts: answers.map(({ geom: [a, b], normal, depth }) => ({ a, b, normal, depth })),
      claimed_tolerance: Math.max(0, ...answers.map((x) => x.claimed_tolerance)) };
  },
};
kit.serve(engine);
