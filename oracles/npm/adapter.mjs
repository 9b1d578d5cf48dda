// Shared by the adapters of engines from npm: the pipe protocol (pipe_protocol.md), floats, axes, scripts.
import { createRequire } from "node:module";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

export const float_roundoff = 2 ** -24;
export const oracle_tau_factor = 256; // as for every other oracle: oracles/abi/plugin_kit.h
const half_turn = Math.SQRT1_2; // a quarter turn about x takes y to z

/** Thrown when the engine has no such query for these shapes. */
export class Unsupported extends Error {}

/** Imports a module from the folder in which it was installed. */
export async function from(modules, name) {
  return import(pathToFileURL(createRequire(`${modules}/-`).resolve(name)));
}
export const version = (modules, name) =>
  createRequire(`${modules}/-`)(`${modules}/node_modules/${name}/package.json`).version;

export const f = Math.fround;
export const floats = (v) => v.map(f);
export const stands_on_z = (shape) => ["capsule", "cylinder", "cone"].includes(shape.type);

/** The requested rotation, normalised in doubles; `to_y` if the engine's axis is y rather than z. */
export function unit_quaternion(q, to_y) {
  const most = Math.max(...q.map(Math.abs));
  const [x, y, z, w] = q.map((c) => c / most);
  const n = Math.hypot(x, y, z, w), s = to_y ? half_turn : 1;
  const turned = to_y ? [x + w, y + z, z - y, w - x] : [x, y, z, w];
  return turned.map((c) => f((c / n) * s));
}

/** A body's receipt, from the columns of the engine's own matrix, in the frame of the original shape. */
export function received_body(number, body, columns, from_y) {
  const [x, y, z] = from_y ? [columns[0], columns[2].map((c) => -c), columns[1]] : columns;
  return { body: number, matrix: [0, 1, 2].flatMap((k) => [x[k], y[k], z[k]]), translation: floats(body.pose.translation) };
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

/** Runs the steps of a scene on the engine's world; world.pairs(report) reports pairs of bodies. */
export function candidates(scene, world) {
  const ignored = new Set(scene.ignored.map(([a, b]) => `${Math.min(a, b)} ${Math.max(a, b)}`));
  const drops = (a, b) => {
    const [p, q] = [scene.bodies[a], scene.bodies[b]];
    return a === b || (p.static && q.static) || (p.group >= 0 && p.group === q.group) ||
      ignored.has(`${Math.min(a, b)} ${Math.max(a, b)}`);
  };
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

/** engine: {card, load(scene) -> {shapes, bodies} as received, [question](message, scene) -> answer}. */
export function serve(engine) {
  const say = (answer) => process.stdout.write(JSON.stringify(answer) + "\n");
  const guarded = (what) => {
    try {
      return checked(what());
    } catch (why) {
      if (why instanceof WebAssembly.RuntimeError) throw why; // a crash: the module's memory can no longer be trusted
      return { outcome: why instanceof Unsupported ? "unsupported" : "threw", detail: String(why.message || why) };
    }
  };
  // The engine's own time, without the pipe.
  const timed = (what) => {
    const start = process.hrtime.bigint(), answer = guarded(what);
    return { ...answer, ns: Number(process.hrtime.bigint() - start) };
  };
  say({ touchstone_pipe: 1, receipts: true, states_ns: true, unit_roundoff: float_roundoff, tau_factor: oracle_tau_factor, ...engine.card });
  let scene = null;
  createInterface({ input: process.stdin }).on("line", (line) => {
    const message = JSON.parse(line);
    if (message.scene) {
      scene = message.scene;
      say(guarded(() => ({ received: engine.load(scene) })));
    } else if (!engine[message.ask]) {
      say({ outcome: "unsupported", detail: `the adapter does not support ${message.ask}` });
    } else {
      say(timed(() => engine[message.ask](message, scene)));
    }
  });
}
