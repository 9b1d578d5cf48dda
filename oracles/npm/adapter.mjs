// Shared by the adapters of engines from npm: the pipe protocol (pipe_protocol.md), floats, axes, scripts. An
// adapter is written against one release of its package; with TOUCHSTONE_ENGINE=NAME@RELEASE in the environment it
// runs another one, whose API may differ (release.mjs).
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import { scenes_of } from "./batch.mjs";
import { answer_for, is_of_interface, other_release, questions_that_fail } from "./release.mjs";

export const float_roundoff = 2 ** -24;
export const oracle_tau_factor = 256; // as for every other oracle: oracles/abi/plugin_kit.h
const half_turn = Math.SQRT1_2; // a quarter turn about x takes y to z

/** Thrown when the engine has no such query for these shapes. */
export class Unsupported extends Error {}

/** Imports a module from the folder in which it was installed. Some releases can only be imported by the file that their
 * package names as `module`. */
export async function from(modules, name) {
  const require = createRequire(`${modules}/-`), load = (file) => import(pathToFileURL(file));
  try {
    return await load(require.resolve(name));
  } catch (why) {
    const { module } = other_release ? require(`${modules}/node_modules/${name}/package.json`) : {};
    if (!module) throw why;
    return load(`${modules}/node_modules/${name}/${module}`);
  }
}
export const version = (modules, name) =>
  createRequire(`${modules}/-`)(`${modules}/node_modules/${name}/package.json`).version;

export const f = Math.fround;
export const floats = (v) => v.map(f);

/** Objects on the heap of a WebIDL module live until they are destroyed: kept here until the next sweep. */
export class Heap {
  constructor(destroy) {
    this.destroy = destroy;
    this.objects = [];
  }
  keep(x) {
    this.objects.push(x);
    return x;
  }
  sweep() {
    this.objects.forEach((x) => this.destroy(x));
    this.objects = [];
  }
}
export const stands_on_z = (shape) => ["capsule", "cylinder", "cone"].includes(shape.type);

// Coordinates of a grid may differ by a few roundings from multiples of the cell's length, as share of the whole length:
// oracles/abi/height_field.h.
const grid_roundings = 2 ** -50;
function even_step(places) {
  const n = places.length, length = places[n - 1] - places[0], step = length / (n - 1);
  const is_even = places.every((x, k) => Math.abs(x - step * (k - (n - 1) / 2)) <= grid_roundings * length);
  return length > 0 && is_even ? step : 0;
}
/**
 * {rows, columns, cell: [x, y]} of a mesh that is written as a scene's height fields are, else null: height_field_of() of
 * oracles/abi/height_field.h. The heights are the z of its vertices, row by row.
 */
export function height_field_of(shape) {
  if (!fields.has(shape)) fields.set(shape, recognised_field(shape));
  return fields.get(shape);
}
const fields = new WeakMap(); // by shape, as it was loaded
function recognised_field({ type, vertices, triangles }) {
  if (type !== "mesh" || triangles[0][0] !== 0 || triangles[0][1] !== 1 || triangles[0][2] < 3) return null;
  const columns = triangles[0][2] - 1, rows = vertices.length / columns;
  if (!(rows >= 2) || !Number.isInteger(rows) || triangles.length !== 2 * (rows - 1) * (columns - 1)) return null;
  const is_of_grid = triangles.every((t, k) => {
    const cell = k >> 1, corner = Math.floor(cell / (columns - 1)) * columns + cell % (columns - 1), above = corner + columns;
    const wanted = k & 1 ? [corner, above + 1, above] : [corner, corner + 1, above + 1];
    return t.every((v, i) => v === wanted[i]);
  });
  const xs = vertices.slice(0, columns).map((v) => v[0]), ys = vertices.filter((_, k) => k % columns === 0).map((v) => v[1]);
  const is_on_grid = vertices.every((v, k) => v[0] === xs[k % columns] && v[1] === ys[Math.floor(k / columns)]);
  const cell = [even_step(xs), even_step(ys)];
  return is_of_grid && is_on_grid && cell[0] > 0 && cell[1] > 0 ? { rows, columns, cell } : null;
}

/** The requested rotation, normalised in doubles. */
export function unit(q) {
  const most = Math.max(...q.map(Math.abs)), scaled = q.map((c) => c / most), n = Math.hypot(...scaled);
  return scaled.map((c) => c / n);
}

/** The same as floats; `to_y` if the engine's axis is y rather than z. */
export function unit_quaternion(q, to_y) {
  const [x, y, z, w] = unit(q), s = to_y ? half_turn : 1;
  const turned = to_y ? [x + w, y + z, z - y, w - x] : [x, y, z, w];
  return turned.map((c) => f(c * s));
}

/** The same for an engine whose x, y, z are our y, z, x. */
export function unit_quaternion_cycled(q) {
  const [x, y, z, w] = unit(q);
  return [w + x + y - z, w - x + y + z, w + x - y + z, w - x - y - z].map((c) => f(c / 2));
}

/** The same for an engine whose axis is x. */
export function unit_quaternion_to_x(q) {
  const [x, y, z, w] = unit(q);
  return [x + z, y - w, z - x, w + y].map((c) => f(c * half_turn));
}

/** A body's receipt, from the columns of the engine's own matrix, in the frame of the original shape. */
export function received_body(number, body, columns, from_y) {
  const [x, y, z] = from_y ? [columns[0], columns[2].map((c) => -c), columns[1]] : columns;
  return { body: number, matrix: [0, 1, 2].flatMap((k) => [x[k], y[k], z[k]]), translation: floats(body.pose.translation) };
}

/** The same for an engine whose axis is x. */
export function received_body_from_x(number, body, [x, y, z], from_x) {
  return received_body(number, body, from_x ? [z.map((c) => -c), y, x] : [x, y, z], false);
}

/** The columns of the rotation matrix of a unit quaternion of floats, for engines that store only the quaternion. */
export function columns_of([x, y, z, w]) {
  return [[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
          [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
          [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]];
}

/** A shape's receipt, for an engine that stores floats. */
export function received_shape(shape, number) {
  const size = shape.half_extents || shape.semi_axes || [shape.radius ?? 0, shape.half_height ?? 0];
  return { shape: number, size: floats(size), ...(shape.vertices && { vertices: shape.vertices.map(floats) }) };
}

/** The relative translation of a over the step; shape casts support no rotation. */
export function relative_translation(a, b) {
  const still = [0, 0, 0], [m, n] = [a, b].map((x) => x.motion || { linear: still, angular: still });
  if ([...m.angular, ...n.angular].some((x) => x !== 0)) throw new Unsupported("its shape casts support no rotation");
  return m.linear.map((x, k) => x - n.linear[k]);
}

const same_normal = 1 - 1e-9; // cosine
/**
 * For an engine that states depths at points, {position, normal, depth}: the normal of the deepest, and the points that
 * share it as a manifold. A clipped manifold may miss the deepest point of the contact: its depth is stated only if
 * `is_whole`.
 */
export function manifold(points, is_whole) {
  const { normal, depth } = points.reduce((p, q) => (q.depth > p.depth ? q : p));
  const shares = (p) => p.normal.reduce((sum, x, k) => sum + x * normal[k], 0) >= same_normal * Math.hypot(...normal) ** 2;
  return { normal, ...(is_whole && { depth }),
    points: points.filter(shares).map((p) => ({ position: p.position, depth: p.depth })) };
}
/**
 * The questions about a margin, for an engine with a query that finds nothing farther away than its search distance:
 * `closest(scene, a, b, reach)` is an answer to `distance`, without the distance if it finds nothing; with the `normal`
 * from a to b, if the engine states one.
 */
export function margin_questions(closest) {
  const found = ({ a, b }, scene) => {
    const reach = scene.margin ?? 0;
    if (reach < 0) throw new Unsupported("a search distance is not for depths");
    return { reach, ...closest(scene, a, b, reach) };
  };
  return {
    within(message, scene) {
      const { distance, claimed_tolerance } = found(message, scene);
      return { overlap: distance !== undefined, claimed_tolerance };
    },
    bounded_distance(message, scene) {
      const { reach, normal, ...answer } = found(message, scene);
      return { ...answer, ...(answer.distance === undefined && { lower: reach }) };
    },
    contact_within(message, scene) {
      const { distance, normal, point_a, point_b, claimed_tolerance } = found(message, scene);
      if (distance === undefined) return { overlap: false, claimed_tolerance };
      if (!normal) throw new Unsupported("its closest points have no normal");
      const position = point_a.map((x, k) => (x + point_b[k]) / 2);
      return { overlap: true, normal, depth: -distance, points: [{ position, depth: -distance }], claimed_tolerance };
    },
  };
}

/** Whether one of the shapes is a ball, which touches any other at one point. */
export const has_ball = (scene, a, b) => [a, b].some((body) => scene.shapes[scene.bodies[body].shape].type === "sphere");

/** Whether the scene filters out a pair of bodies. */
export function filter_of(scene) {
  const ignored = new Set(scene.ignored.map(([a, b]) => `${Math.min(a, b)} ${Math.max(a, b)}`));
  return (a, b) => {
    const [p, q] = [scene.bodies[a], scene.bodies[b]];
    return a === b || (p.static && q.static) || (p.group >= 0 && p.group === q.group) ||
      ignored.has(`${Math.min(a, b)} ${Math.max(a, b)}`);
  };
}

/** Runs the steps of a scene on the engine's world; world.pairs(report) reports pairs of bodies. */
export function candidates(scene, world) {
  const drops = filter_of(scene);
  const lists = [];
  for (const step of scene.steps) {
    if (step.op !== "query") {
      world[step.op](step.body, step.pose);
      continue;
    }
    const seen = new Map();
    world.pairs((a, b) => drops(a, b) || seen.set(`${Math.min(a, b)} ${Math.max(a, b)}`, [a, b]));
    lists.push([...seen.values()]);
  }
  return { pairs: lists };
}

// JSON has no NaN: an answer that contains one is reported as an error.
function checked(answer) {
  const bad = Object.entries(answer).find(([, v]) => [v].flat().some((x) => typeof x === "number" && !Number.isFinite(x)));
  return bad ? { outcome: "threw", detail: `${bad[0]} is ${bad[1]}` } : answer;
}

/**
 * engine: {card, load(scene) -> {shapes, bodies} as received, [question](message, scene) -> answer}. `batches` on the card:
 * the answers about a pair depend on nothing else in the scene, nor on the order of its bodies.
 */
export function serve(engine) {
  const text = (answer) => JSON.stringify(answer) + "\n", say = (answer) => process.stdout.write(text(answer));
  const guarded = (what) => {
    try {
      return checked(what());
    } catch (why) {
      if (why instanceof WebAssembly.RuntimeError) throw why; // a crash: the module's memory can no longer be trusted
      const lacking = why instanceof Unsupported || (other_release && is_of_interface(why));
      return { outcome: lacking ? "unsupported" : "threw", detail: String(why.message || why) };
    }
  };
  // The engine's own time, without the pipe.
  const timed = (what) => {
    const start = process.hrtime.bigint(), answer = guarded(what);
    return { ...answer, ns: Number(process.hrtime.bigint() - start) };
  };
  const fails = other_release ? questions_that_fail(engine, guarded) : new Map();
  if (!fails) return;
  say({ touchstone_pipe: 1, receipts: true, states_ns: true, unit_roundoff: float_roundoff, tau_factor: oracle_tau_factor, ...engine.card,
        ...(other_release && { name: other_release }) });
  let scene = null;
  const load = (what) => {
    scene = what;
    return guarded(() => ({ received: engine.load(scene) }));
  };
  const answer = (message) => {
    if (!engine[message.ask]) return { outcome: "unsupported", detail: `the adapter does not support ${message.ask}` };
    if (fails.has(message.ask)) return { outcome: "unsupported", detail: fails.get(message.ask) };
    return timed(() => engine[message.ask](message, scene));
  };
  const of_pair = (pair, ask) => {
    const loaded = load(pair);
    return loaded.outcome ? loaded : { ...loaded, ...answer({ ask, a: 0, b: 1 }) };
  };
  const all = (scenes, ask) => text({ answers: scenes.length, lines: true }) + scenes.map((pair) => text(of_pair(pair, ask))).join("");
  answer_for((message, bytes) => {
    if (message.ask_many) process.stdout.write(all(scenes_of(message, bytes), message.ask_many));
    else say(message.scene ? load(message.scene) : answer(message));
  });
}
